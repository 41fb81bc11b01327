// Nodes of a sliding membrane spread along its line again: no tension holds the polygon together any more, and where
// the body's surface stretches it would tear.
#pragma once

#include <geodrop/state/state.hpp>

#include <vector>

namespace geodrop {

/// Whether a segment has left half to twice its share of the line's length, between held nodes that of its part.
bool is_uneven(const Membrane<2>& membrane, const std::vector<std::size_t>& held = {});

/// Nodes to their shares of the length, on cubics through the old ones (Catmull & Rom 1974). Rest length, and mass with
/// it, stays where it is along the line; velocities are interpolated. Total rest length, mass, momentum and, if the
/// line is closed, the area inside are kept to round-off. Ends of an open line and held nodes (ascending)
/// stay.
void even_out_nodes(Membrane<2>& membrane, std::vector<std::size_t> held = {});

/// Of all membranes that slide and need it; the particles are sorted anew then.
void even_out_membranes(State<2>& state);

}  // namespace geodrop
