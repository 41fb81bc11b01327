#include "transfer_stages.hpp"

#include <cmath>
#include <limits>

#include "grid/blocks.hpp"
#include "grid/momentum.hpp"
#include "grid/seams.hpp"
#include "kernels.hpp"
#include "membrane/membrane_force.hpp"
#include "slabs.hpp"

namespace geodrop {
namespace {

GatherOptions gather_options(const SolverSpec& solver, double damping_rate, double dt) {
  return {solver.transfer, dt, std::exp(-solver.blend_rate * dt), std::exp(-damping_rate * dt)};
}

/// Particles per task: fixed, so that packets fall the same way for any thread count.
constexpr std::size_t task_share = 16 * chunk_size;

template <int Dim>
std::ptrdiff_t task_count(const Body<Dim>& body) {
  return static_cast<std::ptrdiff_t>((body.size() + task_share - 1) / task_share);
}

/// f(task, begin, end) for consecutive particles of a body, in parallel.
template <int Dim, class F>
void for_each_task(const Body<Dim>& body, F&& f) {
  const std::ptrdiff_t tasks = task_count(body);
#pragma omp parallel for schedule(dynamic, 4) if (body.size() >= particles_worth_threads)
  for (std::ptrdiff_t task = 0; task < tasks; ++task)
    f(task, task * task_share, std::min(body.size(), (task + 1) * task_share));
}

/// Sums over particles become means over the volumes that reach a node.
template <int Dim>
void divide_by_volume(Grid<Dim>& grid, Array<double>& field) {
  for_each_seam(grid.layout, [&](int axis) { sum_over_seam(grid.layout, axis, field); });
  for_each_active_row(grid, [&](int begin, int count, const auto&) {
    for (int node = begin; node < begin + count; ++node)
      if (grid.node_volume[node] > 0) field[node] /= grid.node_volume[node];
  });
}

}  // namespace

template <int Dim>
void clear_grid(Grid<Dim>& grid) {
  for_each_active_row(
      grid, [&](int begin, int count, const auto&) { zero_row<grid_role::zero_each_step>(grid, begin, count); });
}

template <int Dim>
void sum_particles_in_cells(const State<Dim>& state, Grid<Dim>& grid) {
  for_each_slab_by_colour(state, grid, [&](const Body<Dim>& body, std::size_t begin, std::size_t end) {
    sum_cells<Dim>(body, grid, begin, end);
  });
}

template <int Dim>
void average_nodal_pressure(const State<Dim>& state, Grid<Dim>& grid) {
  for_each_slab_by_colour(state, grid, [&](const Body<Dim>& body, std::size_t begin, std::size_t end) {
    if (body.pressure == PressureSupport::nodal) sum_nodal_pressure<Dim>(body, grid, begin, end);
  });
  for_each_seam(grid.layout, [&](int axis) { sum_over_seam(grid.layout, axis, grid.node_volume); });
  divide_by_volume(grid, grid.node_pressure);
}

template <int Dim>
void average_nodal_rate(const State<Dim>& state, Grid<Dim>& grid) {
  for_each_slab_by_colour(state, grid, [&](const Body<Dim>& body, std::size_t begin, std::size_t end) {
    if (body.pressure == PressureSupport::nodal) sum_nodal_rate<Dim>(body, grid, begin, end);
  });
  divide_by_volume(grid, grid.node_rate);
}

template <int Dim>
void remap_velocity(const SolverSpec& solver, State<Dim>& state, Grid<Dim>& grid, double dt) {
  const GatherOptions options = gather_options(solver, state.damping_rate, dt);
  for (Body<Dim>& body : state.bodies)
    if (body.field == grid.field)
      for_each_task(body, [&](std::ptrdiff_t, std::size_t begin, std::size_t end) {
        update_velocity<Dim>(body, grid, options, begin, end);
      });
  update_membrane_velocity(solver, state, grid, dt);
  for_each_active_row(grid,
                      [&](int begin, int count, const auto&) { std::fill_n(grid.sum.begin() + begin, count, Vec4{}); });
  for_each_slab_by_colour(state, grid, [&](const Body<Dim>& body, std::size_t begin, std::size_t end) {
    sum_by_mass<Dim>(body, {pointers(body.v), 1.0}, grid.layout, grid.sum.data(), begin, end);
  });
  sum_membrane_momentum(state, grid);
  fold_walls(grid);
  for_each_active_row(grid, [&](int begin, int count, const auto&) {
    for (int node = begin; node < begin + count; ++node) {
      const double m = grid.sum[node][3], inv_m = m > 0 ? 1 / m : 0.0;
      for (int a = 0; a < Dim; ++a) grid.velocity[node][a] = inv_m * grid.sum[node][a];
    }
  });
  impose_wall_velocity(grid);
}

template <int Dim>
void particles_to_grid(const State<Dim>& state, Grid<Dim>& grid, double dt) {
  for_each_slab_by_colour(state, grid, [&](const Body<Dim>& body, std::size_t begin, std::size_t end) {
    scatter<Dim>(body, grid, dt, begin, end);
  });
}

template <int Dim>
void grid_to_particles(const SolverSpec& solver, State<Dim>& state, Grids<Dim>& grids, double dt) {
  const GatherOptions options = gather_options(solver, state.damping_rate, dt);
  double v_max = 0, displacement = 0;
  for (Body<Dim>& body : state.bodies) {
    if (body.field == waiting) continue;
    Grid<Dim>& grid = grids[body.field];
    const std::ptrdiff_t tasks = task_count(body);
    grid.chunk_maxima.assign(2 * tasks, 0.0);
    for_each_task(body, [&](std::ptrdiff_t task, std::size_t begin, std::size_t end) {
      const Maxima maxima = gather<Dim>(body, grid, options, begin, end);
      grid.chunk_maxima[2 * task] = std::sqrt(maxima.speed2);
      // A particle that is lost makes the next sort due, which then names it.
      grid.chunk_maxima[2 * task + 1] = maxima.lost ? std::numeric_limits<double>::infinity() : maxima.displacement;
    });
    for (std::ptrdiff_t task = 0; task < tasks; ++task) {
      const double speed = grid.chunk_maxima[2 * task];
      if (!(speed <= v_max) && !std::isnan(v_max)) v_max = speed;  // NaN stays: stable_dt reports it
      displacement = std::max(displacement, grid.chunk_maxima[2 * task + 1]);
    }
  }
  state.v_max = v_max;
  state.drift += displacement;
}

#define GEODROP_INSTANTIATE(D)                                                     \
  template void clear_grid<D>(Grid<D>&);                                           \
  template void sum_particles_in_cells<D>(const State<D>&, Grid<D>&);              \
  template void average_nodal_pressure<D>(const State<D>&, Grid<D>&);              \
  template void average_nodal_rate<D>(const State<D>&, Grid<D>&);                  \
  template void remap_velocity<D>(const SolverSpec&, State<D>&, Grid<D>&, double); \
  template void particles_to_grid<D>(const State<D>&, Grid<D>&, double);           \
  template void grid_to_particles<D>(const SolverSpec&, State<D>&, Grids<D>&, double);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
