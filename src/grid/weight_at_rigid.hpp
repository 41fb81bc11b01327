// The weight of a fluid beside rigid bodies.
//
// Pressure acts over the room that rigid bodies leave (cut/rigid_parts), weight at the particles. A node beside the
// surface has few of them, whose splines hold a little more or less than that room: where weights differ from what the
// pressure carries a current rises or sinks along the surface (0.27 m/s after 4 s at h = 0.25 m).
#pragma once

#include <geodrop/grid/grid.hpp>

namespace geodrop {

/// Grid::room_mass of nodes beside rigid bodies: what the room around them holds at the density of the particles there;
/// 0 elsewhere, and where a surface or a sharp interface is near. The share of gravity that acts on all nodes, so that
/// the weight of the whole is that of its mass.
double weigh_by_room(Grid<2>& grid);

}  // namespace geodrop
