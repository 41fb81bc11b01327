// What the rows of a step hand to each other: groups of fields of the state and of the grids, one name each.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace geodrop {

enum class Data : std::uint8_t {
  // Of the state:
  time,
  time_step,  ///< of StepContext, not of the state
  stage,
  largest_motion,
  bodies,
  particle_order,
  position,
  velocity,
  affine_rate,
  mass,
  volume_ratio,
  stress,
  material_state,
  initial_position,
  membranes,
  membrane_position,
  membrane_velocity,
  membrane_cloth,  ///< rest length and mass, which slide along the line; the pressure inside that holds them
  membrane_tension,
  membrane_load,
  water_traction,
  rigid_bodies,
  contacts,
  viscous_boundaries,
  absorbing_layers,
  anchors,
  tracers,
  relaxation,
  energy_budget,
  // Of the grids:
  active_blocks,
  nodal_sums,
  nodal_force,
  nodal_velocity,
  velocity_change,
  mass_correction,
  cell_volume,
  cell_pressure,
  cell_flags,
  volume_rate,
  crowding,
  nodal_pressure,
  enclosed_cells,
  cut_cells,
  rigid_share,
  pore_space,
  count
};

/// A set of groups of fields.
struct DataSet {
  std::uint64_t bits = 0;

  constexpr DataSet() = default;
  constexpr DataSet(Data item) : bits(std::uint64_t{1} << static_cast<int>(item)) {}
  constexpr bool contains(Data item) const { return (bits & DataSet(item).bits) != 0; }
  friend constexpr DataSet operator|(DataSet a, DataSet b) {
    a.bits |= b.bits;
    return a;
  }
};
constexpr DataSet operator|(Data a, Data b) { return DataSet(a) | DataSet(b); }
static_assert(static_cast<int>(Data::count) <= 64);

/// As people read it: "nodal velocity".
std::string_view name_of(Data item);

/// "nodal sums, nodal force"; empty for none.
std::string names_of(DataSet set);

/// Of all values of one group, in storage order.
template <int Dim>
std::uint64_t hash_of(Data item, const State<Dim>& state, const Grids<Dim>& grids);

using DataHashes = std::array<std::uint64_t, static_cast<std::size_t>(Data::count)>;

/// Of all groups, by their number.
template <int Dim>
DataHashes hashes_of(const State<Dim>& state, const Grids<Dim>& grids);

/// The groups whose hash is another one.
DataSet changed_data(const DataHashes& before, const DataHashes& after);

}  // namespace geodrop
