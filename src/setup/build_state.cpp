// From the scene to the state at t = 0.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <geodrop/base/find_named.hpp>
#include <geodrop/geometry/shapes.hpp>
#include <geodrop/geometry/triangle_surface.hpp>
#include <geodrop/grid/graded_axis.hpp>
#include <geodrop/measure/measure.hpp>
#include <geodrop/scene/velocity_fields.hpp>
#include <geodrop/setup/setup.hpp>
#include <geodrop/solutions/exact.hpp>
#include <limits>
#include <map>
#include <numeric>

#include "boundary/silent_side.hpp"
#include "boundary/viscous_boundary.hpp"
#include "contact/membrane_contact.hpp"
#include "contact/space_contact.hpp"
#include "contact/space_surface.hpp"
#include "contact/surface_contact.hpp"
#include "fill_particles.hpp"
#include "geometry/surface_ends.hpp"
#include "initial_velocity.hpp"
#include "measure/probes/probes.hpp"
#include "membrane/anchors.hpp"
#include "membrane/membrane_nodes.hpp"
#include "membrane/tension_gauge.hpp"
#include "membrane/triangles.hpp"
#include "scene/needs.hpp"
#include "scene_stages.hpp"
#include "solutions/initial_stress.hpp"
#include "start_from.hpp"

namespace geodrop {
namespace {

/// Arrays that the motion and the law need; a body without a quantity keeps its array empty.
template <int Dim>
void allocate(Body<Dim>& body) {
  for_each_array<particle_role::every_body>(body, [&](Array<double>& values) { values.resize(body.J.size(), 0.0); });
  set_unstrained(body);
}

/// A body of uniform stretch is filled unstrained: its lattice is stretched with it, so that it is out of step with the
/// grid. J then holds the present volume [m3], as fill_particles leaves it.
template <int Dim>
void fill_stretched(Scene scene, BodySpec spec, const UniformMotion<Dim>& motion, Body<Dim>& body) {
  auto& box = std::get<BoxShape>(spec.shape);
  for (int a = 0; a < Dim; ++a)
    for (Point* corner : {&box.lower, &box.upper, &scene.grid.lower, &scene.grid.upper})
      (*corner)[a] /= motion.stretch[a];
  for (RefineSpec& zone : scene.grid.refine)
    for (double* end : {&zone.from, &zone.to}) *end /= motion.stretch[zone.axis];
  fill_particles(scene, spec, body);
  for (int a = 0; a < Dim; ++a)
    for (double& x : body.x[a]) x *= motion.stretch[a];
  for (double& volume : body.J) volume *= motion.stretch.prod();
}

template <int Dim>
void fill(const Scene& scene, const BodySpec& spec, Body<Dim>& body) {
  if (std::holds_alternative<FromExactSpec>(spec.initial_stress)) {
    const ExactSolution<Dim> solution = exact_solution<Dim>(scene, spec.name);
    if (const auto* motion = std::get_if<UniformMotion<Dim>>(&solution))
      return fill_stretched(scene, spec, *motion, body);
  }
  fill_particles(scene, spec, body);
}

template <int Dim>
Body<Dim> build_body(const Scene& scene, const BodySpec& spec, const State<Dim>* earlier) {
  Body<Dim> body;
  body.name = spec.name;
  body.material_name = spec.material;
  body.material = law_of(scene, spec);
  body.pressure = spec.pressure;
  if (spec.implicit_pore_pressure) body.implicit_pores = {0};
  body.shift = spec.shift;
  body.shift_speed = spec.shift_speed;
  body.half_size = 0.5 / spec.particles_per_cell_axis;
  fill(scene, spec, body);
  allocate(body);
  set_initial_stress(scene, spec, body);
  set_velocity(scene, spec, body);
  body.initial_x = body.x;
  if (const Body<Dim>* from = earlier ? find_or_null(earlier->bodies, spec.name) : nullptr) take_particles(*from, body);
  return body;
}

double distance(const Membrane<2>& membrane, std::size_t a, std::size_t b) {
  double sum = 0;
  for (int d = 0; d < 2; ++d) sum += std::pow(membrane.x[d][a] - membrane.x[d][b], 2);
  return std::sqrt(sum);
}

/// That of the body that it is on; at rest without one.
template <int Dim>
void set_cloth_velocity(const Scene& scene, const std::string& body, Membrane<Dim>& membrane) {
  for (auto& component : membrane.v) component.assign(membrane.x[0].size(), 0.0);
  if (!body.empty()) set_velocity(scene, *find_body(scene, body), membrane);
}

/// Rest length is the drawn length times 1 + slack; the fabric keeps its mass per rest length.
void draw_cloth(const Scene& scene, const MembraneSpec& spec, Membrane<2>& membrane) {
  const std::vector<Point> nodes = membrane_nodes(scene, spec);
  const std::size_t n = nodes.size();
  for (int a = 0; a < 2; ++a)
    for (const Point& x : nodes) membrane.x[a].push_back(x[a]);
  membrane.mass.assign(n, 0.0);
  const std::size_t segments = spec.closed ? n : n - 1;
  for (std::size_t s = 0; s < segments; ++s) {
    const std::size_t end = (s + 1) % n;
    const double rest = distance(membrane, s, end) * (1 + spec.slack);
    membrane.rest_length.push_back(rest);
    membrane.mass[s] += 0.5 * spec.mass_per_area * rest;
    membrane.mass[end] += 0.5 * spec.mass_per_area * rest;
  }
  set_cloth_velocity(scene, spec.body, membrane);
}

/// Water in the pores inside a membrane with so many segments or triangles, and how it flows through.
template <int Dim>
void set_pore_water(const Scene& scene, const MembraneSpec& spec, std::size_t parts, Membrane<Dim>& membrane) {
  const BodySpec* const soil = find_body(scene, body_inside(scene, spec));
  if (!soil || soil->saturated_by.empty()) return;
  const double open = spec.permittivity * (1 - spec.clogging);
  membrane.permeance = open / water_unit_weight(scene, *find_body(scene, soil->saturated_by));
  membrane.permeance_strains.assign(spec.permittivity_strains.begin(), spec.permittivity_strains.end());
  membrane.permeance_factors.assign(spec.permittivity_factors.begin(), spec.permittivity_factors.end());
  membrane.pore_pressure.assign(parts, 0.0);
  membrane.seepage.assign(parts, 0.0);
}

/// What a sharp membrane with so many segments or triangles meets around it.
template <int Dim>
void set_surroundings(const Scene& scene, const MembraneSpec& spec, std::size_t parts, Membrane<Dim>& membrane) {
  membrane.sharp = spec.interface == Interface::sharp;
  membrane.bed = spec.bed;
  membrane.bed_friction = spec.bed_friction;
  if (!membrane.sharp) return;
  membrane.shear = spec.shear;
  membrane.wall_friction = spec.wall_friction;
  membrane.roughness = spec.roughness;
  if (const NewtonianSpec* fluid = fluid_around(scene)) membrane.fluid_density = fluid->density;
  membrane.water_pressure.assign(parts, 0.0);
  if (lies_on_grains(scene, spec)) membrane.bed_pressure.assign(parts, 0.0);
  set_pore_water(scene, spec, parts, membrane);
  for (auto& component : membrane.caught) component.assign(membrane.nodes(), 0.0);
  if constexpr (Dim == 3)
    if (rubs_sharply(spec))
      for (Array<double>& component : membrane.triangles.water_shear) component.assign(parts, 0.0);
}

Membrane<2> build_membrane(const Scene& scene, const MembraneSpec& spec, const State<2>* earlier) {
  Membrane<2> membrane;
  membrane.name = spec.name;
  membrane.body = body_inside(scene, spec);
  membrane.closed = spec.closed;
  membrane.axial_stiffness = spec.axial_stiffness;
  membrane.strength = spec.strength;
  membrane.contents_friction = slides(scene, spec) ? contents_friction(scene, spec) : 0;
  membrane.gauge_length = spec.gauge_length;
  membrane.half_size = 0.5 / spec.segments_per_cell;
  if (const Membrane<2>* from = earlier ? find_or_null(earlier->membranes, spec.name) : nullptr)
    take_cloth(*from, membrane);
  else
    draw_cloth(scene, spec, membrane);
  const std::size_t n = membrane.nodes(), segments = membrane.segments();
  membrane.strain.assign(segments, 0.0);
  membrane.tension.assign(segments, 0.0);
  if (spec.axial_stiffness > 0) membrane.gauge.sums.assign(gauge_slots * segments, 0.0);
  if (slides(scene, spec)) {
    const double rest = std::accumulate(membrane.rest_length.begin(), membrane.rest_length.end(), 0.0);
    for (const double part : membrane.rest_length) membrane.share.push_back(part / rest);
    if (membrane.contents_friction > 0) membrane.contents_pressure.assign(n, 0.0);
  }
  set_surroundings(scene, spec, segments, membrane);
  if (membrane.sharp) {
    membrane.drag_coefficient = spec.drag_coefficient;
    membrane.water_shear.assign(segments, 0.0);
    if (!spec.bed.empty()) membrane.bed_shear.assign(segments, 0.0);
  }
  return membrane;
}

/// Corners, areas and edges at rest, (1 + slack) times what the cloth is cut out as.
void set_triangles(const MembraneSpec& spec, const TriangleSurface& surface, Membrane<3>& membrane) {
  const std::vector<Corner>& flat = surface.unstretched.empty() ? surface.points : surface.unstretched;
  const Eigen::Vector3d warp = spec.warp.empty() ? Eigen::Vector3d::UnitX() : Eigen::Vector3d(spec.warp.data());
  MembraneTriangles<3>& triangles = membrane.triangles;
  for (const auto& triangle : surface.triangles) {
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = (1 + spec.slack) * Eigen::Vector3d(flat[triangle[k]].data());
      triangles.corner[k].push_back(triangle[k]);
    }
    const Eigen::Matrix2d edges = rest_edges(corners, warp), inverse = edges.inverse();
    for (int c = 0; c < 4; ++c) triangles.inverse_rest[static_cast<std::size_t>(c)].push_back(inverse(c / 2, c % 2));
    const double area = 0.5 * edges.determinant();
    triangles.rest_area.push_back(area);
    for (const std::uint32_t corner : triangle) membrane.mass[corner] += spec.mass_per_area * area / 3;
  }
}

void draw_surface_cloth(const Scene& scene, const MembraneSpec& spec, Membrane<3>& membrane) {
  const TriangleSurface& surface = *spec.drawn.cloth;
  for (std::size_t a = 0; a < 3; ++a)
    for (const Corner& x : surface.points) membrane.x[a].push_back(x[a]);
  membrane.mass.assign(surface.points.size(), 0.0);
  set_triangles(spec, surface, membrane);
  for (const SurfaceEnd& end : spec.drawn.ends)
    for (const auto& [from, to] : open_edges(surface, end)) {
      auto& [starts, stops, wall] = membrane.triangles.open_edge;
      starts.push_back(from);
      stops.push_back(to);
      wall.push_back(wall_number(end.axis, end.upper));
    }
  set_cloth_velocity(scene, membrane.body, membrane);
}

Membrane<3> build_surface(const Scene& scene, const MembraneSpec& spec, const State<3>* earlier) {
  Membrane<3> membrane;
  membrane.name = spec.name;
  membrane.body = body_inside(scene, spec);
  membrane.axial_stiffness = spec.axial_stiffness;
  membrane.strength = spec.strength;
  membrane.half_size = 0.5 / spec.segments_per_cell;
  membrane.triangles.fabric = spec.fabric;
  membrane.triangles.poisson_ratio = spec.fabric == Fabric::rubber ? 0.5 : spec.poisson_ratio;
  membrane.triangles.weft_stiffness = spec.weft_stiffness;
  membrane.triangles.weft_strength = spec.weft_strength;
  membrane.triangles.mass_per_area = spec.mass_per_area;
  membrane.triangles.gauge_pressure = spec.gauge_pressure;
  if (const Membrane<3>* from = earlier ? find_or_null(earlier->membranes, spec.name) : nullptr)
    take_cloth(*from, membrane);
  else
    draw_surface_cloth(scene, spec, membrane);
  const std::size_t triangles = membrane.triangles.size();
  for (Array<double>* values : {&membrane.strain, &membrane.tension, &membrane.triangles.cross_tension})
    values->assign(triangles, 0.0);
  if (spec.axial_stiffness > 0) membrane.gauge.sums.assign(gauge_slots * triangles, 0.0);
  set_surroundings(scene, spec, triangles, membrane);
  return membrane;
}

/// Field 0 if it is empty, which it is in space only: alone, or in the fluid around.
template <int Dim>
int field_of(const State<Dim>& state, const Membrane<Dim>& membrane) {
  return membrane.body.empty() ? 0 : find_named(state.bodies, membrane.body).field;
}

/// The body with the particle nearest to x; null in a scene of membranes alone.
template <int Dim>
const Body<Dim>* body_at(const State<Dim>& state, const std::array<double, Dim>& x) {
  double nearest = std::numeric_limits<double>::infinity();
  const Body<Dim>* found = nullptr;
  const Vec<Dim> at(x.data());
  for (const Body<Dim>& body : state.bodies)
    for (std::size_t p = 0; p < body.size(); ++p)
      if (const double distance = (vector_at(body.x, p) - at).squaredNorm(); distance < nearest) {
        nearest = distance;
        found = &body;
      }
  return found;
}

template <int Dim, class Wanted>
void allocate_loads(State<Dim>& state, Wanted wanted) {
  for (Membrane<Dim>& membrane : state.membranes)
    if (wanted(membrane))
      for (auto& component : membrane.load) component.assign(membrane.nodes(), 0.0);
}

/// Splits the initial pressure of enclosed fluids into that of their weight below their highest point, and the rest.
template <int Dim>
void enclose_fluids(const Scene& scene, const State<Dim>* earlier, State<Dim>& state) {
  std::map<int, int> count;  // by field
  for (Body<Dim>& body : state.bodies) {
    if (body.pressure != PressureSupport::enclosed) continue;
    const auto& fluid = std::get<Newtonian>(body.material);
    const Array<double>& height = body.x[vertical_axis<Dim>];
    body.enclosed = count[body.field]++;
    body.unit_weight = -scene.gravity[vertical_axis<Dim>] * fluid.density;
    allocate_loads(state, [&](const Membrane<Dim>& membrane) { return membrane.closed && membrane.body == body.name; });
    if (earlier && find_or_null(earlier->bodies, body.name)) continue;
    body.weightless_level = *std::max_element(height.begin(), height.end());
    for (std::size_t p = 0; p < body.size(); ++p) {
      const double of_weight = body.unit_weight * (body.weightless_level - height[p]);
      body.J[p] = fluid_volume_ratio(fluid, fluid_pressure(fluid, body.J[p]) - of_weight);
    }
  }
}

/// Gas takes its place in a particle at the pressure that it has.
template <int Dim>
void add_gas(double ratio, std::size_t p, Body<Dim>& water) {
  const auto& fluid = std::get<Newtonian>(water.material);
  const double J = fluid_volume_ratio(fluid, fluid_pressure(fluid, water.J[p]), ratio);
  water.mass[p] *= water.J[p] / J;
  water.J[p] = J;
  water.gas[p] = ratio;
}

/// Of the water in the place of a coupled soil only the share of the pores is there, and of that what gas leaves.
template <int Dim>
void fill_pores(const Scene& scene, const State<Dim>* earlier, State<Dim>& state) {
  for (const BodySpec& spec : scene.bodies) {
    if (spec.saturated_by.empty() || (earlier && find_or_null(earlier->bodies, spec.saturated_by))) continue;
    const CoupledSpec& pores = *pores_of(scene, spec);
    Body<Dim>& water = find_named(state.bodies, spec.saturated_by);
    const auto inside = [](const BodySpec& body, const Point& x) { return contains(body.shape, x); };
    for (std::size_t p = 0; p < water.size(); ++p) {
      Point x(Dim);
      for (int a = 0; a < Dim; ++a) x[a] = water.x[a][p];
      const bool cut = std::any_of(spec.minus.begin(), spec.minus.end(),
                                   [&](const std::string& name) { return inside(*find_body(scene, name), x); });
      if (!inside(spec, x) || cut) continue;
      water.mass[p] *= pores.porosity;
      if (pores.gas_ratio() > 0) add_gas(pores.gas_ratio(), p, water);
    }
  }
}

template <int Dim>
void add_contacts(const Scene& scene, State<Dim>& state) {
  for (const RigidSpec& spec : scene.rigid)
    if constexpr (Dim == 2)
      state.rigid.push_back(make_rigid_body(spec, scene.grid));
    else
      state.rigid.push_back(make_rigid_body(spec));
  for (const ContactSpec& spec : scene.contacts) {
    const ContactPair pair = contact_pair(scene, spec);
    if (pair.kind == ContactPair::Kind::membranes)
      state.membrane_contacts.push_back(make_membrane_contact(scene, spec, state));
    else if constexpr (Dim == 2)
      state.rigid_contacts.push_back(make_rigid_contact(scene, spec, state));
    else
      state.rigid_contacts.push_back(make_space_contact(scene, spec, state));
    allocate_loads(state, [&](const Membrane<Dim>& membrane) {
      return membrane.name == pair.touching || membrane.name == pair.other;
    });
  }
}

void add_boundaries(const Scene& scene, State<2>& state) {
  for (const ViscousBoundarySpec& spec : scene.viscous_boundaries)
    state.viscous_boundaries.push_back(make_viscous_boundary(scene, spec, state));
  for (const SilentSideSpec& spec : scene.silent_sides) state.silent_sides.push_back(make_silent_side(scene, spec));
}

}  // namespace

template <int Dim>
State<Dim> build_state(const Scene& scene, const State<Dim>* earlier) {
  State<Dim> state;
  state.drift = -1;  // sort before the first step
  state.damping_rate = scene.solver.damping_rate;
  const std::vector<int> fields = velocity_fields(scene);
  for (std::size_t b = 0; b < fields.size(); ++b) {
    state.bodies.push_back(build_body<Dim>(scene, scene.bodies[b], earlier));
    state.bodies.back().field = fields[b];
  }
  if (scene.solver.transfer == Transfer::musl)  // it knows no gradients, and never renews them
    for (Body<Dim>& body : state.bodies)
      for (auto& component : body.affine) std::fill(component.begin(), component.end(), 0.0);
  for (const MembraneSpec& spec : scene.membranes) {
    if constexpr (Dim == 2) state.membranes.push_back(build_membrane(scene, spec, earlier));
    if constexpr (Dim == 3) state.membranes.push_back(build_surface(scene, spec, earlier));
    Membrane<Dim>& membrane = state.membranes.back();
    membrane.field = field_of(state, membrane);
  }
  add_contacts(scene, state);
  for (const AnchorSpec& spec : scene.anchors) state.anchors.push_back(make_anchor(spec, state));
  if (Dim == 3 && any_membrane_load(scene)) allocate_loads(state, [](const Membrane<Dim>&) { return true; });
  for (const StillFluidSpec& spec : scene.still_fluids)
    allocate_loads(state, [&](const Membrane<Dim>& membrane) { return membrane.name == spec.membrane; });
  allocate_loads(state, [](const Membrane<Dim>& membrane) { return membrane.drag_coefficient > 0; });
  enclose_fluids(scene, earlier, state);
  fill_pores(scene, earlier, state);
  if constexpr (Dim == 2) add_boundaries(scene, state);
  for (const ProbeSpec& spec : scene.probes) {
    const auto* tracer = std::get_if<TracerSpec>(&spec.probe);
    if (!tracer) continue;
    Tracer<Dim> t{tracer->name, {}, {}, {}};
    std::copy_n(tracer->position.begin(), Dim, t.x.begin());
    t.initial_x = t.x;
    if (const Body<Dim>* const body = body_at<Dim>(state, t.x)) {
      t.field = body->field;
      t.body = body->name;
    }
    state.tracers.push_back(t);
  }
  for (const Body<Dim>& body : state.bodies)
    for (std::size_t p = 0; p < body.size(); ++p) {
      double speed2 = 0;
      for (int a = 0; a < Dim; ++a) speed2 += body.v[a][p] * body.v[a][p];
      state.v_max = std::max(state.v_max, std::sqrt(speed2));
    }
  let_bodies_wait(scene, state);
  if (!scene.stages.empty()) enter_due_stages(SceneStages(scene), state);
  if (scene.relaxation.damping != RelaxationSpec::Damping::none)
    state.relaxation.initial_potential = measure(state, scene.gravity).potential;
  return state;
}

template State<2> build_state<2>(const Scene&, const State<2>*);
template State<3> build_state<3>(const Scene&, const State<3>*);

}  // namespace geodrop
