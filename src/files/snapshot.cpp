#include "snapshot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <geodrop/base/find_named.hpp>
#include <limits>

#include "contact/space_surface.hpp"
#include "geometry/polygon.hpp"
#include "measure/membrane_balance.hpp"
#include "measure/particle_columns.hpp"

namespace geodrop {
namespace {

template <int Dim>
ParticleSnapshot make_room(const State<Dim>& state, const std::vector<std::string>& fields) {
  ParticleSnapshot out;
  const auto wanted = [&](const char* name) {
    return fields.empty() || std::find(fields.begin(), fields.end(), name) != fields.end();
  };
  std::size_t count = 0;
  for (const Body<Dim>& body : state.bodies) {
    if (body.field != waiting) count += body.size();
    for_each_column(body, [&](const char* name, const std::vector<std::string>& components, auto) {
      if (wanted(name) && !is_named(out.fields, name)) out.fields.push_back({name, components, {}});
    });
  }
  for (Field& field : out.fields) field.values.resize(field.width() * count);
  out.points.resize(3 * count);
  out.layer.resize(count);
  out.material.resize(count);
  out.body.resize(count);
  out.id.resize(count);
  return out;
}

template <int Dim>
ParticleSnapshot copy_particles(const State<Dim>& state, const std::vector<std::string>& materials,
                                const std::vector<std::string>& fields) {
  ParticleSnapshot out = make_room(state, fields);
  std::size_t first = 0;
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const Body<Dim>& body = state.bodies[b];
    if (body.field == waiting) continue;
    const auto material = std::find(materials.begin(), materials.end(), body.material_name) - materials.begin();
#pragma omp parallel for schedule(static)
    for (std::size_t p = 0; p < body.size(); ++p) {
      const std::size_t to = first + p;
      for (int a = 0; a < Dim; ++a) out.points[3 * to + a] = body.x[a][p];
      out.id[to] = body.id[p];
      out.layer[to] = body.layer.empty() ? 0 : body.layer[body.id[p]];
      out.material[to] = static_cast<std::uint32_t>(material);
      out.body[to] = static_cast<std::uint32_t>(b);
    }
    for_each_column(body, [&](const std::string& name, const std::vector<std::string>&, auto write) {
      if (!is_named(out.fields, name)) return;
      Field& field = find_named(out.fields, name);
      const std::size_t width = field.width();
#pragma omp parallel for schedule(static)
      for (std::size_t p = 0; p < body.size(); ++p) write(p, &field.values[(first + p) * width]);
    });
    first += body.size();
  }
  return out;
}

void append_membrane(const Membrane<2>& membrane, std::uint32_t index, MembraneSnapshot& out) {
  const auto first = static_cast<std::uint32_t>(out.points.size() / 3);
  const auto nodes = static_cast<std::uint32_t>(membrane.nodes());
  for (std::uint32_t i = 0; i < nodes; ++i)
    for (int a = 0; a < 3; ++a) out.points.push_back(a < 2 ? membrane.x[a][i] : 0.0);
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  const Array<double>&inside = membrane.contents_pressure, &around = membrane.water_pressure;
  for (std::uint32_t s = 0; s < membrane.segments(); ++s) {
    out.connectivity.push_back(first + s);
    out.connectivity.push_back(first + (s + 1) % nodes);
    out.fields[0].values.push_back(narrow(membrane.tension[s]));
    out.fields[1].values.push_back(narrow(membrane.strain[s]));
    out.fields[2].values.push_back(membrane.strength > 0 ? narrow(membrane.tension[s] / membrane.strength) : none);
    out.fields[3].values.push_back(inside.empty() ? none : narrow(0.5 * (inside[s] + inside[(s + 1) % nodes])));
    out.fields[4].values.push_back(around.empty() ? none : narrow(around[s]));
    out.fields[5].values.push_back(membrane.pore_pressure.empty() ? none : narrow(membrane.pore_pressure[s]));
    out.fields[6].values.push_back(membrane.seepage.empty() ? none : narrow(membrane.seepage[s]));
    out.membrane.push_back(index);
  }
}

/// Triangles; the values of a plane's segments that they have as well, and the tension across.
void append_triangles(const Membrane<3>& membrane, std::uint32_t index, MembraneSnapshot& out) {
  const auto first = static_cast<std::uint32_t>(out.points.size() / 3);
  for (std::size_t i = 0; i < membrane.nodes(); ++i)
    for (int a = 0; a < 3; ++a) out.points.push_back(membrane.x[a][i]);
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  const MembraneTriangles<3>& triangles = membrane.triangles;
  const double across = triangles.fabric == Fabric::yarns ? triangles.weft_strength : membrane.strength;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const auto& corner : triangles.corner) out.connectivity.push_back(first + corner[t]);
    const double share = std::max(membrane.tension[t] / membrane.strength, triangles.cross_tension[t] / across);
    out.fields[0].values.push_back(narrow(membrane.tension[t]));
    out.fields[1].values.push_back(narrow(membrane.strain[t]));
    out.fields[2].values.push_back(membrane.strength > 0 ? narrow(share) : none);
    out.fields[3].values.push_back(narrow(triangles.cross_tension[t]));
    if (out.fields.size() > 4)
      out.fields[4].values.push_back(membrane.water_pressure.empty() ? none : narrow(membrane.water_pressure[t]));
    if (out.fields.size() > 5) {
      out.fields[5].values.push_back(membrane.pore_pressure.empty() ? none : narrow(membrane.pore_pressure[t]));
      out.fields[6].values.push_back(membrane.seepage.empty() ? none : narrow(membrane.seepage[t]));
    }
    out.membrane.push_back(index);
  }
}

/// A corner of a rigid body; its number.
std::uint32_t append_corner(const Vec<3>& x, const Vec<3>& v, RigidSnapshot& out) {
  out.points.insert(out.points.end(), x.begin(), x.end());
  for (const double component : v) out.fields[0].values.push_back(narrow(component));
  return static_cast<std::uint32_t>(out.points.size() / 3 - 1);
}

void append_line(std::uint32_t from, std::uint32_t to, std::uint32_t index, RigidSnapshot& out) {
  out.connectivity.insert(out.connectivity.end(), {from, to});
  out.rigid.push_back(index);
}

void append_rigid(const RigidBody<2>& body, std::uint32_t index, RigidSnapshot& out) {
  const RigidSurface surface(body);
  const auto first = static_cast<std::uint32_t>(out.points.size() / 3);
  std::uint32_t count = 0;
  for (const Vec<2>& x : outline(body)) {
    const Vec<2> v = surface.velocity(x);
    append_corner({x[0], x[1], 0}, {v[0], v[1], 0}, out);
    ++count;
  }
  for (std::uint32_t line = 0; line + 1 < count || (line < count && !body.half_plane); ++line)
    append_line(first + line, first + (line + 1) % count, index, out);
}

/// The edges of a box or prism; none of a half-space.
void append_rigid(const RigidBody<3>& body, std::uint32_t index, RigidSnapshot& out) {
  const SpaceSurface surface(body);
  const auto first = static_cast<std::uint32_t>(out.points.size() / 3);
  const auto count = static_cast<std::uint32_t>(body.corners.size());
  for (const Vec<3>& x : corners(body)) append_corner(x, surface.velocity(x), out);
  for (std::uint32_t k = 0; k < count; ++k) {
    append_line(first + k, first + (k + 1) % count, index, out);
    append_line(first + count + k, first + count + (k + 1) % count, index, out);
    append_line(first + k, first + count + k, index, out);
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

/// The ends of a segment, the corners of a triangle.
std::array<std::size_t, 2> nodes_of(const Membrane<2>& membrane, std::size_t segment) {
  return {segment, end_of_edge(segment, membrane.nodes())};
}
std::array<std::size_t, 3> nodes_of(const Membrane<3>& membrane, std::size_t triangle) {
  const auto& corner = membrane.triangles.corner;
  return {corner[0][triangle], corner[1][triangle], corner[2][triangle]};
}

}  // namespace

template <int Dim>
void add_balance(const Scene& scene, const State<Dim>& state, Snapshot& snapshot) {
  Field curvature{"curvature_load", {}, {}}, pressure{"pressure_jump", {}, {}};
  for (const Membrane<Dim>& membrane : state.membranes) {
    if (membrane.field == waiting) continue;
    const std::size_t parts = membrane.tension.size();
    if (!(membrane.axial_stiffness > 0)) {
      for (Field* field : {&curvature, &pressure})
        field->values.insert(field->values.end(), parts, std::numeric_limits<float>::quiet_NaN());
      continue;
    }
    const std::vector<AcrossLine> across = balance_across(scene, state, membrane);
    for (std::size_t part = 0; part < parts; ++part) {
      AcrossLine sum;
      for (const std::size_t k : nodes_of(membrane, part)) {
        sum.curvature += across[k].curvature;
        sum.pressure += across[k].pressure;
      }
      curvature.values.push_back(narrow(sum.curvature / Dim));
      pressure.values.push_back(narrow(sum.pressure / Dim));
    }
  }
  for (Field* field : {&curvature, &pressure}) snapshot.membranes.fields.push_back(std::move(*field));
}

template <int Dim>
Snapshot take_snapshot(const State<Dim>& state, const std::vector<std::string>& materials,
                       const std::vector<std::string>& fields) {
  Snapshot snapshot;
  snapshot.t = state.t;
  snapshot.particles = copy_particles(state, materials, fields);
  snapshot.membranes.fields = {{"tension", {}, {}}, {"strain", {}, {}}, {"utilisation", {}, {}}};
  if constexpr (Dim == 2) {
    for (const char* name : {"contents_pressure", "water_pressure", "pore_pressure", "seepage"})
      snapshot.membranes.fields.push_back({name, {}, {}});
  } else {
    snapshot.membranes.fields.push_back({"cross_tension", {}, {}});
    if (std::ranges::any_of(state.membranes, &Membrane<Dim>::sharp))
      snapshot.membranes.fields.push_back({"water_pressure", {}, {}});
    if (std::ranges::any_of(state.membranes, [](const auto& membrane) { return !membrane.pore_pressure.empty(); }))
      for (const char* name : {"pore_pressure", "seepage"}) snapshot.membranes.fields.push_back({name, {}, {}});
    snapshot.membranes.corners = 3;
  }
  for (std::size_t m = 0; m < state.membranes.size(); ++m) {
    const auto index = static_cast<std::uint32_t>(m);
    if (state.membranes[m].field == waiting) continue;
    if constexpr (Dim == 2) append_membrane(state.membranes[m], index, snapshot.membranes);
    if constexpr (Dim == 3) append_triangles(state.membranes[m], index, snapshot.membranes);
  }
  snapshot.has_rigid = std::any_of(state.rigid.begin(), state.rigid.end(),
                                   [](const RigidBody<Dim>& body) { return Dim == 2 || !body.half_plane; });
  snapshot.rigid.fields = {{"velocity", vector_components, {}}};
  for (std::size_t r = 0; r < state.rigid.size(); ++r)
    if (state.rigid[r].present) append_rigid(state.rigid[r], static_cast<std::uint32_t>(r), snapshot.rigid);
  snapshot.particles.precision = snapshot.membranes.precision = snapshot.rigid.precision = precision_for(state);
  return snapshot;
}

template void add_balance(const Scene&, const State<2>&, Snapshot&);
template void add_balance(const Scene&, const State<3>&, Snapshot&);
template Snapshot take_snapshot(const State<2>&, const std::vector<std::string>&, const std::vector<std::string>&);
template Snapshot take_snapshot(const State<3>&, const std::vector<std::string>&, const std::vector<std::string>&);

}  // namespace geodrop
