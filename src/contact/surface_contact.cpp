#include "surface_contact.hpp"

#include <geodrop/find_named.hpp>
#include <geodrop/graded_axis.hpp>

#include <algorithm>
#include <cmath>

#include "node_length.hpp"

namespace geodrop {
namespace {

template <int Dim>
void set(std::array<Array<double>, Dim>& values, std::size_t k, const Vec<Dim>& v) {
  for (int a = 0; a < Dim; ++a) values[a][k] = v[a];
}

template <int Dim>
void add_contact_force(Contact<Dim>& contact, double dt, Membrane<Dim>& membrane) {
  const Vec<Dim> point(contact.point.data()), normal(contact.normal.data());
  for (std::size_t k = 0; k < membrane.nodes(); ++k) {
    const double gap = normal.dot(vector_at(membrane.x, k) - point);
    if (gap >= 0) {
      set<Dim>(contact.slip, k, Vec<Dim>::Zero());
      continue;
    }
    const double spring = contact.stiffness * node_length(membrane, k), push = -spring * gap;
    const Vec<Dim> v = vector_at(membrane.v, k);
    Vec<Dim> slip = vector_at(contact.slip, k) + dt * (v - normal.dot(v) * normal);
    const double drag = spring * slip.norm();
    if (drag > contact.friction * push) slip *= contact.friction * push / drag;
    set<Dim>(contact.slip, k, slip);
    set<Dim>(membrane.load, k, vector_at(membrane.load, k) + push * normal - spring * slip);
  }
}

}  // namespace

template <int Dim>
Contact<Dim> make_contact(const Scene& scene, const ContactSpec& spec, const State<Dim>& state) {
  const HalfPlaneShape& surface = find_named(scene.rigid, spec.between[1]).shape;
  const Membrane<Dim>& membrane = find_named(state.membranes, spec.between[0]);
  const Material& behind = find_named(state.bodies, membrane.body).material;
  const double modulus = reference_density(behind) * std::pow(wave_speed(behind), 2);
  Contact<Dim> contact{spec.between[0], spec.between[1], {}, {}, spec.friction, 0, {}};
  contact.stiffness = spec.stiffness * modulus / finest_spacing(scene.grid);
  double length = 0;
  for (int a = 0; a < Dim; ++a) length += surface.normal[a] * surface.normal[a];
  for (int a = 0; a < Dim; ++a) {
    contact.point[a] = surface.point[a];
    contact.normal[a] = surface.normal[a] / std::sqrt(length);
    contact.slip[a].assign(membrane.nodes(), 0.0);
  }
  return contact;
}

template <int Dim>
void add_contact_forces(State<Dim>& state, double dt) {
  for (Contact<Dim>& contact : state.contacts)
    add_contact_force(contact, dt, find_named(state.membranes, contact.membrane));
}

#define GEODROP_INSTANTIATE(D)                                                            \
  template Contact<D> make_contact<D>(const Scene&, const ContactSpec&, const State<D>&); \
  template void add_contact_forces<D>(State<D>&, double);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
