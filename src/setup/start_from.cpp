#include "start_from.hpp"

#include <geodrop/base/error.hpp>

#include <string>
#include <vector>

namespace geodrop {
namespace {

[[noreturn]] void refuse(const std::string& found, const std::string& allowed) {
  throw SceneError("start_from", {{{}, "start_from", found, allowed, ProblemSource::elsewhere}});
}

/// Which arrays hold something, in the order of the list.
template <int Dim>
std::vector<bool> quantities(const Particles<Dim>& particles) {
  std::vector<bool> there;
  for_each_array<particle_role::per_particle | particle_role::by_id>(
      particles, [&](const auto& values) { there.push_back(!values.empty()); });
  return there;
}

}  // namespace

template <int Dim>
void take_particles(const Body<Dim>& from, Body<Dim>& body) {
  if (from.material.index() != body.material.index() || quantities<Dim>(from) != quantities<Dim>(body))
    refuse("body \"" + body.name + "\" with a law that has other state variables there",
           "the same model, drainage and layers of a body in both scenes");
  static_cast<Particles<Dim>&>(body) = from;
  body.weightless_level = from.weightless_level;
}

template <int Dim>
void take_cloth(const Membrane<Dim>& from, Membrane<Dim>& membrane) {
  if (from.closed != membrane.closed)
    refuse("membrane \"" + membrane.name + "\", closed in one of the scenes only", "the same `closed` in both");
  membrane.x = from.x;
  membrane.v = from.v;
  membrane.mass = from.mass;
  membrane.rest_length = from.rest_length;
  if constexpr (Dim == 3) {
    membrane.triangles.corner = from.triangles.corner;
    membrane.triangles.inverse_rest = from.triangles.inverse_rest;
    membrane.triangles.rest_area = from.triangles.rest_area;
    membrane.triangles.open_edge = from.triangles.open_edge;
  }
}

template void take_particles(const Body<2>&, Body<2>&);
template void take_particles(const Body<3>&, Body<3>&);
template void take_cloth(const Membrane<2>&, Membrane<2>&);
template void take_cloth(const Membrane<3>&, Membrane<3>&);

}  // namespace geodrop
