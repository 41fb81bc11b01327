#include "membrane_force.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/polygon.hpp"
#include "grid/point_support.hpp"
#include "move_skins.hpp"
#include "tension_gauge.hpp"
#include "triangles.hpp"

namespace geodrop {
namespace {

template <int Dim>
std::array<double, Dim> segment_vector(const Membrane<Dim>& membrane, std::size_t s) {
  std::array<double, Dim> d;
  for (int a = 0; a < Dim; ++a) d[a] = membrane.x[a][end_of_edge(s, membrane.nodes())] - membrane.x[a][s];
  return d;
}

template <std::size_t Dim>
double length(const std::array<double, Dim>& d) {
  double sum = 0;
  for (const double c : d) sum += c * c;
  return std::sqrt(sum);
}

template <int Dim>
PointSupport<Dim> support_of_node(const GridLayout<Dim>& layout, const Membrane<Dim>& membrane, std::size_t k) {
  return {layout, place_at(membrane.x, k), membrane.half_size};
}

/// m (v, 1) of a node.
template <int Dim>
Vec4 momentum_of_node(const Membrane<Dim>& membrane, std::size_t k) {
  Vec4 momentum{};
  for (int a = 0; a < Dim; ++a) momentum[a] = membrane.mass[k] * membrane.v[a][k];
  momentum[3] = membrane.mass[k];
  return momentum;
}

template <int Dim>
void membrane_to_grid(const Membrane<Dim>& membrane, Grid<Dim>& grid, double dt) {
  const auto force = membrane_forces(membrane);
  const bool separate = !grid.force.empty();
  for (std::size_t k = 0; k < membrane.nodes(); ++k) {
    Vec4 momentum = momentum_of_node(membrane, k), f{};
    for (int a = 0; a < Dim; ++a) {
      f[a] = force[a][k];
      if (!membrane.load[a].empty()) f[a] += membrane.load[a][k];
      if (!membrane.caught[a].empty()) f[a] += membrane.caught[a][k] / dt;
    }
    if (!separate) momentum += dt * f;
    const PointSupport<Dim> support = support_of_node(grid.layout, membrane, k);
    support.for_each_node(grid.layout, [&](int node, double weight) {
      grid.sum[node] += weight * momentum;
      if (separate) grid.force[node] += weight * f;
    });
  }
}

/// A tracer has no extent of its own; with Basis::gimp it sees what a particle of a quarter cell's half width sees [h].
constexpr double tracer_half_size = 0.25;

/// Where a tracer is seen; its own coordinates run on across periodic walls, so that displacements do not jump.
template <int Dim>
std::array<double, Dim> in_domain(const GridLayout<Dim>& layout, std::array<double, Dim> x) {
  for (int a = 0; a < Dim; ++a) x[a] = layout.wrapped(a, x[a]);
  return x;
}

/// Whether the nodes of a membrane move with this field; those of sharp skins do so in move_skins.
template <int Dim>
bool moves_with(const Grid<Dim>& grid, const Membrane<Dim>& membrane) {
  if constexpr (Dim == 2)
    if (is_sharp_skin(membrane)) return false;
  return membrane.field == grid.field;
}

}  // namespace

template <int Dim>
double back_on_grid(const GridLayout<Dim>& layout, int axis, double x) {
  const double round_off = 1e-9 * layout.h, lower = layout.lower[axis], upper = layout.upper[axis];
  const bool near = x > lower - round_off && x < upper + round_off;
  return near ? std::clamp(x, lower, upper) : x;
}

template <int Dim>
void update_tension(Membrane<Dim>& membrane) {
  if constexpr (Dim == 3) return update_triangles(membrane);
  for (std::size_t s = 0; s < membrane.segments(); ++s) {
    membrane.strain[s] = length(segment_vector(membrane, s)) / membrane.rest_length[s] - 1;
    membrane.tension[s] = std::max(0.0, membrane.axial_stiffness * membrane.strain[s]);
  }
}

template <int Dim>
std::array<Array<double>, Dim> membrane_forces(const Membrane<Dim>& membrane) {
  if constexpr (Dim == 3) return triangle_forces(membrane);
  std::array<Array<double>, Dim> force;
  for (auto& component : force) component.assign(membrane.nodes(), 0.0);
  for (std::size_t r = 0; r < membrane.segments(); ++r) {
    const auto d = segment_vector(membrane, r);
    const double now = length(d);
    const double scale = now > 0 ? membrane.tension[r] / now : 0.0;  // two nodes in one place: no direction
    for (int a = 0; a < Dim; ++a) {
      force[a][r] += scale * d[a];
      force[a][end_of_edge(r, membrane.nodes())] -= scale * d[a];
    }
  }
  return force;
}

template <int Dim>
std::array<Array<double>, Dim> node_velocities(const Membrane<Dim>& membrane, const Grid<Dim>& grid) {
  std::array<Array<double>, Dim> out;
  for (auto& component : out) component.resize(membrane.nodes());
  for (std::size_t k = 0; k < membrane.nodes(); ++k) {
    const Vec4 v = interpolate(grid.layout, support_of_node(grid.layout, membrane, k), grid.velocity);
    for (int a = 0; a < Dim; ++a) out[a][k] = v[a];
  }
  return out;
}

template <int Dim>
void clear_membrane_loads(State<Dim>& state) {
  for (Membrane<Dim>& membrane : state.membranes)
    for (auto& component : membrane.load) std::fill(component.begin(), component.end(), 0.0);
}

template <int Dim>
void membranes_to_grid(State<Dim>& state, Grid<Dim>& grid, double t, double dt) {
  for (Membrane<Dim>& membrane : state.membranes) {
    if (membrane.field != grid.field) continue;
    update_tension(membrane);
    add_to_gauge(t, dt, membrane);
    membrane_to_grid(membrane, grid, dt);
  }
}

template <int Dim>
void update_membrane_velocity(const SolverSpec& solver, State<Dim>& state, const Grid<Dim>& grid, double dt) {
  const bool blend = solver.transfer != Transfer::tpic;
  const double keep = blend ? std::exp(-solver.blend_rate * dt) : 0.0;
  const double damping = std::exp(-state.damping_rate * dt);
  for (Membrane<Dim>& membrane : state.membranes) {
    if (!moves_with(grid, membrane)) continue;
    for (std::size_t k = 0; k < membrane.nodes(); ++k) {
      const PointSupport<Dim> support = support_of_node(grid.layout, membrane, k);
      const Vec4 v = interpolate(grid.layout, support, grid.velocity);
      const Vec4 change = blend ? interpolate(grid.layout, support, grid.velocity_change) : Vec4{};
      for (int a = 0; a < Dim; ++a)
        membrane.v[a][k] = damping * (keep * (membrane.v[a][k] + change[a]) + (1 - keep) * v[a]);
    }
  }
}

template <int Dim>
void sum_membrane_momentum(const State<Dim>& state, Grid<Dim>& grid) {
  for (const Membrane<Dim>& membrane : state.membranes)
    for (std::size_t k = 0; membrane.field == grid.field && k < membrane.nodes(); ++k) {
      const Vec4 momentum = momentum_of_node(membrane, k);
      const PointSupport<Dim> support = support_of_node(grid.layout, membrane, k);
      support.for_each_node(grid.layout, [&](int node, double weight) { grid.sum[node] += weight * momentum; });
    }
}

template <int Dim>
void grid_to_membranes(const SolverSpec& solver, State<Dim>& state, const Grid<Dim>& grid, double dt) {
  if (solver.transfer != Transfer::musl) update_membrane_velocity(solver, state, grid, dt);
  double displacement = 0;
  for (Membrane<Dim>& membrane : state.membranes) {
    if (!moves_with(grid, membrane)) continue;
    for (std::size_t k = 0; k < membrane.nodes(); ++k) {
      const PointSupport<Dim> support = support_of_node(grid.layout, membrane, k);
      const Vec4 v = interpolate(grid.layout, support, grid.velocity);
      for (int a = 0; a < Dim; ++a) {
        membrane.x[a][k] = back_on_grid(grid.layout, a, membrane.x[a][k] + dt * v[a]);
        displacement = std::max(displacement, std::abs(dt * v[a]));
      }
      check_on_grid<Dim>(grid.layout, place_at(membrane.x, k), "a node of membrane", membrane.name);
    }
  }
  state.drift += displacement;
}

template <int Dim>
void grid_to_tracers(State<Dim>& state, const Grid<Dim>& grid, double dt) {
  for (Tracer<Dim>& tracer : state.tracers) {
    if (tracer.field != grid.field) continue;
    const Vec4 v = interpolate(grid.layout,
                               PointSupport<Dim>(grid.layout, in_domain<Dim>(grid.layout, tracer.x), tracer_half_size),
                               grid.velocity);
    for (int a = 0; a < Dim; ++a) {
      tracer.v[a] = v[a];
      tracer.x[a] += dt * v[a];
    }
    check_on_grid<Dim>(grid.layout, in_domain<Dim>(grid.layout, tracer.x), "tracer", tracer.name);
  }
}

#define GEODROP_INSTANTIATE(D)                                                                     \
  template double back_on_grid<D>(const GridLayout<D>&, int, double);                              \
  template void update_tension<D>(Membrane<D>&);                                                   \
  template std::array<Array<double>, D> membrane_forces<D>(const Membrane<D>&);                    \
  template std::array<Array<double>, D> node_velocities<D>(const Membrane<D>&, const Grid<D>&);    \
  template void clear_membrane_loads<D>(State<D>&);                                                \
  template void membranes_to_grid<D>(State<D>&, Grid<D>&, double, double);                         \
  template void update_membrane_velocity<D>(const SolverSpec&, State<D>&, const Grid<D>&, double); \
  template void sum_membrane_momentum<D>(const State<D>&, Grid<D>&);                               \
  template void grid_to_membranes<D>(const SolverSpec&, State<D>&, const Grid<D>&, double);        \
  template void grid_to_tracers<D>(State<D>&, const Grid<D>&, double);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
