// One solution of the constraint of sharp membranes, without the row of a step around it.
#pragma once

#include <vector>

#include "cut/interface_constraint.hpp"

namespace geodrop::test {

template <int Dim>
void join(State<Dim>& state, Grids<Dim>& grids, double dt) {
  std::vector<ClothKnots> knots;
  join_interfaces(state, grids, dt, knots);
}

}  // namespace geodrop::test
