#include "silent_side.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/scene/scene.hpp>

#include <algorithm>
#include <cmath>

#include "base/fixed_order_sum.hpp"
#include "state/energy_gain.hpp"

namespace geodrop {
namespace {

constexpr int x_axis = 0, y_axis = 1;

/// int s dx / c over the layer: 0.7 % of a wave come back from the wall.
constexpr double fading = 2.5;

/// Where the pressure of a row is taken, from the inner edge of the layer [width].
constexpr double seen_at_edge = 0.25;

/// A body of a fluid and a layer of it.
struct Layer {
  const SilentSide& side;
  const Newtonian& fluid;
  Body<2>& body;

  /// 0 at the inner edge, 1 at the wall [-].
  double depth(std::size_t p) const { return side.outward * (body.x[x_axis][p] - side.begin) / side.width; }
  double still_pressure_at(std::size_t p) const {
    return still_pressure(fluid, side.gravity, side.surface - body.x[y_axis][p]);
  }
  double of_weight(std::size_t p) const { return fluid.of_weight(body.x[y_axis][p]); }
  double excess_pressure(std::size_t p) const {
    return fluid.bulk_modulus * (1 / body.J[p] - 1) + of_weight(p) - still_pressure_at(p);
  }
  /// `times` the energy of a particle.
  EnergyGain energy(std::size_t p, double times) const {
    const double u = body.v[x_axis][p], v = body.v[y_axis][p], mass = times * body.mass[p];
    const double pressed = fluid_energy(fluid, body.J[p], body.gas_at(p), of_weight(p)) / fluid.density;
    return {mass * (0.5 * (u * u + v * v) + pressed), mass * side.gravity * body.x[y_axis][p]};
  }
};

/// Rows of nodes, seen from a height: that below, and the share of that above.
struct Rows {
  int below;
  double above;
};

Rows rows_at(const GridLayout<2>& layout, double y) {
  const int nearest = layout.base(y_axis, y);
  const int below = y < layout.node(y_axis, nearest) ? nearest - 1 : nearest;
  const double from = layout.node(y_axis, below), to = layout.node(y_axis, below + 1);
  return {below + GridLayout<2>::pad, (y - from) / (to - from)};
}

/// A value between rows.
double between(const Array<double>& of_rows, const Rows& rows) {
  return of_rows[rows.below] * (1 - rows.above) + of_rows[rows.below + 1] * rows.above;
}

/// Sums of `of` over sums of `by`, both smoothed with the binomial over the rows; 0 in rows without any. Pressures of
/// cells may differ by turns from row to row, which is no wave.
Array<double> smoothed_ratio(const Array<double>& of, const Array<double>& by) {
  Array<double> ratio(of.size(), 0.0);
  for (std::size_t row = 1; row + 1 < of.size(); ++row)
    if (by[row] > 0) ratio[row] = (of[row - 1] + 2 * of[row] + of[row + 1]) / (by[row - 1] + 2 * by[row] + by[row + 1]);
  return ratio;
}

/// Mean over the particles of each row of what their pressure has over that of the still fluid, at the inner edge; 0 in
/// rows without particles. In the order of the particles, so that the sums do not depend on the number of threads.
Array<double> excess_of_rows(const GridLayout<2>& layout, const Layer& layer) {
  Array<double> volume(layout.stored[y_axis], 0.0), excess(layout.stored[y_axis], 0.0);
  for (std::size_t p = 0; p < layer.body.size(); ++p) {
    const double depth = layer.depth(p);
    if (depth < 0 || depth > seen_at_edge) continue;
    const int row = layout.base(y_axis, layer.body.x[y_axis][p]) + GridLayout<2>::pad;
    volume[row] += layer.body.volume(p);
    excess[row] += layer.body.volume(p) * layer.excess_pressure(p);
  }
  return smoothed_ratio(excess, volume);
}

/// dr/dt = (p - p_h - r) / T, du/dt = (p - p_h - r) / (rho L) - u / T in each row.
void advance_rows(const Array<double>& excess, double dt, const Layer& layer, SilentSide& side) {
  side.lasting.resize(excess.size(), 0.0);
  side.flow.resize(excess.size(), 0.0);
  const double per_pressure = dt / (layer.fluid.density * side.water_beyond), forgotten = dt / side.rest_time;
  for (std::size_t row = 0; row < excess.size(); ++row) {
    const double wave = excess[row] - side.lasting[row];
    side.lasting[row] += forgotten * wave;
    side.flow[row] += per_pressure * wave - forgotten * side.flow[row];
  }
}

/// Returns what the particles in the layer have gained.
EnergyGain fade(const GridLayout<2>& layout, double dt, const Layer& layer) {
  Body<2>& body = layer.body;
  const SilentSide& side = layer.side;
  return fixed_order_sum<EnergyGain>(body.size(), [&](EnergyGain& gained, std::size_t p) {
    const double depth = layer.depth(p);
    if (depth <= 0) return;
    gained += layer.energy(p, -1);
    const double lost = -std::expm1(-side.rate * depth * depth * dt);
    const Rows rows = rows_at(layout, body.x[y_axis][p]);
    body.v[x_axis][p] += lost * (side.outward * between(side.flow, rows) - body.v[x_axis][p]);
    body.v[y_axis][p] -= lost * body.v[y_axis][p];
    const double at_rest = layer.still_pressure_at(p) - layer.of_weight(p) + between(side.lasting, rows), J = body.J[p];
    body.J[p] += lost * (1 / (1 + at_rest / layer.fluid.bulk_modulus) - J);
    body.mass[p] *= J / body.J[p];
    gained += layer.energy(p, 1);
  });
}

}  // namespace

SilentSide make_silent_side(const Scene& scene, const SilentSideSpec& spec) {
  const BodySpec& body = *find_body(scene, spec.body);
  const bool left = spec.side == SilentSideSpec::Side::left;
  SilentSide side;
  side.name = spec.name;
  side.body = spec.body;
  side.outward = left ? -1 : 1;
  side.begin = left ? scene.grid.lower[x_axis] + spec.width : scene.grid.upper[x_axis] - spec.width;
  side.width = spec.width;
  side.rate = 3 * fading * wave_speed(make_material(*find_material(scene, body.material))) / spec.width;
  side.surface = std::get<HydrostaticSpec>(body.initial_stress).surface;
  side.gravity = -scene.gravity[y_axis];
  side.water_beyond = spec.water_beyond;
  side.rest_time = spec.rest_time;
  return side;
}

void fade_at_silent_sides(const GridLayout<2>& layout, double dt, State<2>& state) {
  if (!std::isfinite(state.drift)) return;  // a particle is lost, perhaps off the grid: the next sort reports it
  for (SilentSide& side : state.silent_sides) {
    Body<2>& body = find_named(state.bodies, side.body);
    if (body.field == waiting) continue;
    const Layer layer{side, std::get<Newtonian>(body.material), body};
    advance_rows(excess_of_rows(layout, layer), dt, layer, side);
    give(fade(layout, dt, layer), state.energy_budget);
  }
}

}  // namespace geodrop
