#include "relaxation.hpp"

#include <geodrop/measure/measure.hpp>
#include <geodrop/step/pipeline.hpp>

#include <algorithm>
#include <cmath>

#include "grid/blocks.hpp"

namespace geodrop {
namespace {

/// Squared norms over the nodes [N2].
struct Squares {
  double force = 0, weight = 0;
};

template <int Dim>
void add_squares(const Point& gravity, double dt, const Grid<Dim>& grid, Squares& sum) {
  const auto blocks = static_cast<std::ptrdiff_t>(grid.active_blocks.size());
  std::vector<Squares> parts(blocks);  // summed in order: the same bits for any number of threads
#pragma omp parallel for schedule(static) if (blocks >= blocks_worth_threads)
  for (std::ptrdiff_t b = 0; b < blocks; ++b)
    for_each_real_row_of_block(grid.layout, grid.active_blocks[b],
                               [&](int begin, int count, const std::array<int, Dim>&) {
                                 for (int node = begin; node < begin + count; ++node) {
                                   const double m = grid.sum[node][3];
                                   for (int a = 0; a < Dim; ++a) {
                                     const double force = m * grid.velocity_change[node][a] / dt;
                                     parts[b].force += force * force;
                                     parts[b].weight += m * gravity[a] * m * gravity[a];
                                   }
                                 }
                               });
  for (const Squares& part : parts) {
    sum.force += part.force;
    sum.weight += part.weight;
  }
}

template <int Dim>
void stop_all(State<Dim>& state) {
  const auto stop = [](auto& rates) {
    for (auto& component : rates) std::fill(component.begin(), component.end(), 0.0);
  };
  for (Body<Dim>& body : state.bodies) {
    if (body.field == waiting) continue;
    for_each_field<particle_role::rate>(body, [&](const auto&, auto& values) { stop(values); });
  }
  for (Membrane<Dim>& membrane : state.membranes) stop(membrane.v);
  for (ViscousBoundary<Dim>& boundary : state.viscous_boundaries) stop(boundary.v);
  for (SilentSide& side : state.silent_sides) std::fill(side.flow.begin(), side.flow.end(), 0.0);
  state.relaxation.kinetic = 0;
}

}  // namespace

template <int Dim>
void measure_balance(const Point& gravity, double dt, State<Dim>& state, const Grids<Dim>& grids) {
  Squares sum;
  for (const Grid<Dim>& grid : grids) add_squares(gravity, dt, grid, sum);
  double& largest = state.relaxation.out_of_balance_largest;
  largest = std::max(largest, std::sqrt(sum.force / sum.weight));
}

template <int Dim>
void damp_kinetically(const RelaxationSpec& spec, const Point& gravity, State<Dim>& state) {
  Relaxation& r = state.relaxation;
  const double before = r.kinetic;
  r.kinetic = kinetic_energy(state);
  r.kinetic_largest = std::max(r.kinetic_largest, r.kinetic);
  ++r.steps;
  if (r.kinetic >= before) return;
  stop_all(state);
  if (r.steps < shortest_cycle) return;
  const double work = std::abs(r.initial_potential - measure(state, gravity).potential);
  r.kinetic_ratio = r.kinetic_largest / work;
  r.out_of_balance_ratio = r.out_of_balance_largest;
  const bool met =
      work > 0 && r.kinetic_ratio < spec.kinetic_ratio && r.out_of_balance_ratio < spec.out_of_balance_ratio;
  r.cycles_at_rest = met ? r.cycles_at_rest + 1 : 0;
  ++r.cycles;
  r.kinetic_largest = r.out_of_balance_largest = 0;
  r.steps = 0;
}

#define GEODROP_INSTANTIATE(D)                                                        \
  template void measure_balance<D>(const Point&, double, State<D>&, const Grids<D>&); \
  template void damp_kinetically<D>(const RelaxationSpec&, const Point&, State<D>&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
