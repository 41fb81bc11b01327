// The area of cloth that stands for a node.
#pragma once

#include <geodrop/state/state.hpp>

namespace geodrop {

/// Area of cloth at rest that belongs to each node [m2].
inline Array<double> node_areas(const Membrane<3>& membrane) {
  Array<double> area(membrane.nodes(), 0.0);
  for (std::size_t t = 0; t < membrane.triangles.size(); ++t)
    for (const auto& corner : membrane.triangles.corner) area[corner[t]] += membrane.triangles.rest_area[t] / 3;
  return area;
}

}  // namespace geodrop
