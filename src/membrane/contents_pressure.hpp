// The effective pressure of the soil inside a membrane on its nodes: what friction between the two follows from.
#pragma once

#include "means_beside.hpp"

namespace geodrop {

/// Keeps its arrays from one step to the next.
class ContentsPressure {
 public:
  /// Renews Membrane::contents_pressure: p' = max(0, -n . sigma' n), n across the line at each node [Pa].
  void update(const State<2>& state, const GridLayout<2>& layout, Membrane<2>& membrane);

 private:
  MeansBeside<2, 3> stress_;
};

}  // namespace geodrop
