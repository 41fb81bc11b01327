#include "transfer_stages.hpp"

#include <cmath>
#include <limits>

#include "../grid/blocks.hpp"
#include "../grid/momentum.hpp"
#include "kernels.hpp"

namespace geodrop {
namespace {

/// Fewer particles than this are not worth waking threads for.
constexpr std::ptrdiff_t particles_worth_threads = 2048;

template <int Dim>
std::ptrdiff_t particle_count(const State<Dim>& state) {
  std::size_t n = 0;
  for (const Body<Dim>& body : state.bodies) n += body.size();
  return static_cast<std::ptrdiff_t>(n);
}

template <int Dim>
bool holds_particles(const State<Dim>& state, int slab) {
  for (const Body<Dim>& body : state.bodies)
    if (body.slab_begin[slab] < body.slab_begin[slab + 1]) return true;
  return false;
}

/// Slabs of one colour that hold particles, ascending: the empty ones of a large domain are not shared out to threads.
template <int Dim>
std::vector<int> slabs_of_colour(const State<Dim>& state, const GridLayout<Dim>& layout, int colour) {
  std::vector<int> out;
  const int z_slabs = Dim == 3 ? layout.slabs[Dim - 1] : 1;
  for (int z = colour / 2; z < z_slabs; z += 2)
    for (int y = colour % 2; y < layout.slabs[1]; y += 2)
      if (const int slab = y + z * layout.slabs[1]; holds_particles(state, slab)) out.push_back(slab);
  return out;
}

/// f(body, begin, end) for every body's particles of every slab. Slabs of one colour run in parallel, colours in
/// order, so each node receives its contributions in the same order whatever the number of threads.
template <int Dim, class F>
void for_each_slab_by_colour(const State<Dim>& state, const GridLayout<Dim>& layout, F&& f) {
  const bool threads = particle_count(state) >= particles_worth_threads;
  for (int colour = 0; colour < slab_colours<Dim>; ++colour) {
    const std::vector<int> slabs = slabs_of_colour(state, layout, colour);
    const auto n = static_cast<std::ptrdiff_t>(slabs.size());
#pragma omp parallel for schedule(dynamic, 1) if (threads)
    for (std::ptrdiff_t s = 0; s < n; ++s)
      for (const Body<Dim>& body : state.bodies) {
        const std::size_t begin = body.slab_begin[slabs[s]], end = body.slab_begin[slabs[s] + 1];
        if (begin < end) f(body, begin, end);
      }
  }
}

}  // namespace

template <int Dim>
void clear_grid(const State<Dim>& state, Grid<Dim>& grid) {
  for_each_active_row(state, grid.layout, [&](int begin, int count, const auto&) {
    const auto zero = [&](auto& field) {
      if (!field.empty())
        std::fill_n(field.begin() + begin, count, typename std::decay_t<decltype(field)>::value_type{});
    };
    zero(grid.sum);
    zero(grid.force);
    zero(grid.cell_volume);
    zero(grid.cell_pressure);
    for (auto* field : {&grid.node_volume, &grid.node_pressure, &grid.node_rate}) zero(*field);
  });
}

template <int Dim>
void sum_particles_in_cells(const State<Dim>& state, Grid<Dim>& grid) {
  for_each_slab_by_colour(state, grid.layout, [&](const Body<Dim>& body, std::size_t begin, std::size_t end) {
    sum_cells<Dim>(body, grid, begin, end);
  });
}

namespace {

/// Sums over particles become means over the volumes that reach a node.
template <int Dim>
void divide_by_volume(const State<Dim>& state, Grid<Dim>& grid, Array<double>& field) {
  for_each_active_row(state, grid.layout, [&](int begin, int count, const auto&) {
    for (int node = begin; node < begin + count; ++node)
      if (grid.node_volume[node] > 0) field[node] /= grid.node_volume[node];
  });
}

}  // namespace

template <int Dim>
void average_nodal_pressure(const State<Dim>& state, Grid<Dim>& grid) {
  for_each_slab_by_colour(state, grid.layout, [&](const Body<Dim>& body, std::size_t begin, std::size_t end) {
    if (body.pressure == PressureSupport::nodal) sum_nodal_pressure<Dim>(body, grid, begin, end);
  });
  divide_by_volume(state, grid, grid.node_pressure);
}

template <int Dim>
void average_nodal_rate(const State<Dim>& state, Grid<Dim>& grid) {
  for_each_slab_by_colour(state, grid.layout, [&](const Body<Dim>& body, std::size_t begin, std::size_t end) {
    if (body.pressure == PressureSupport::nodal) sum_nodal_rate<Dim>(body, grid, begin, end);
  });
  divide_by_volume(state, grid, grid.node_rate);
}

template <int Dim>
void remap_velocity(const SolverSpec& solver, State<Dim>& state, Grid<Dim>& grid, double dt) {
  const GatherOptions options{dt, std::exp(-solver.blend_rate * dt), std::exp(-solver.damping_rate * dt)};
  constexpr std::size_t share = 16 * chunk_size;
  for (Body<Dim>& body : state.bodies) {
    const auto tasks = static_cast<std::ptrdiff_t>((body.size() + share - 1) / share);
#pragma omp parallel for schedule(dynamic, 4) if (static_cast <std::ptrdiff_t>(body.size()) >= particles_worth_threads)
    for (std::ptrdiff_t task = 0; task < tasks; ++task)
      update_velocity<Dim>(body, grid, options, task * share, std::min(body.size(), (task + 1) * share));
  }
  for_each_active_row(state, grid.layout, [&](int begin, int count, const auto&) {
    for (int node = begin; node < begin + count; ++node)
      for (int a = 0; a < Dim; ++a) grid.sum[node][a] = 0;
  });
  for_each_slab_by_colour(state, grid.layout, [&](const Body<Dim>& body, std::size_t begin, std::size_t end) {
    sum_momentum<Dim>(body, grid, begin, end);
  });
  for_each_active_row(state, grid.layout, [&](int begin, int count, const auto&) {
    for (int node = begin; node < begin + count; ++node) {
      const double m = grid.sum[node][3];
      for (int a = 0; a < Dim; ++a) grid.velocity[node][a] = m > 0 ? grid.sum[node][a] / m : 0.0;
    }
  });
  impose_wall_velocity(state, grid);
}

template <int Dim>
void particles_to_grid(const State<Dim>& state, Grid<Dim>& grid, double dt) {
  for_each_slab_by_colour(state, grid.layout, [&](const Body<Dim>& body, std::size_t begin, std::size_t end) {
    scatter<Dim>(body, grid, dt, begin, end);
  });
}

template <int Dim>
void grid_to_particles(const SolverSpec& solver, State<Dim>& state, Grid<Dim>& grid, double dt) {
  constexpr std::size_t share =
      16 * chunk_size;  // particles per task: fixed, so that packets fall the same way for any thread count
  const GatherOptions options{dt, std::exp(-solver.blend_rate * dt), std::exp(-solver.damping_rate * dt)};
  double v_max = 0, displacement = 0;
  for (Body<Dim>& body : state.bodies) {
    const auto tasks = static_cast<std::ptrdiff_t>((body.size() + share - 1) / share);
    grid.chunk_maxima.assign(2 * tasks, 0.0);
#pragma omp parallel for schedule(dynamic, 4) if (static_cast <std::ptrdiff_t>(body.size()) >= particles_worth_threads)
    for (std::ptrdiff_t task = 0; task < tasks; ++task) {
      const std::size_t begin = task * share, end = std::min(body.size(), begin + share);
      const Maxima maxima = gather<Dim>(body, grid, options, begin, end);
      grid.chunk_maxima[2 * task] = std::sqrt(maxima.speed2);
      // A particle outside makes the next sort due, which then names it.
      grid.chunk_maxima[2 * task + 1] = maxima.outside ? std::numeric_limits<double>::infinity() : maxima.displacement;
    }
    for (std::ptrdiff_t task = 0; task < tasks; ++task) {
      const double speed = grid.chunk_maxima[2 * task];
      if (!(speed <= v_max) && !std::isnan(v_max)) v_max = speed;  // NaN stays: stable_dt reports it
      displacement = std::max(displacement, grid.chunk_maxima[2 * task + 1]);
    }
  }
  state.v_max = v_max;
  state.drift += displacement;
}

#define GEODROP_INSTANTIATE(D)                                           \
  template void clear_grid<D>(const State<D>&, Grid<D>&);                \
  template void sum_particles_in_cells<D>(const State<D>&, Grid<D>&);    \
  template void average_nodal_pressure<D>(const State<D>&, Grid<D>&);    \
  template void average_nodal_rate<D>(const State<D>&, Grid<D>&);        \
  template void remap_velocity<D>(const SolverSpec&, State<D>&, Grid<D>&, double); \
  template void particles_to_grid<D>(const State<D>&, Grid<D>&, double); \
  template void grid_to_particles<D>(const SolverSpec&, State<D>&, Grid<D>&, double);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
