// The line of a membrane's nodes: neighbours, lengths and directions, closed or open (2D).
#pragma once

#include <geodrop/state/state.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/polygon.hpp"

namespace geodrop {

/// The node before a node along the line; before the first one of an open line, itself.
inline std::size_t node_before(const Membrane<2>& membrane, std::size_t k) {
  if (k > 0) return k - 1;
  return membrane.closed ? membrane.nodes() - 1 : k;
}

/// The node after it; after the last one of an open line, itself.
inline std::size_t node_after(const Membrane<2>& membrane, std::size_t k) {
  if (k + 1 < membrane.nodes()) return k + 1;
  return membrane.closed ? 0 : k;
}

/// Length of a segment now [m].
inline double segment_length(const Membrane<2>& membrane, std::size_t s) {
  const std::size_t end = end_of_edge(s, membrane.nodes());
  return std::hypot(membrane.x[0][end] - membrane.x[0][s], membrane.x[1][end] - membrane.x[1][s]);
}

/// Unit vector along the line at a node, from the node before to the node after; (1, 0) if these are in one place.
inline std::array<double, 2> tangent_at(const Membrane<2>& membrane, std::size_t k) {
  const std::size_t from = node_before(membrane, k), to = node_after(membrane, k);
  const double dx = membrane.x[0][to] - membrane.x[0][from], dy = membrane.x[1][to] - membrane.x[1][from];
  const double length = std::hypot(dx, dy);
  if (!(length > 0)) return {1, 0};
  return {dx / length, dy / length};
}

/// What of the traction along a sharp membrane its cloth takes where it slides, of segments [Pa]; empty: nothing. A
/// fluid that sticks over a fluid inside is no load of the cloth: its rows tie the two fluids to each other.
inline const Array<double>& shear_on_cloth(const Membrane<2>& membrane) {
  const bool tied = membrane.shear == Shear::no_slip && membrane.contents_pressure.empty();
  return tied ? membrane.bed_shear : membrane.water_shear;
}

/// What of the pressure on a node from outside can rub [Pa]. Where the geotextile lets water through, what its grains
/// bear: the rest is borne by water on both sides (Terzaghi). Without end of all others.
inline double rubbing_pressure(const Membrane<2>& membrane, std::size_t k) {
  const bool wet = membrane.permeance > 0 && !membrane.contents_pressure.empty();
  return wet ? membrane.contents_pressure[k] : std::numeric_limits<double>::infinity();
}

/// Node masses from the mass of all and the rest lengths beside the nodes, half of each [kg].
inline void share_mass(Membrane<2>& membrane) {
  double mass = 0, rest = 0;
  for (const double m : membrane.mass) mass += m;
  for (const double r : membrane.rest_length) rest += r;
  std::fill(membrane.mass.begin(), membrane.mass.end(), 0.0);
  for (std::size_t s = 0; s < membrane.segments(); ++s) {
    const double half = 0.5 * mass * membrane.rest_length[s] / rest;
    membrane.mass[s] += half;
    membrane.mass[end_of_edge(s, membrane.nodes())] += half;
  }
}

}  // namespace geodrop
