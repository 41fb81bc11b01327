// The fields of particles: sorting, checkpoint, hash, memory, prefetching, frames and stopping go through their list.
// State variables of laws are in materials.hpp, the fields of the grid in grid.hpp.
#pragma once

#include <geodrop/materials/materials.hpp>

namespace geodrop {

/// The particles of a body, one array per scalar component (structure of arrays). All arrays have `size()` entries or,
/// where the body has no such quantity, none. They are kept sorted by base cell (see grid/sort_particles).
template <int Dim>
struct Particles : StateVariables<Dim> {
  std::array<Array<double>, Dim> x;             ///< position [m]
  std::array<Array<double>, Dim> v;             ///< velocity [m/s]
  std::array<Array<double>, Dim * Dim> affine;  ///< C, row-major: dv_a/dx_b ~ affine[a * Dim + b] [1/s]
  Array<double> mass;                           ///< [kg], per metre of depth in 2D
  Array<double> J;                              ///< volume ratio to the reference density [-]

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
  return std::tuple_cat(
      std::tuple{
          field<moved | both_ways>("position", "m", &P::x), field<moved | both_ways | rate>("velocity", "m/s", &P::v),
          field<moved | scattered | rate>("affine_rate", "1/s", &P::affine),
          field<moved | scattered>("mass", "kg", &P::mass), field<moved | both_ways>("volume_ratio", "-", &P::J)},
      state_variables<Dim>,
      std::tuple{field<per_particle>("id", "-", &P::id),
                 field<by_id | every_body>("initial_position", "m", &P::initial_x),
                 field<by_id>("layer", "-", &P::layer), field<by_slab>("slab_begin", "-", &P::slab_begin)});
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
