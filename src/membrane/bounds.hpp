// The box around a membrane.
#pragma once

#include <geodrop/state/state.hpp>

#include <algorithm>

namespace geodrop {

template <int Dim>
struct Box {
  Vec<Dim> lower, upper;  ///< [m]
  bool holds(const Vec<Dim>& x) const { return (x.array() >= lower.array() && x.array() <= upper.array()).all(); }
};

/// Around all nodes, and `margin` [m] more.
template <int Dim>
Box<Dim> bounds(const Membrane<Dim>& membrane, double margin) {
  Box<Dim> box;
  for (int a = 0; a < Dim; ++a) {
    const auto [low, high] = std::minmax_element(membrane.x[a].begin(), membrane.x[a].end());
    box.lower[a] = *low - margin;
    box.upper[a] = *high + margin;
  }
  return box;
}

}  // namespace geodrop
