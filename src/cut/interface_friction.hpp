// Friction along sharp membranes: on a bed, in fluid that slips, over what lies inside.
#pragma once

#include <array>
#include <vector>

#include "contact_rows.hpp"

namespace geodrop {

/// Tractions along the membrane at each contact, before they are forgotten.
template <int Dim>
std::vector<std::array<double, Dim - 1>> tractions_along(const std::vector<Contact<Dim>>& contacts,
                                                         const Grids<Dim>& grids);

/// Friction: tractions along the membrane that stop it from slipping, at most mu times the effective pressure on the
/// bed, what the soil inside takes where water would stick, or what the wall law says in fluid. last: those of the step
/// before.
template <int Dim>
void rub(double dt, const std::vector<RowsOfContact<Dim>>& said, std::vector<Contact<Dim>>& contacts, Grids<Dim>& grids,
         const std::vector<std::array<double, Dim - 1>>& last);

}  // namespace geodrop
