// Pressures of fluids on the edges of a membrane's polygon, as loads of its nodes (2D).
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

#include <string>
#include <vector>

namespace geodrop {

/// 1 if the nodes of a closed membrane run anticlockwise, -1 if clockwise: the side on which its outward normal is.
double sense_of(const Membrane<2>& membrane);

/// A pressure [Pa] outwards on a part of an edge, linear in between; parts as shares of the edge.
struct EdgePressure {
  double from, to;
  double at_from, at_to;
};

/// Adds its resultant, int p N dl n with N linear along the edge, to the ends of edge k.
void add_pressure(const EdgePressure& pressure, double sense, std::size_t k, Membrane<2>& membrane);

/// Fluid at rest on one side of a closed membrane: p = gamma (surface - y) below its surface, outwards if it is inside.
struct StillFluid {
  std::string membrane;
  double unit_weight;  ///< gamma [N/m3]; negative: from outside
  double surface;      ///< level [m]
};
std::vector<StillFluid> still_fluids(const Scene& scene);

/// Adds the pressure of fluids around membranes below their surfaces.
void add_still_fluids(const std::vector<StillFluid>& fluids, State<2>& state);

}  // namespace geodrop
