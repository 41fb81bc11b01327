// Knots of the pressure on a membrane of triangles: nodes of the cloth that lie evenly over it.
#pragma once

#include <geodrop/state/state.hpp>

#include <vector>

namespace geodrop {

/// What a stretch or a triangle takes of the pressure at a knot [-].
struct KnotShare {
  int knot;
  double value;
};
using KnotShares = std::vector<KnotShare>;

/// Adds to what is taken of a knot.
void add(int knot, double value, KnotShares& shares);

/// Knots of a cloth, and the mean over each triangle of functions that are largest at a knot and add up to one.
struct ClothKnots {
  int count = 0;
  std::vector<KnotShares> of_triangle;
};

/// Knots at least 0.9 times `distance` apart, so that no node is farther from all of them [m]. Distances run along the
/// edges of triangles at rest: what the cloth has gone through changes nothing. The function of a knot falls linearly
/// to 0 within 1.25 times `distance`, over the sum of all of them (Shepard 1968).
ClothKnots cloth_knots(const Membrane<3>& membrane, double distance);

}  // namespace geodrop
