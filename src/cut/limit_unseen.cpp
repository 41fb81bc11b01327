#include "limit_unseen.hpp"

#include <geodrop/materials/materials.hpp>

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "cells_around.hpp"
#include "grid/point_support.hpp"

namespace geodrop {
namespace {

/// Boxes of the cut cells that a body may be in.
template <int Dim>
std::vector<BoxOfCells<Dim>> boxes_of(const State<Dim>& state, const Grids<Dim>& grids, const Body<Dim>& body) {
  std::vector<BoxOfCells<Dim>> boxes;
  for (const Membrane<Dim>& membrane : state.membranes) {
    if (!acts_sharply(membrane)) continue;
    if (is_beside(body, membrane, grids)) boxes.emplace_back(grids.front().layout, grids[membrane.field].outline);
  }
  return boxes;
}

template <int Dim>
void limit_particle(const Grid<Dim>& own, double most, std::size_t p, Body<Dim>& body) {
  const Vec4 seen =
      interpolate(own.layout, PointSupport<Dim>(own.layout, place_at(body.x, p), body.half_size), own.velocity);
  double square = 0;
  for (int a = 0; a < Dim; ++a) square += (body.v[a][p] - seen[a]) * (body.v[a][p] - seen[a]);
  if (!(square > most * most)) return;
  const double share = most / std::sqrt(square);
  for (int a = 0; a < Dim; ++a) body.v[a][p] = seen[a] + share * (body.v[a][p] - seen[a]);
}

}  // namespace

template <int Dim>
void limit_unseen(State<Dim>& state, const Grids<Dim>& grids) {
  if (!std::isfinite(state.drift)) return;  // a particle is lost, perhaps off the grid: the next sort reports it
  for (Body<Dim>& body : state.bodies) {
    if (!std::holds_alternative<Newtonian>(body.material)) continue;
    const std::vector<BoxOfCells<Dim>> boxes = boxes_of(state, grids, body);
    if (boxes.empty()) continue;
    const Grid<Dim>& own = grids[body.field];
    const double most = most_unseen * wave_speed(body.material);
    const auto particles = static_cast<std::ptrdiff_t>(body.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t p = 0; p < particles; ++p) {
      const auto holds = [&](const BoxOfCells<Dim>& box) { return box.may_hold(body.x, p); };
      if (std::none_of(boxes.begin(), boxes.end(), holds)) continue;
      if (own.taken[cell_at(own.layout, body.x, p)] > 0) limit_particle(own, most, p, body);
    }
  }
}

template void limit_unseen(State<2>&, const Grids<2>&);
template void limit_unseen(State<3>&, const Grids<3>&);

}  // namespace geodrop
