// A skin marks the surface of a body, as that of a bed, and has neither mass nor tension of its own.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Whether a membrane is a skin with a sharp interface, which moves with what is on its two sides; not while it waits
/// to be placed.
inline bool is_sharp_skin(const Membrane<2>& membrane) {
  return membrane.sharp && membrane.field != waiting && membrane.axial_stiffness == 0 && membrane.mass.front() == 0;
}

/// Moves the nodes of sharp skins over `dt` [s] with the body inside them. Where little of it is left around a node, as
/// in the tip of a tongue that its soil has left, a skin moves with what is around it and draws back: a tenth of the
/// way to the middle of its neighbours in a step. Adds the largest displacement to State::drift. Throws RunError for a
/// node that leaves the domain.
void move_skins(State<2>& state, const Grids<2>& grids, double dt);

}  // namespace geodrop
