// Pressures of fluids on the edges of a membrane's polygon, as loads of its nodes (2D).
#pragma once

#include <geodrop/scene.hpp>
#include <geodrop/state.hpp>

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

/// Adds the pressure of still fluids that stand around membranes, gamma (surface - y) inwards below their surfaces.
template <int Dim>
void add_still_fluids(const Scene& scene, State<Dim>& state);

}  // namespace geodrop
