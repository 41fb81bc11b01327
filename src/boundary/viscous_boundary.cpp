#include "viscous_boundary.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/geometry/shapes.hpp>
#include <geodrop/grid/graded_axis.hpp>

#include <algorithm>
#include <cmath>

#include "grid/momentum.hpp"
#include "grid/neighbourhood.hpp"
#include "grid/point_support.hpp"
#include "solutions/initial_stress.hpp"

namespace geodrop {
namespace {

constexpr double points_per_cell = 2;

/// Width along the normal of the cells that a place is in [m].
double cell_across(const Scene& scene, const Point& place, const std::array<double, 2>& normal) {
  const GridLayout<2> layout(scene.grid, scene.walls);
  const int axis = std::abs(normal[0]) > std::abs(normal[1]) ? 0 : 1;
  return layout.h * layout.span_width(axis, layout.base(axis, place[axis]));
}

/// Points beside the middle of equal parts of the line, at rest.
void place_points(const Point& from, const Point& to, double cell, ViscousBoundary<2>& boundary) {
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
  const int count = std::max(1, static_cast<int>(std::ceil(points_per_cell * length / cell - 1e-9)));
  boundary.length = length / count;
  for (int a = 0; a < 2; ++a) {
    for (int k = 0; k < count; ++k)
      boundary.x[a].push_back(from[a] + (to[a] - from[a]) * (k + 0.5) / count - boundary.inwards * boundary.normal[a]);
    boundary.v[a].assign(count, 0.0);
    boundary.moved[a].assign(count, 0.0);
  }
}

template <int Dim>
PointSupport<Dim> support_of(const GridLayout<Dim>& layout, const ViscousBoundary<Dim>& boundary, std::size_t k) {
  return {layout, place_at(boundary.x, k), boundary.half_size};
}

template <int Dim>
Vec4 lanes(const Vec<Dim>& v) {
  Vec4 out{};
  for (int a = 0; a < Dim; ++a) out[a] = v[a];
  return out;
}

/// Where the edge itself is beside a point, as hats (B-splines: as they) see it: what the stresses of the particles
/// leave over there.
template <int Dim>
PointSupport<Dim> support_at_edge(const GridLayout<Dim>& layout, const ViscousBoundary<Dim>& boundary, std::size_t k) {
  constexpr double of_hats = 1e-9;
  std::array<double, Dim> x;
  for (int a = 0; a < Dim; ++a) x[a] = layout.wrapped(a, boundary.x[a][k] + boundary.inwards * boundary.normal[a]);
  return {layout, x, of_hats};
}

/// All of the push goes to nodes with a mass: those that particles hardly reach would fly off with their share.
template <int Dim>
void scatter(const PointSupport<Dim>& support, const Vec4& push, const Grid<Dim>& grid, Array<Vec4>& target) {
  const auto takes = [&](int node, double weight) {
    return grid.sum[node][3] > light_mass<Dim>(grid, stored_cell(grid.layout, node)) * weight;
  };
  double reached = 0;
  support.for_each_node(grid.layout, [&](int node, double weight) { reached += takes(node, weight) ? weight : 0.0; });
  if (reached <= 0) return;  // the ground has left this place
  support.for_each_node(grid.layout, [&](int node, double weight) {
    if (takes(node, weight)) target[node] += weight / reached * push;
  });
}

}  // namespace

ViscousBoundary<2> make_viscous_boundary(const Scene& scene, const ViscousBoundarySpec& spec, const State<2>& state) {
  const BodySpec& body = *find_body(scene, spec.body);
  const Material& ground = find_named(state.bodies, spec.body).material;
  const double cell = finest_spacing(scene.grid);
  const Point normal = outward_normal(body.shape, spec.from, spec.to, cell / 4).value();
  ViscousBoundary<2> boundary;
  boundary.name = spec.name;
  boundary.field = find_named(state.bodies, spec.body).field;
  boundary.half_size = 0.5 / body.particles_per_cell_axis;
  boundary.normal = {normal[0], normal[1]};
  boundary.impedance_p = impedance(ground);
  boundary.impedance_s = reference_density(ground) * shear_wave_speed(ground);
  boundary.spring = impedance(ground) * wave_speed(ground) / spec.spring_depth;
  boundary.inwards = boundary.half_size * cell_across(scene, spec.from, boundary.normal);
  place_points(spec.from, spec.to, cell, boundary);
  for (const double y : boundary.x[1]) {
    const TotalStress stress = initial_total_stress(scene, body, y + boundary.inwards * normal[1]);
    boundary.at_start[0].push_back(stress.horizontal * normal[0]);
    boundary.at_start[1].push_back(stress.vertical * normal[1]);
  }
  return boundary;
}

template <int Dim>
Vec<Dim> yielding_traction(const ViscousBoundary<Dim>& boundary, std::size_t point) {
  const Vec<Dim> n(boundary.normal.data()), v = vector_at(boundary.v, point), u = vector_at(boundary.moved, point);
  const double v_n = n.dot(v);
  return -boundary.impedance_s * (v - v_n * n) - (boundary.impedance_p * v_n + boundary.spring * n.dot(u)) * n;
}

template <int Dim>
double boundary_potential(const State<Dim>& state) {
  double potential = 0;
  for (const ViscousBoundary<Dim>& boundary : state.viscous_boundaries)
    for (std::size_t k = 0; k < boundary.points(); ++k) {
      const Vec<Dim> u = vector_at(boundary.moved, k);
      const double u_n = Vec<Dim>(boundary.normal.data()).dot(u);
      potential += boundary.length * (0.5 * boundary.spring * u_n * u_n - vector_at(boundary.at_start, k).dot(u));
    }
  return potential;
}

template <int Dim>
void boundaries_to_grid(const State<Dim>& state, Grid<Dim>& grid, double dt) {
  const bool separate = !grid.force.empty();
  Array<Vec4>& target = separate ? grid.force : grid.sum;
  for (const ViscousBoundary<Dim>& boundary : state.viscous_boundaries) {
    if (boundary.field != grid.field) continue;
    const double scale = boundary.length * (separate ? 1.0 : dt);
    for (std::size_t k = 0; k < boundary.points(); ++k) {
      scatter(support_at_edge(grid.layout, boundary, k), lanes<Dim>(scale * vector_at(boundary.at_start, k)), grid,
              target);
      scatter(support_of(grid.layout, boundary, k), lanes<Dim>(scale * yielding_traction(boundary, k)), grid, target);
    }
  }
}

template <int Dim>
void grid_to_boundaries(State<Dim>& state, const Grid<Dim>& grid, double dt) {
  double displacement = 0;
  for (ViscousBoundary<Dim>& boundary : state.viscous_boundaries)
    for (std::size_t k = 0; boundary.field == grid.field && k < boundary.points(); ++k) {
      const Vec4 v = interpolate(grid.layout, support_of(grid.layout, boundary, k), grid.velocity);
      for (int a = 0; a < Dim; ++a) {
        boundary.v[a][k] = v[a];
        boundary.moved[a][k] += dt * v[a];
        boundary.x[a][k] = grid.layout.wrapped(a, boundary.x[a][k] + dt * v[a]);
        displacement = std::max(displacement, std::abs(dt * v[a]));
      }
      check_on_grid<Dim>(grid.layout, place_at(boundary.x, k), "a point of viscous boundary", boundary.name);
    }
  state.drift += displacement;
}

#define GEODROP_INSTANTIATE(D)                                                  \
  template Vec<D> yielding_traction<D>(const ViscousBoundary<D>&, std::size_t); \
  template double boundary_potential<D>(const State<D>&);                       \
  template void boundaries_to_grid<D>(const State<D>&, Grid<D>&, double);       \
  template void grid_to_boundaries<D>(State<D>&, const Grid<D>&, double);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
