// The fields of particles. Each stands once, as a member of Particles and as an entry of the list below it: sorting,
// checkpoint, hash, memory, prefetching, frames and stopping go through that list. The list of the grid's fields is in
// grid.hpp.
#pragma once

#include <geodrop/types.hpp>

#include <tuple>
#include <type_traits>

namespace geodrop {

/// A field of an owner: an Array, or one Array for each component.
template <unsigned field_roles, class Owner, class Values>
struct FieldEntry {
  static constexpr unsigned roles = field_roles;
  const char* name;
  const char* unit;
  Values Owner::*values;
};

template <unsigned roles, class Owner, class Values>
constexpr FieldEntry<roles, Owner, Values> field(const char* name, const char* unit, Values Owner::*values) {
  return {name, unit, values};
}

/// All fields, whatever their roles.
inline constexpr unsigned any_role = ~0U;

/// Calls f(entry, values) for the fields of an owner that have one of the roles, in the order of its list.
template <unsigned roles, class Owner, class F>
[[gnu::always_inline]] inline void for_each_field(Owner& owner, F&& f) {
  const auto one = [&](const auto& entry) {
    if constexpr ((std::remove_cvref_t<decltype(entry)>::roles & roles) != 0) f(entry, owner.*entry.values);
  };
  std::apply([&](const auto&... entry) { (one(entry), ...); }, fields_of(owner));
}

/// Calls f(array) for a field, or for each of its components.
template <class Values, class F>
void for_each_component(Values& values, F&& f) {
  if constexpr (requires { values.front().size(); })
    for (auto& component : values) f(component);
  else
    f(values);
}

/// Calls f(array) for each array of the fields that have one of the roles.
template <unsigned roles, class Owner, class F>
void for_each_array(Owner& owner, F&& f) {
  for_each_field<roles>(owner, [&](const auto&, auto& values) { for_each_component(values, f); });
}

/// Number of arrays of the fields of a list that have one of the roles.
template <unsigned roles, class... Owner, class... Values, unsigned... entry_roles>
constexpr std::size_t count_arrays(const std::tuple<FieldEntry<entry_roles, Owner, Values>...>&) {
  return (((entry_roles & roles) != 0 ? sizeof(Values) / sizeof(Array<double>) : 0) + ... + 0);
}

/// What a particle's field takes part in.
namespace particle_role {
enum : unsigned {
  per_particle = 1,  ///< an entry for each particle, in their present order
  by_id = 2,         ///< likewise, in the order of the start: never sorted
  by_slab = 4,       ///< written by sort_particles
  rate = 8,          ///< zero at rest
  scattered = 16,    ///< read by particles_to_grid
  gathered = 32,     ///< read by grid_to_particles or, but for the affine rate that it streams, written
  shown = 64,          ///< in frames as it is; of bodies without it: 0
  shown_if_any = 128,  ///< likewise, if any body has it
  every_body = 256     ///< whatever its law
};
}  // namespace particle_role

/// The particles of a body, one array per scalar component (structure of arrays). All arrays have `size()` entries or,
/// where the body has no such quantity, none. They are kept sorted by base cell (see grid/sort_particles).
template <int Dim>
struct Particles {
  std::array<Array<double>, Dim> x;             ///< position [m]
  std::array<Array<double>, Dim> v;             ///< velocity [m/s]
  std::array<Array<double>, Dim * Dim> affine;  ///< C, row-major: dv_a/dx_b ~ affine[a * Dim + b] [1/s]
  Array<double> mass;                           ///< [kg], per metre of depth in 2D
  Array<double> J;                              ///< volume ratio to the reference density [-]

  // State variables of laws, see materials.hpp:
  std::array<Array<double>, stress_components<Dim>>
      stress;                                        ///< soil: effective Cauchy stress; viscous fluid: deviator [Pa]
  std::array<Array<double>, Dim * Dim> deformation;  ///< neo-Hookean: F, row-major [-]
  Array<double> pore_pressure;                       ///< undrained soil [Pa]
  Array<double> deviatoric_strain;                   ///< soil: accumulated sqrt(2/3 e:e) [-]
  Array<double> gap;                                 ///< soil with void memory: volume of open voids over its own [-]

  Array<std::uint32_t> id;                   ///< index at the start
  std::array<Array<double>, Dim> initial_x;  ///< [m]
  Array<std::uint8_t> layer;                 ///< horizontal band at the start
  Array<std::uint32_t> slab_begin;           ///< first particle of each slab of the grid, one more at the end

  std::size_t size() const { return mass.size(); }
};

/// In the order of the checkpoint.
template <int Dim>
inline constexpr auto particle_fields = [] {
  using namespace particle_role;
  using P = Particles<Dim>;
  constexpr unsigned moved = per_particle | every_body, both_ways = scattered | gathered;
  return std::tuple{field<moved | both_ways>("position", "m", &P::x),
                    field<moved | both_ways | rate>("velocity", "m/s", &P::v),
                    field<moved | scattered | rate>("affine_rate", "1/s", &P::affine),
                    field<moved | scattered>("mass", "kg", &P::mass),
                    field<moved | both_ways>("volume_ratio", "-", &P::J),
                    field<per_particle | both_ways>("stress", "Pa", &P::stress),
                    field<per_particle | gathered>("deformation", "-", &P::deformation),
                    field<per_particle | both_ways | shown>("pore_pressure", "Pa", &P::pore_pressure),
                    field<per_particle | gathered | shown>("deviatoric_strain", "-", &P::deviatoric_strain),
                    field<per_particle | gathered | shown_if_any>("gap", "-", &P::gap),
                    field<per_particle>("id", "-", &P::id),
                    field<by_id | every_body>("initial_position", "m", &P::initial_x),
                    field<by_id>("layer", "-", &P::layer),
                    field<by_slab>("slab_begin", "-", &P::slab_begin)};
}();

template <int Dim>
constexpr const auto& fields_of(const Particles<Dim>&) {
  return particle_fields<Dim>;
}

static_assert(count_arrays<any_role>(particle_fields<2>) * sizeof(Array<double>) == sizeof(Particles<2>) &&
                  count_arrays<any_role>(particle_fields<3>) * sizeof(Array<double>) == sizeof(Particles<3>),
              "a field of particles is not in their list");

/// Memory of all that particles have [byte].
template <class P>
double particle_bytes(const P& particles) {
  std::size_t sum = 0;
  for_each_array<particle_role::per_particle | particle_role::by_id>(
      particles, [&](const auto& values) { sum += values.size() * sizeof(values[0]); });
  return static_cast<double>(sum);
}

}  // namespace geodrop
