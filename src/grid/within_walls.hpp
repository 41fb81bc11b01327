#pragma once

#include <geodrop/grid/grid.hpp>

#include <algorithm>

namespace geodrop {

/// The nearest coordinate along an axis that no wall is before; x itself along periodic axes [m].
template <int Dim>
double within_walls(const GridLayout<Dim>& layout, int axis, double x) {
  return layout.periodic(axis) ? x : std::clamp(x, layout.lower[axis], layout.upper[axis]);
}

}  // namespace geodrop
