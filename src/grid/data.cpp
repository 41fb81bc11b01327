#include <geodrop/grid/data.hpp>

#include <xxhash.h>

#include "state/archive.hpp"

namespace geodrop {
namespace {

/// An archive that goes on from the hash of what came before.
class Hasher {
 public:
  template <class T>
  void bytes(const T* first, std::size_t count) {
    if (count > 0) hash_ = XXH3_64bits_withSeed(first, count * sizeof(T), hash_);
  }
  std::size_t length(std::size_t count, std::size_t) {
    bytes(&count, 1);
    return count;
  }
  template <class... T>
  void add(const T&... values) {
    (walk(*this, values), ...);
  }
  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 0;
};

/// What only some particles, or none, have besides stress: it belongs to their law.
template <int Dim>
void add_material_state(const Body<Dim>& body, Hasher& hash) {
  hash.add(body.deformation, body.pore_pressure, body.deviatoric_strain, body.gap, body.eddy_length, body.gas);
}

template <int Dim>
void add_constants(const Body<Dim>& body, Hasher& hash) {
  hash.add(body.name, body.material_name, body.material, body.field, body.pressure, body.shift, body.shift_speed,
           body.half_size, body.enclosed, body.unit_weight, body.weightless_level);
}

template <int Dim>
void add_constants(const Membrane<Dim>& m, Hasher& hash) {
  hash.add(m.name, m.body, m.field, m.closed, m.sharp, m.axial_stiffness, m.strength, m.contents_friction,
           m.gauge_length, m.half_size, m.share, m.bed, m.bed_friction, m.shear, m.wall_friction, m.roughness,
           m.drag_coefficient, m.fluid_density, m.permeance, m.permeance_strains, m.permeance_factors);
  if constexpr (Dim == 3) {
    const auto& t = m.triangles;
    hash.add(t.fabric, t.poisson_ratio, t.weft_stiffness, t.weft_strength, t.mass_per_area, t.gauge_pressure, t.corner,
             t.inverse_rest, t.rest_area);
  }
}

template <int Dim>
void add_tension(const Membrane<Dim>& m, Hasher& hash) {
  hash.add(m.strain, m.tension, m.gauge);
  if constexpr (Dim == 3) hash.add(m.triangles.cross_tension);
}

template <int Dim>
void add_body(Data item, const Body<Dim>& body, Hasher& hash) {
  switch (item) {
    case Data::bodies:
      return add_constants(body, hash);
    case Data::particle_order:
      return hash.add(body.id, body.slab_begin);
    case Data::position:
      return hash.add(body.x);
    case Data::velocity:
      return hash.add(body.v);
    case Data::affine_rate:
      return hash.add(body.affine);
    case Data::mass:
      return hash.add(body.mass);
    case Data::volume_ratio:
      return hash.add(body.J);
    case Data::stress:
      return hash.add(body.stress);
    case Data::material_state:
      return add_material_state(body, hash);
    case Data::initial_position:
      return hash.add(body.initial_x, body.layer);
    default:
      return;
  }
}

template <int Dim>
void add_membrane(Data item, const Membrane<Dim>& membrane, Hasher& hash) {
  switch (item) {
    case Data::membranes:
      return add_constants(membrane, hash);
    case Data::membrane_position:
      return hash.add(membrane.x);
    case Data::membrane_velocity:
      return hash.add(membrane.v);
    case Data::membrane_tension:
      return add_tension(membrane, hash);
    case Data::membrane_cloth:
      return hash.add(membrane.rest_length, membrane.mass, membrane.contents_pressure);
    case Data::membrane_load:
      return hash.add(membrane.load, membrane.caught);
    case Data::water_traction:
      if constexpr (Dim == 3) hash.add(membrane.triangles.water_shear);
      return hash.add(membrane.water_pressure, membrane.water_shear, membrane.bed_shear, membrane.bed_pressure,
                      membrane.pore_pressure, membrane.seepage);
    default:
      return;
  }
}

template <int Dim>
void add_rest(Data item, const State<Dim>& state, Hasher& hash) {
  switch (item) {
    case Data::time:
      return hash.add(state.t, state.step);
    case Data::stage:
      return hash.add(state.damping_rate, state.stages_entered);
    case Data::largest_motion:
      for (const Body<Dim>& body : state.bodies)
        for (const std::uint8_t is_explicit : body.implicit_pores) hash.add(is_explicit);
      return hash.add(state.drift, state.v_max);
    case Data::rigid_bodies:
      return hash.add(state.rigid);
    case Data::contacts:
      return hash.add(state.rigid_contacts, state.membrane_contacts);
    case Data::viscous_boundaries:
      return hash.add(state.viscous_boundaries);
    case Data::absorbing_layers:
      return hash.add(state.silent_sides);
    case Data::anchors:
      return hash.add(state.anchors);
    case Data::tracers:
      return hash.add(state.tracers);
    case Data::relaxation:
      return hash.add(state.relaxation);
    case Data::energy_budget:
      return hash.add(state.energy_budget);
    default:
      return;
  }
}

template <class T>
void add_array(const Array<T>& values, Hasher& hash) {
  hash.bytes(values.data(), values.size());
}

void add_cut(const CutCells& cells, Hasher& hash) {
  hash.add(cells.first, cells.count, cells.sense, cells.area, cells.right_face, cells.top_face);
  for (const CutCells::Piece& piece : cells.pieces) hash.add(piece.cell, piece.edge, piece.from, piece.to);
}

void add_clipped(const ClippedCells& cells, Hasher& hash) {
  hash.add(cells.first, cells.count, cells.inside, cells.upper_face);
  for (const ClippedCells::Piece& piece : cells.pieces) hash.add(piece.cell, piece.triangle, piece.share);
}

void add_cut(const ClippedSurface& cells, Hasher& hash) {
  add_clipped(cells, hash);
  for (const ClippedSurface::Flank& flank : cells.flanks)
    hash.add(flank.cell, flank.first_piece, flank.pieces, flank.area, flank.normal, flank.spline, flank.beside);
  for (const ClippedSurface::Patch& patch : cells.patches) hash.add(patch.first_flank, patch.flanks, patch.area);
}

template <int Dim>
void add_cells_of_bodies(Data item, const Grid<Dim>& grid, Hasher& hash) {
  if (item == Data::enclosed_cells)
    for (const EnclosedCells& cells : grid.enclosed) {
      if constexpr (Dim == 2) add_cut(cells, hash);
      if constexpr (Dim == 3) add_clipped(cells.space, hash);
      hash.add(cells.host, cells.volume, cells.pressure, cells.rate);
    }
  if (item == Data::cut_cells) {
    add_cut(grid.outline, hash);
    hash.add(grid.taken);
    for (const PartCell<Dim>& part : grid.part_cells) hash.add(part.flat, part.host, part.slope, part.elsewhere);
  }
}

template <int Dim>
void add_grid(Data item, const Grid<Dim>& grid, Hasher& hash) {
  switch (item) {
    case Data::active_blocks:
      return add_array(grid.active_blocks, hash);
    case Data::nodal_sums:
      return add_array(grid.sum, hash);
    case Data::nodal_force:
      return add_array(grid.force, hash);
    case Data::nodal_velocity:
      return add_array(grid.velocity, hash);
    case Data::velocity_change:
      return add_array(grid.velocity_change, hash);
    case Data::mass_correction:
      return add_array(grid.mass_correction, hash);
    case Data::cell_volume:
      return hash.add(grid.cell_volume, grid.cell_modulus, grid.pore_modulus, grid.pore_volume);
    case Data::cell_pressure:
      return add_array(grid.cell_pressure, hash);
    case Data::cell_flags:
      return add_array(grid.cell_flags, hash);
    case Data::volume_rate:
      return add_array(grid.volume_rate, hash);
    case Data::crowding:
      return add_array(grid.crowding, hash);
    case Data::nodal_pressure:
      return hash.add(grid.node_volume, grid.node_pressure, grid.node_rate);
    case Data::rigid_share:
      return hash.add(grid.rigid_cells, grid.rigid_splines, grid.rigid_filled, grid.room_mass);
    case Data::pore_space:
      hash.add(grid.grain_volume, grid.drag_resistance, grid.occupied, grid.pore_share, grid.grain_lightness,
               grid.node_drag, grid.inertial_resistance, grid.node_inertial_drag);
      return add_array(grid.mixture_velocity, hash);
    default:
      return add_cells_of_bodies(item, grid, hash);
  }
}

constexpr std::string_view names[] = {"time",
                                      "time step",
                                      "stage",
                                      "largest motion",
                                      "bodies",
                                      "order of particles",
                                      "position",
                                      "velocity",
                                      "affine rate",
                                      "mass",
                                      "volume ratio",
                                      "stress",
                                      "state of the material",
                                      "initial position",
                                      "membranes",
                                      "membrane nodes",
                                      "velocity of membrane nodes",
                                      "cloth of membranes",
                                      "tension",
                                      "membrane loads",
                                      "water on membranes",
                                      "rigid bodies",
                                      "contacts",
                                      "viscous boundaries",
                                      "absorbing layers",
                                      "anchors",
                                      "tracers",
                                      "relaxation",
                                      "energy budget",
                                      "active blocks",
                                      "nodal sums",
                                      "nodal force",
                                      "nodal velocity",
                                      "change of nodal velocity",
                                      "mass correction",
                                      "cell volume",
                                      "cell pressure",
                                      "cell flags",
                                      "volume rate of cells",
                                      "crowding of cells",
                                      "nodal pressure",
                                      "enclosed cells",
                                      "cut cells",
                                      "share of rigid bodies",
                                      "pore space"};
static_assert(std::size(names) == static_cast<std::size_t>(Data::count));

}  // namespace

std::string_view name_of(Data item) { return names[static_cast<int>(item)]; }

std::string names_of(DataSet set) {
  std::string text;
  for (int i = 0; i < static_cast<int>(Data::count); ++i) {
    const Data item = static_cast<Data>(i);
    if (!set.contains(item)) continue;
    if (!text.empty()) text += ", ";
    text += name_of(item);
  }
  return text;
}

template <int Dim>
std::uint64_t hash_of(Data item, const State<Dim>& state, const Grids<Dim>& grids) {
  Hasher hash;
  for (const Body<Dim>& body : state.bodies) add_body(item, body, hash);
  for (const Membrane<Dim>& membrane : state.membranes) add_membrane(item, membrane, hash);
  add_rest(item, state, hash);
  for (const Grid<Dim>& grid : grids) add_grid(item, grid, hash);
  return hash.hash();
}

template <int Dim>
DataHashes hashes_of(const State<Dim>& state, const Grids<Dim>& grids) {
  DataHashes hashes;
  for (std::size_t i = 0; i < hashes.size(); ++i) hashes[i] = hash_of(static_cast<Data>(i), state, grids);
  return hashes;
}

DataSet changed_data(const DataHashes& before, const DataHashes& after) {
  DataSet set;
  for (std::size_t i = 0; i < before.size(); ++i)
    if (before[i] != after[i]) set = set | static_cast<Data>(i);
  return set;
}

template DataHashes hashes_of(const State<2>&, const Grids<2>&);
template DataHashes hashes_of(const State<3>&, const Grids<3>&);
template std::uint64_t hash_of(Data, const State<2>&, const Grids<2>&);
template std::uint64_t hash_of(Data, const State<3>&, const Grids<3>&);

}  // namespace geodrop
