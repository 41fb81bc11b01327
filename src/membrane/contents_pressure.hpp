// The effective pressure of the soil inside a membrane on its nodes: what friction between the two follows from.
#pragma once

#include "means_beside.hpp"

namespace geodrop {

/// Keeps its arrays from one step to the next.
class ContentsPressure {
 public:
  /// Renews Membrane::contents_pressure: p' = max(0, -n . sigma' n), n across the line at each node [Pa]. The mean is
  /// that over the soil; inside a sharp membrane, whose room is known, over soil and voids: an empty corner bears
  /// nothing. grid: of the membrane's field.
  void update(const State<2>& state, const Grid<2>& grid, Membrane<2>& membrane);

 private:
  MeansBeside<2, 3> stress_;
};

}  // namespace geodrop
