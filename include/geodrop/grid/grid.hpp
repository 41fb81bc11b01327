// The background grid: its layout and the fields that live on it for one step.
//
// Nodes sit on grid lines, x fastest, with `pad` ghost nodes beyond every wall. With quadratic B-splines the
// cell of the pressure is the knot span: it is centred on a node, reaches h/2 to each side, and carries the
// same index as its node. Walls lie on grid lines, so the cells of wall nodes are half (corner: quarter) cells.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <geodrop/base/types.hpp>
#include <geodrop/grid/graded_axis.hpp>
#include <geodrop/scene/numerics.hpp>
#include <geodrop/state/fields.hpp>
#include <type_traits>
#include <vector>

namespace geodrop {

struct Scene;

/// Slabs are what one thread scatters at a time: groups of base cells along the axes other than x,
/// at least P + 2 = 4 cells wide so that two slabs of one colour never touch the same node even if a particle
/// drifted by one cell since the sort.
///
///     2D   row of cells 0..7   slab 0  colour 0        3D   y ->  pencil (0,0) colour 0 | (1,0) colour 1
///          row of cells 8..15  slab 1  colour 1             z     pencil (0,1) colour 2 | (1,1) colour 3
///          row of cells 16..23 slab 2  colour 0             v     4 x 4 cells each
template <int Dim>
inline constexpr int slab_width = Dim == 2 ? 8 : 4;
template <int Dim>
inline constexpr int slab_colours = Dim == 2 ? 2 : 4;

/// What the quadratic splines of an axis look like on one knot span: at its upper end that of the node above is
/// `above`, at its lower end that of the node below is `below` [-]; on a uniform grid both are 1/2.
struct SpanShape {
  /// A cell at a wall at which a sharp surface ends is the half of its span that is in the domain.
  enum class Part : std::uint8_t { whole, upper_half, lower_half };

  double width;  ///< of the part [m]
  double below = 0.5, above = 0.5;
  Part part = Part::whole;

  /// int N over a whole span [width] and int N' of the nodes below, at and above.
  std::array<double, 3> values() const { return {below / 3, (3 - below - above) / 3, above / 3}; }
  std::array<double, 3> slopes() const { return {-below, below - above, above}; }
};

template <int Dim>
struct GridLayout {
  static constexpr int pad = 2;
  /// Blocks are what is cleared, updated and skipped: nodes per axis.
  static constexpr std::array<int, 3> block_width = {16, slab_width<Dim>, slab_width<Dim>};

  double h = 0;                                          ///< spacing; on a graded grid that of the coarse cells [m]
  double inv_h = 0;                                      ///< [1/m]
  std::array<double, Dim> lower{}, upper{};              ///< domain [m]
  std::array<int, Dim> cells{};                          ///< intervals per axis; nodes 0..cells
  std::array<int, Dim> stored{};                         ///< nodes per axis with ghosts
  std::array<int, Dim> stride{};                         ///< of the flat node index
  std::array<int, Dim> blocks{};                         ///< per axis
  std::array<int, Dim> slabs{};                          ///< per axis; 1 along x
  std::array<WallKind, Dim> lower_wall{}, upper_wall{};  ///< both periodic or neither
  Basis basis = Basis::bspline2;
  double finest = 0;  ///< width of the finest cell; h on a uniform grid [m]
  /// Of a graded grid, the knots of all axes, uniform ones too; else empty.
  std::array<KnotTable, Dim> knots;
  /// Middle of each row of cells, layer in space, from the lowest stored one up: those on a wall are half as wide [m].
  Array<double> middle_of_row;
  /// Where particles may be between two sorts [m]: the domain, and along a periodic axis a cell more on both sides.
  std::array<double, Dim> particle_lower{}, particle_upper{};

  GridLayout() = default;
  GridLayout(const GridSpec& spec, const WallsSpec& walls);

  bool graded() const { return !knots[0].empty(); }
  bool periodic(int axis) const { return lower_wall[axis] == WallKind::periodic; }
  /// The coordinate in the domain that a coordinate beyond a periodic wall stands for [m].
  double wrapped(int axis, double x) const {
    const double period = upper[axis] - lower[axis];
    return periodic(axis) ? x - period * std::floor((x - lower[axis]) / period) : x;
  }

  int nodes() const { return stride[Dim - 1] * stored[Dim - 1]; }
  int block_count() const;
  int slab_count() const;

  /// Flat index of a node from its integer coordinates; ghosts have -pad..-1 and cells+1..cells+pad.
  int index(const std::array<int, Dim>& i) const {
    int flat = 0;
    for (int a = 0; a < Dim; ++a) flat += (i[a] + pad) * stride[a];
    return flat;
  }
  /// Coordinate of the base cell (nearest node; on a graded grid the knot span) of position x along one axis.
  int base(int axis, double x) const {
    if (graded()) return knots[axis].find(x) - pad;
    return static_cast<int>(std::floor((x - lower[axis]) * inv_h + 0.5));
  }
  /// Place of node i along one axis [m].
  double node(int axis, int i) const { return graded() ? knots[axis].node(i + pad) : lower[axis] + i * h; }
  /// Width of the knot span of node i along one axis, walls or not [h].
  double span_width(int axis, int i) const { return graded() ? knots[axis][i + pad].width * inv_h : 1.0; }
  /// The knot span of a stored node along one axis, walls or not.
  SpanShape span_shape(int axis, int stored_node) const {
    if (!graded()) return {.width = h};
    const KnotSpan& span = knots[axis][stored_node];
    return {span.width, span.width / (2 * span.gap_below), span.width / (2 * span.gap_above)};
  }
  /// Integral of the spline of node i along one axis, walls or not: the mean of its three spans [h].
  double spline_width(int axis, int i) const {
    if (!graded()) return 1.0;
    const KnotSpan& span = knots[axis][i + pad];
    return (2 * (span.gap_below + span.gap_above) - span.width) / 3 * inv_h;
  }
};

/// Flags of a pressure cell.
enum CellFlag : std::uint8_t {
  cell_filled = 1,    ///< pressure and volume rate come from the cell, not from each particle
  cell_shiftable = 2  ///< its neighbourhood is full of material and free of membranes
};

/// Integrals of 1, z, z^2 over the part of a face inside; z from -1/2 to 1/2 along it [its length].
using FaceMoments = std::array<double, 3>;

/// The cells that a closed polygon cuts (2D), see cut/cut_cells. Local cells i + j nx of a box.
struct CutCells {
  /// The part of an edge in a cell, from and to as shares of the edge.
  struct Piece {
    int cell, edge;
    double from, to;
  };
  std::array<int, 2> first{}, count{};      ///< lowest stored cell of the box, cells per axis
  double sense = 1;                         ///< 1: the nodes run anticlockwise, -1: clockwise
  Array<double> area;                       ///< share of a cell inside [-]
  Array<FaceMoments> right_face, top_face;  ///< between a cell and the next one along x, along y
  std::vector<Piece> pieces;                ///< in the order of the nodes

  std::size_t size() const { return area.size(); }
};

/// The cells that a closed surface of triangles cuts (3D), see cut/clipped_cells. Local cells i + nx (j + ny k) of a
/// box.
struct ClippedCells {
  /// Integrals of u^a w^b over the part of a face inside, at a + 3 b; u, w from -1/2 to 1/2 along the two axes that
  /// follow the face's own, cyclically [its area].
  using FaceMoments = std::array<double, 9>;
  /// The part of a triangle in a cell: integrals of the linear functions of its corners over its area [-].
  struct Piece {
    int cell;
    std::uint32_t triangle;
    std::array<double, 3> share;
  };
  std::array<int, 3> first{}, count{};           ///< lowest stored cell of the box, cells per axis
  std::array<Array<double>, 3> plane;            ///< lower sides of its cells, and the upper one of the last [h]
  bool even = true;                              ///< cells are cubes of h, planes 0, 1, 2, ...
  Array<double> inside;                          ///< share of a cell inside [-]
  std::array<Array<FaceMoments>, 3> upper_face;  ///< between a cell and the next one along each axis
  std::vector<Piece> pieces;                     ///< in the order of the triangles

  std::size_t size() const { return inside.size(); }
};

/// The cells of a fluid inside a closed membrane, see cut/enclosed_fluid.
struct EnclosedCells : CutCells {
  ClippedCells space;      ///< in place of CutCells in space
  Array<int> host;         ///< cell whose pressure and rate a cell shares
  Array<double> volume;    ///< of particles, at hosts [m3]
  Array<double> pressure;  ///< pi, at hosts [Pa]
  Array<double> rate;      ///< D_c of all cells, by the flat index of the grid [1/s]
};

/// The cells that the triangles of a sharp membrane cut, see cut/clipped_surface; pieces stand flank by flank.
struct ClippedSurface : ClippedCells {
  /// What faces one way of the surface in a cell. Integrals over its area [h2], h = 1.
  struct Flank {
    int cell;
    std::uint32_t first_piece, pieces;
    double area;
    double faces;                                  ///< area as the cell sees it, its widths as unit [its faces]
    std::array<double, 3> normal;                  ///< int n dA, outwards
    std::array<std::array<double, 3>, 27> spline;  ///< int N n dA of the nodes around the cell, x fastest
    std::array<double, 27> beside;                 ///< int (int N dx from the cell's left face) n_x dA
  };
  /// A part of the surface with one multiplier: some flanks in a row, the first of which is large enough for itself.
  struct Patch {
    std::uint32_t first_flank, flanks;
    double area;
  };
  std::vector<Flank> flanks;  ///< patch by patch
  std::vector<Patch> patches;
};

/// The cells that a sharp membrane cuts.
template <int Dim>
using Outline = std::conditional_t<Dim == 2, CutCells, ClippedSurface>;

/// The nodes whose quadratic splines reach a cell: 3 along each axis, x fastest.
template <int Dim>
inline constexpr int nodes_around = Dim == 2 ? 9 : 27;

/// int grad N over a part of a cell, of the nodes around [m, m2].
template <int Dim>
using Slope = std::array<std::array<double, Dim>, nodes_around<Dim>>;

/// int N over a part of a cell, of the nodes around [m2, m3].
template <int Dim>
using SplineVolumes = std::array<double, nodes_around<Dim>>;

/// A cell that a velocity field has a part of: a body across a sharp interface has the rest, see cut/.
template <int Dim>
struct PartCell {
  int flat = 0;
  int host = -1;       ///< cell whose pressure and rate it shares, perhaps itself; -1: particles act by themselves
  Slope<Dim> slope{};  ///< over the part
  SplineVolumes<Dim> elsewhere{};  ///< over the rest of the cell
  double share = 1;                ///< of its pressure and rate that acts: less where it is too stiff for the step [-]
};

/// What rigid bodies have of a cell.
template <int Dim>
struct RigidPart {
  int flat = 0;
  Slope<Dim> slope{};                 ///< over that part
  SplineVolumes<Dim> value{};         ///< over that part
  std::array<double, Dim> outward{};  ///< away from the nearest of them
};

/// The part of a particle's coming shift that would press it against a rigid body, or pull it off [m].
template <int Dim>
struct HeldShift {
  std::size_t body = 0, particle = 0;
  std::array<double, Dim> shift{};
};

/// What a field of the grid takes part in, and what needs it.
namespace grid_role {
enum : unsigned {
  zero_each_step = 1,          ///< before particles are summed
  zero_asleep = 2,             ///< in a block that goes to sleep
  folded = 4,                  ///< ghosts of walls hand their sums on
  velocity_like = 8,           ///< walls impose it
  for_all = 16,                ///< every grid has it
  for_light = 32,              ///< stresses apart from momentum, for nodes of small mass
  for_change = 64,             ///< Transfer::blend and musl, mass_correction, relaxation
  for_consistent = 128,        ///< MassMatrix::consistent
  for_cells = 256,             ///< PressureSupport::cell, particles that shift
  for_nodal = 512,             ///< PressureSupport::nodal
  for_sharp = 1024,            ///< fields that meet at a sharp interface
  for_rigid = 2048,            ///< particles that shift beside rigid bodies
  for_moduli = 4096,           ///< cells of bodies that differ in rho c^2
  for_pores = 8192,            ///< coupled soils
  for_pore_water = 16384,      ///< the fluid in their pores
  for_inertial_drag = 32768,   ///< coupled soils with Forchheimer's drag
  for_inertial_water = 65536,  ///< the fluid in their pores
  for_implicit = 131072,       ///< undrained soils whose pore pressure is found at the end of the step
  for_undrained = 262144,      ///< undrained soils whose pore pressure follows their law
  for_crowding = 524288        ///< fluids that shift with a speed of their own
};
}  // namespace grid_role

/// The fields of a grid by the flat index of its nodes, each also an entry of grid_fields. Those that no stage of the
/// pipeline needs have length zero.
struct GridFields {
  Array<Vec4> sum;    ///< momentum in lanes 0..Dim-1 [kg m/s], mass in lane 3 [kg]; 2D: volume in lane 2 [m3]
  Array<Vec4> force;  ///< force from stresses in lanes 0..Dim-1 [N]; 3D: volume in lane 3 [m3]. Without it, dt force is
                      ///< in `sum`
  Array<Vec4> velocity;         ///< v' in lanes 0..Dim-1 [m/s]; fill ratio in lane 3 where particles shift
  Array<Vec4> velocity_change;  ///< v' - v [m/s]
  Array<Vec4> mass_correction;  ///< what the consistent mass matrix adds to both [m/s]

  Array<double> cell_volume;    ///< sum of particle volumes of a cell [m3]
  Array<double> cell_modulus;   ///< sum of volume times rho c^2 of a cell, where bodies differ in rho c^2 [N m]
  Array<double> pore_modulus;   ///< sum of volume times K_f / n of a cell, where that acts implicitly [N m]
  Array<double> pore_volume;    ///< sum of the volumes of undrained soil in a cell, pore pressure by its law [m3]
  Array<double> cell_pressure;  ///< P_c [Pa]; 0 unless filled
  Array<double> volume_rate;    ///< D_c [1/s]
  Array<double> crowding;  ///< fill ratio of a cell beyond what smooth flow and rest scatter by, see grid/crowding [-]
  Array<std::uint8_t> cell_flags;

  Array<double> node_volume;    ///< sum N V_p [m3]
  Array<double> node_pressure;  ///< sum N V_p p_p, then their mean P_i [Pa]
  Array<double> node_rate;      ///< sum N V_p tr L_p, then their mean D_i [1/s]

  Array<double> taken;  ///< share of each cell that bodies of other fields have [-]

  Array<double> rigid_cells;    ///< share of each cell that rigid bodies have [-]
  Array<double> rigid_splines;  ///< integral of the spline of each node over rigid bodies [m2]
  Array<double> rigid_filled;   ///< the part of that in filled cells [m2]
  Array<double> room_mass;  ///< what the room around a node beside rigid bodies holds, see grid/weight_at_rigid [kg]

  // See pores/pores. Of a soil's field:
  Array<double> grain_volume;         ///< of a cell [m3]
  Array<double> drag_resistance;      ///< sum gamma_w V_p / k of a cell [N s/m]
  Array<double> inertial_resistance;  ///< sum gamma_w V_p b of a cell, b of Forchheimer [N s2/m2]
  // Of the field of the water:
  Array<double> occupied;            ///< volume of grains in a cell [m3]
  Array<double> pore_share;          ///< n at the nodes: share of the pressure's force that acts on the water [-]
  Array<double> grain_lightness;     ///< (1 - n)^2 / m_s at the nodes [1/kg]
  Array<double> node_drag;           ///< n^2 drag_resistance at the nodes [N s/m]
  Array<double> node_inertial_drag;  ///< n^3 inertial_resistance at the nodes [N s2/m2]
  Array<Vec4> mixture_velocity;      ///< n v_w + (1 - n) v_s [m/s]
};

inline constexpr auto grid_fields = [] {
  using namespace grid_role;
  using G = GridFields;
  constexpr unsigned summed = zero_each_step | zero_asleep;
  return std::tuple{field<for_all | summed | folded>("sum", "kg m/s, kg", &G::sum),
                    field<for_light | summed | folded>("force", "N", &G::force),
                    field<for_all | zero_asleep | velocity_like>("velocity", "m/s", &G::velocity),
                    field<for_change | zero_asleep | velocity_like>("velocity_change", "m/s", &G::velocity_change),
                    field<for_consistent>("mass_correction", "m/s", &G::mass_correction),
                    field<for_cells | summed>("cell_volume", "m3", &G::cell_volume),
                    field<for_moduli | summed>("cell_modulus", "N m", &G::cell_modulus),
                    field<for_implicit | summed>("pore_modulus", "N m", &G::pore_modulus),
                    field<for_undrained | summed>("pore_volume", "m3", &G::pore_volume),
                    field<for_cells | summed>("cell_pressure", "Pa", &G::cell_pressure),
                    field<for_cells | zero_asleep>("volume_rate", "1/s", &G::volume_rate),
                    field<for_crowding | zero_asleep>("crowding", "-", &G::crowding),
                    field<for_cells | zero_asleep>("cell_flags", "-", &G::cell_flags),
                    field<for_nodal | summed>("node_volume", "m3", &G::node_volume),
                    field<for_nodal | summed>("node_pressure", "Pa", &G::node_pressure),
                    field<for_nodal | summed>("node_rate", "1/s", &G::node_rate),
                    field<for_sharp>("taken", "-", &G::taken),
                    field<for_rigid>("rigid_cells", "-", &G::rigid_cells),
                    field<for_rigid>("rigid_splines", "m2", &G::rigid_splines),
                    field<for_rigid>("rigid_filled", "m2", &G::rigid_filled),
                    field<for_rigid | zero_asleep>("room_mass", "kg", &G::room_mass),
                    field<for_pores | summed>("grain_volume", "m3", &G::grain_volume),
                    field<for_pores | summed>("drag_resistance", "N s/m", &G::drag_resistance),
                    field<for_inertial_drag | summed>("inertial_resistance", "N s2/m2", &G::inertial_resistance),
                    field<for_pore_water | zero_asleep>("occupied", "m3", &G::occupied),
                    field<for_pore_water | zero_asleep>("pore_share", "-", &G::pore_share),
                    field<for_pore_water | zero_asleep>("grain_lightness", "1/kg", &G::grain_lightness),
                    field<for_pore_water | zero_asleep>("node_drag", "N s/m", &G::node_drag),
                    field<for_inertial_water | zero_asleep>("node_inertial_drag", "N s2/m2", &G::node_inertial_drag),
                    field<for_pore_water | zero_asleep>("mixture_velocity", "m/s", &G::mixture_velocity)};
}();

constexpr const auto& fields_of(const GridFields&) { return grid_fields; }

static_assert(count_arrays<any_role>(grid_fields) * sizeof(Array<double>) == sizeof(GridFields),
              "a field of the grid is not in the list");

/// Everything that the stages of one step hand to each other: one velocity field. Cleared anew each step, so not part
/// of a checkpoint. Entries outside the active blocks are zero.
template <int Dim>
struct Grid : GridFields {
  GridLayout<Dim> layout;
  int field = 0;                       ///< bodies, membranes and tracers of this number move with it
  int pore_water = -1;                 ///< field of the water in the pores of its soil; -1: none flows there
  Array<std::uint32_t> active_blocks;  ///< sorted; blocks that particles may touch until the next sort
  /// Nodes below it (on a graded grid: times the widths of their splines) share their impulse with their neighbours,
  /// see grid/momentum [kg].
  double light_mass = 0;
  double largest_modulus = 0;  ///< rho c^2 of the bodies whose cells carry their pressure; 0: none do [Pa]

  /// Exact integrals over the cell of a node along one axis, by stored cell coordinate, walls folded in, with h as
  /// the unit of length.
  struct AxisIntegrals {
    Array<std::array<double, 3>> value;  ///< int N of the nodes cell-1, cell, cell+1
    Array<std::array<double, 3>> slope;  ///< int N'
    Array<double> width;                 ///< of the cell: uniform 1, at a wall 1/2, beyond it 0
  };
  std::array<AxisIntegrals, Dim> integrals;
  std::array<double, 3> interior_value{};  ///< int N over the cells below, at, above a node, away from walls, h = 1

  std::vector<EnclosedCells> enclosed;  ///< of the bodies with PressureSupport::enclosed

  // Only where fields meet at a sharp interface, or a fluid ends at a rigid body:
  Outline<Dim> outline;                     ///< of the sharp membrane whose body moves with this field; else empty
  std::vector<PartCell<Dim>> part_cells;    ///< of which this field has a part
  std::vector<RigidPart<Dim>> rigid_parts;  ///< of which rigid bodies that its particles touch have a part
  std::vector<HeldShift<Dim>> held_shifts;  ///< of particles that touch a rigid body, in this step

  Array<double> chunk_maxima;  ///< scratch of grid_to_particles: speed, displacement per chunk
};

/// One grid for each velocity field, all of the same layout.
template <int Dim>
using Grids = std::vector<Grid<Dim>>;

/// Allocates the arrays that the physics of the bodies of a velocity field needs.
template <int Dim>
Grid<Dim> make_grid(const Scene& scene, int field = 0);

/// The grids of all velocity fields.
template <int Dim>
Grids<Dim> make_grids(const Scene& scene);

}  // namespace geodrop
