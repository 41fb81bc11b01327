#include "snapshot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <geodrop/measure.hpp>
#include <limits>

#include "../contact/rigid_surface.hpp"

namespace geodrop {
namespace {

const std::vector<std::string> vector_components = {"X", "Y", "Z"};
const std::vector<std::string> tensor_components = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};

/// Which fields all particles have.
const std::vector<Field> particle_fields = {
    {"velocity", vector_components, {}}, {"displacement", vector_components, {}},
    {"stress", tensor_components, {}},   {"mean_pressure", {}, {}},
    {"pore_pressure", {}, {}},           {"deviatoric_strain", {}, {}},
    {"volumetric_strain", {}, {}},       {"density", {}, {}}};

float narrow(double value) { return static_cast<float>(value); }

/// Writes one particle's values into its places of the fields.
template <int Dim>
void copy_particle(const Body<Dim>& body, std::size_t p, std::size_t to, ParticleSnapshot& out) {
  const auto values = [&](std::size_t field) { return &out.fields[field].values[to * out.fields[field].width()]; };
  const std::uint32_t id = body.id[p];
  for (int a = 0; a < Dim; ++a) {
    out.points[3 * to + a] = body.x[a][p];
    values(0)[a] = narrow(body.v[a][p]);
    values(1)[a] = narrow(body.x[a][p] - body.initial_x[a][id]);
  }
  const auto stress = total_stress(body, p);
  for (int k = 0; k < stress_components<Dim>; ++k) values(2)[k] = narrow(stress[k]);
  *values(3) = narrow(mean_pressure(body, p));
  *values(4) = body.pore_pressure.empty() ? 0.0F : narrow(body.pore_pressure[p]);
  *values(5) = body.deviatoric_strain.empty() ? 0.0F : narrow(body.deviatoric_strain[p]);
  *values(6) = narrow(body.J[p] - 1);
  *values(7) = narrow(reference_density(body.material) / body.J[p]);
  if (!body.gap.empty()) *values(particle_fields.size()) = narrow(body.gap[p]);
  out.layer[to] = body.layer.empty() ? 0 : body.layer[id];
  out.id[to] = id;
}

/// Another field, which only some particles have, is their gap.
enum class Voids { none, some };

ParticleSnapshot make_room(std::size_t particles, Voids voids) {
  ParticleSnapshot out;
  out.points.resize(3 * particles);
  out.fields = particle_fields;
  if (voids == Voids::some) out.fields.push_back({"gap", {}, {}});
  for (Field& field : out.fields) field.values.resize(field.width() * particles);
  out.layer.resize(particles);
  out.material.resize(particles);
  out.body.resize(particles);
  out.id.resize(particles);
  return out;
}

template <int Dim>
ParticleSnapshot copy_particles(const State<Dim>& state, const std::vector<std::string>& materials) {
  std::size_t count = 0;
  Voids voids = Voids::none;
  for (const Body<Dim>& body : state.bodies) {
    if (body.field == waiting) continue;
    count += body.size();
    if (!body.gap.empty()) voids = Voids::some;
  }
  ParticleSnapshot out = make_room(count, voids);
  std::size_t first = 0;
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const Body<Dim>& body = state.bodies[b];
    if (body.field == waiting) continue;
    const auto material = std::find(materials.begin(), materials.end(), body.material_name) - materials.begin();
#pragma omp parallel for schedule(static)
    for (std::size_t p = 0; p < body.size(); ++p) {
      copy_particle(body, p, first + p, out);
      out.material[first + p] = static_cast<std::uint32_t>(material);
      out.body[first + p] = static_cast<std::uint32_t>(b);
    }
    first += body.size();
  }
  return out;
}

template <int Dim>
void append_membrane(const Membrane<Dim>& membrane, std::uint32_t index, MembraneSnapshot& out) {
  const auto first = static_cast<std::uint32_t>(out.points.size() / 3);
  const auto nodes = static_cast<std::uint32_t>(membrane.nodes());
  for (std::uint32_t i = 0; i < nodes; ++i)
    for (int a = 0; a < 3; ++a) out.points.push_back(a < Dim ? membrane.x[a][i] : 0.0);
  for (std::uint32_t s = 0; s < membrane.segments(); ++s) {
    out.connectivity.push_back(first + s);
    out.connectivity.push_back(first + (s + 1) % nodes);
    out.fields[0].values.push_back(narrow(membrane.tension[s]));
    out.fields[1].values.push_back(narrow(membrane.strain[s]));
    out.fields[2].values.push_back(membrane.strength > 0 ? narrow(membrane.tension[s] / membrane.strength)
                                                         : std::numeric_limits<float>::quiet_NaN());
    out.membrane.push_back(index);
  }
}

void append_rigid(const RigidBody<2>& body, std::uint32_t index, RigidSnapshot& out) {
  const RigidSurface surface(body);
  const std::vector<Vec<2>> corners = outline(body);
  const auto first = static_cast<std::uint32_t>(out.points.size() / 3);
  const auto count = static_cast<std::uint32_t>(corners.size());
  for (const Vec<2>& x : corners) {
    const Vec<2> v = surface.velocity(x);
    out.points.insert(out.points.end(), {x[0], x[1], 0.0});
    auto& velocity = out.fields[0].values;
    velocity.insert(velocity.end(), {narrow(v[0]), narrow(v[1]), 0.0F});
  }
  for (std::uint32_t line = 0; line + 1 < count || (line < count && !body.half_plane); ++line) {
    out.connectivity.push_back(first + line);
    out.connectivity.push_back(first + (line + 1) % count);
    out.rigid.push_back(index);
  }
}

/// By the size of a particle, which is that of its volume.
template <int Dim>
Precision precision_for(const State<Dim>& state) {
  constexpr double farthest = 1e5;  // particles
  double volume = 0, largest = 0, count = 0;
  for (const Body<Dim>& body : state.bodies) {
    for (std::size_t p = 0; p < body.size(); ++p) volume += body.volume(p);
    for (const auto& component : body.x)
      for (const double x : component) largest = std::max(largest, std::abs(x));
    count += static_cast<double>(body.size());
  }
  return largest > farthest * std::pow(volume / count, 1.0 / Dim) ? Precision::twice : Precision::single;
}

}  // namespace

template <int Dim>
Snapshot take_snapshot(const State<Dim>& state, const std::vector<std::string>& materials) {
  Snapshot snapshot;
  snapshot.t = state.t;
  snapshot.particles = copy_particles(state, materials);
  snapshot.membranes.fields = {{"tension", {}, {}}, {"strain", {}, {}}, {"utilisation", {}, {}}};
  for (std::size_t m = 0; m < state.membranes.size(); ++m)
    if (state.membranes[m].field != waiting)
      append_membrane(state.membranes[m], static_cast<std::uint32_t>(m), snapshot.membranes);
  snapshot.has_rigid = !state.rigid.empty();
  snapshot.rigid.fields = {{"velocity", vector_components, {}}};
  if constexpr (Dim == 2)
    for (std::size_t r = 0; r < state.rigid.size(); ++r)
      if (state.rigid[r].present) append_rigid(state.rigid[r], static_cast<std::uint32_t>(r), snapshot.rigid);
  snapshot.particles.precision = snapshot.membranes.precision = snapshot.rigid.precision = precision_for(state);
  return snapshot;
}

template Snapshot take_snapshot(const State<2>&, const std::vector<std::string>&);
template Snapshot take_snapshot(const State<3>&, const std::vector<std::string>&);

}  // namespace geodrop
