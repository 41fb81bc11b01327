// Layout of the grid, allocation of its fields, and the exact integrals of the basis over its cells.
#include <algorithm>
#include <geodrop/grid/grid.hpp>
#include <geodrop/materials/materials.hpp>
#include <geodrop/scene/velocity_fields.hpp>
#include <limits>
#include <set>

#include "checkerboard.hpp"
#include "scene/needs.hpp"

namespace geodrop {
namespace {

/// Integrals of N and N' over the cell of node `cell`, h = 1, for the three nodes that reach into it.
struct CellIntegral {
  std::array<double, 3> value, slope;
};

/// The cell reaches 1/2 to both sides of its node; particles of GIMP see the hat function itself there.
CellIntegral interior_cell(Basis basis) {
  if (basis == Basis::bspline2) return {{1.0 / 6, 2.0 / 3, 1.0 / 6}, {-0.5, 0, 0.5}};
  return {{1.0 / 8, 3.0 / 4, 1.0 / 8}, {-0.5, 0, 0.5}};
}

/// A wall half cell sees its ghost node folded onto the mirror node with sign `parity`
/// (+1 slip, -1 no-slip for tangential components; slopes act on the normal component, always -1).
/// Half cell [0, 1/2] of a lower wall, unfolded: B-splines int N = (1/48, 1/3, 7/48), int N' = (-1/8, -1/4, 3/8);
/// hat functions (0, 3/8, 1/8), (0, -1/2, 1/2). The normal velocity of the wall node is zero: its slope never acts.
CellIntegral wall_cell(Basis basis, bool lower, double parity) {
  const double own = basis == Basis::bspline2 ? 1.0 / 3 : 3.0 / 8;
  const double mirror_value = basis == Basis::bspline2 ? 7.0 / 48 + parity / 48 : 1.0 / 8;
  constexpr double mirror_slope = 0.5;  // B-splines: 3/8 + 1/8
  if (lower) return {{0, own, mirror_value}, {0, 0, mirror_slope}};
  return {{mirror_value, own, 0}, {-mirror_slope, 0, 0}};
}

/// The same on a knot span of width w with neighbours of width w -+ : int N = w^2 / (3 (w + w_-)), w^2 / (3 (w + w_+)),
/// int N' = -+ w / (w + w_-+). A wall has the same spans on both sides; its half cell holds 1/8 of the spline that
/// leaves it and 7/8 of the one that enters.
CellIntegral graded_cell(const KnotSpan& span, double h) {
  const double below = span.width / (2 * span.gap_below), above = span.width / (2 * span.gap_above);
  const double w = span.width / h, value_below = below * w / 3, value_above = above * w / 3;
  return {{value_below, w - value_below - value_above, value_above}, {-below, below - above, above}};
}

CellIntegral graded_wall_cell(const KnotSpan& span, double h, bool lower, double parity) {
  const double share = span.width / (2 * span.gap_above), w = span.width / h, whole = share * w / 3;
  const double own = w / 2 - whole, mirror_value = (7 + parity) / 8 * whole;
  if (lower) return {{0, own, mirror_value}, {0, 0, share}};
  return {{mirror_value, own, 0}, {-share, 0, 0}};
}

template <int Dim>
typename Grid<Dim>::AxisIntegrals axis_integrals(const GridLayout<Dim>& layout, int axis) {
  typename Grid<Dim>::AxisIntegrals out;
  const int stored = layout.stored[axis];
  const bool graded = layout.graded();
  const CellIntegral none{{0, 0, 0}, {0, 0, 0}};
  const CellIntegral interior = interior_cell(layout.basis);
  out.value.resize(stored);
  out.slope.resize(stored);
  out.width.assign(stored, 0.0);
  for (int s = 0; s < stored; ++s) {
    const int cell = s - GridLayout<Dim>::pad;
    const bool periodic = layout.periodic(axis);
    const bool inside = periodic || (cell >= 0 && cell <= layout.cells[axis]);
    const bool at_lower = !periodic && cell == 0, at_upper = !periodic && cell == layout.cells[axis];
    const WallKind wall = at_lower ? layout.lower_wall[axis] : layout.upper_wall[axis];
    const double parity = wall == WallKind::slip ? 1.0 : -1.0;
    const auto in_cell = [&] {
      if (!inside) return none;
      const bool wall_half = at_lower || at_upper;
      if (!graded) return wall_half ? wall_cell(layout.basis, at_lower, parity) : interior;
      const KnotSpan& span = layout.knots[axis][s];
      return wall_half ? graded_wall_cell(span, layout.h, at_lower, parity) : graded_cell(span, layout.h);
    };
    const CellIntegral c = in_cell();
    out.value[s] = c.value;
    out.slope[s] = c.slope;
    out.width[s] = !inside ? 0.0 : (at_lower || at_upper ? 0.5 : 1.0) * layout.span_width(axis, cell);
  }
  return out;
}

/// Nodes lighter than this share of a full node of the lightest material hand part of their impulse on.
/// 0.02 to 0.1 served in trials with columns, dam breaks and bags in water.
constexpr double light_share = 0.02;

/// Of a membrane in space alone: its own mass in a cell.
double lightest_density(const Scene& scene, const std::vector<BodySpec>& bodies) {
  double density = std::numeric_limits<double>::infinity();
  for (const MembraneSpec& membrane : scene.membranes)
    if (bodies.empty()) density = std::min(density, membrane.mass_per_area / scene.grid.spacing);
  for (const BodySpec& body : bodies)
    if (const MaterialSpec* material = find_material(scene, body.material))
      density = std::min(density, reference_density(make_material(*material)));
  return density;
}

/// rho c^2 of the bodies whose cells carry their pressure, from the least to the largest.
std::set<double> cell_moduli(const Scene& scene, const std::vector<BodySpec>& bodies) {
  std::set<double> moduli;
  for (const BodySpec& body : bodies) {
    if (!find_material(scene, body.material) || body.pressure != PressureSupport::cell) continue;
    moduli.insert(wave_modulus(law_of(scene, body)));
  }
  return moduli;
}

}  // namespace

template <int Dim>
GridLayout<Dim>::GridLayout(const GridSpec& spec, const WallsSpec& walls)
    : h(spec.spacing), inv_h(1.0 / spec.spacing), basis(spec.basis), finest(finest_spacing(spec)) {
  int flat = 1;
  for (int a = 0; a < Dim; ++a) {
    lower[a] = spec.lower[a];
    upper[a] = spec.upper[a];
    cells[a] = AxisMap(spec, a).cells();
    stored[a] = cells[a] + 1 + 2 * pad;
    stride[a] = flat;
    flat *= stored[a];
    blocks[a] = (stored[a] + block_width[a] - 1) / block_width[a];
    slabs[a] = a == 0 ? 1 : (cells[a] + slab_width<Dim>) / slab_width<Dim>;
    lower_wall[a] = walls.lower[a];
    upper_wall[a] = walls.upper[a];
    if (!spec.refine.empty()) knots[a] = KnotTable(spec, a, pad);
    const double beyond = periodic(a) ? h : 0.0;
    particle_lower[a] = lower[a] - beyond;
    particle_upper[a] = upper[a] + beyond;
  }
  constexpr int up = Dim - 1;
  for (int i = -pad; i <= cells[up] + pad; ++i) {
    const double quarter = periodic(up) ? 0.0 : 0.25 * span_width(up, i) * h;
    middle_of_row.push_back(node(up, i) + (i == 0 ? quarter : 0.0) - (i == cells[up] ? quarter : 0.0));
  }
}

template <int Dim>
int GridLayout<Dim>::block_count() const {
  int n = 1;
  for (int b : blocks) n *= b;
  return n;
}

template <int Dim>
int GridLayout<Dim>::slab_count() const {
  int n = 1;
  for (int s : slabs) n *= s;
  return n;
}

template <int Dim>
Grid<Dim> make_grid(const Scene& scene, int field) {
  const std::vector<int> fields = velocity_fields(scene);
  std::vector<BodySpec> bodies;
  for (std::size_t b = 0; b < fields.size(); ++b)
    if (fields[b] == field) bodies.push_back(scene.bodies[b]);
  Grid<Dim> grid;
  grid.field = field;
  for (const BodySpec& soil : bodies)
    for (std::size_t b = 0; b < fields.size() && !soil.saturated_by.empty(); ++b)
      if (scene.bodies[b].name == soil.saturated_by) grid.pore_water = fields[b];
  grid.light_mass = light_share * lightest_density(scene, bodies) * std::pow(scene.grid.spacing, Dim);
  const std::set<double> moduli = cell_moduli(scene, bodies);
  if (!moduli.empty()) grid.largest_modulus = *moduli.rbegin();
  grid.layout = GridLayout<Dim>(scene.grid, scene.walls);
  const std::size_t n = grid.layout.nodes();
  const auto any_body = [&](auto has) { return std::any_of(bodies.begin(), bodies.end(), has); };
  const bool consistent = scene.solver.mass_matrix != MassMatrix::lumped;
  const bool change = scene.solver.transfer != Transfer::tpic || consistent ||
                      scene.relaxation.damping != RelaxationSpec::Damping::none;
  const bool shift = any_body([](const BodySpec& b) { return b.shift; });
  const bool air = bodies.empty() && has_sharp_interface(scene);
  const bool cells = shift || air || any_body([](const BodySpec& b) { return b.pressure == PressureSupport::cell; });
  const bool by_cells = cells && scene.solver.weight == Weight::cell;
  const bool pores = any_pores(scene);
  unsigned wanted = grid_role::for_all;
  const auto want = [&](unsigned role, bool needed) { wanted |= needed ? role : 0; };
  // Contacts and membranes push on the outermost nodes, which carry little: their impulses have to go to their
  // neighbourhood.
  want(grid_role::for_light, change || !scene.contacts.empty() || !scene.membranes.empty() ||
                                 has_sharp_interface(scene) || pores || (Dim == 3 && (shift || by_cells)));
  want(grid_role::for_change, change);
  want(grid_role::for_consistent, consistent);
  want(grid_role::for_cells, cells);
  const bool implicit = any_body([](const BodySpec& b) { return b.implicit_pore_pressure; });
  want(grid_role::for_moduli, moduli.size() > 1 || implicit);
  want(grid_role::for_implicit, implicit);
  want(grid_role::for_undrained, any_body([&](const BodySpec& b) { return has_checkerboard(scene, b); }));
  want(grid_role::for_nodal, any_body([](const BodySpec& b) { return b.pressure == PressureSupport::nodal; }));
  want(grid_role::for_sharp, has_sharp_interface(scene));
  want(grid_role::for_crowding, any_body(makes_room));
  want(grid_role::for_rigid, any_fluid_at_rigid(scene));
  want(grid_role::for_pores, any_body([](const BodySpec& b) { return !b.saturated_by.empty(); }));
  want(grid_role::for_pore_water, any_body([&](const BodySpec& b) { return saturates(scene, b.name); }));
  want(grid_role::for_inertial_drag, any_body([&](const BodySpec& b) { return has_inertial_drag(scene, b); }));
  want(grid_role::for_inertial_water, std::ranges::any_of(scene.bodies, [&](const BodySpec& soil) {
         return has_inertial_drag(scene, soil) &&
                any_body([&](const BodySpec& b) { return b.name == soil.saturated_by; });
       }));
  for_each_field<any_role>(grid, [&]<class T>(const auto& entry, Array<T>& values) {
    if (entry.roles & wanted) values.assign(n, T{});
  });
  if (cells) {
    for (int a = 0; a < Dim; ++a) grid.integrals[a] = axis_integrals(grid.layout, a);
    grid.interior_value = interior_cell(grid.layout.basis).value;
  }
  for (const BodySpec& body : bodies) {
    if (body.pressure != PressureSupport::enclosed) continue;
    grid.enclosed.emplace_back();
    grid.enclosed.back().rate.assign(n, 0.0);
  }
  return grid;
}

template <int Dim>
Grids<Dim> make_grids(const Scene& scene) {
  Grids<Dim> grids;
  for (int field = 0; field < count_velocity_fields(scene); ++field) grids.push_back(make_grid<Dim>(scene, field));
  return grids;
}

template struct GridLayout<2>;
template struct GridLayout<3>;
template Grid<2> make_grid<2>(const Scene&, int);
template Grid<3> make_grid<3>(const Scene&, int);
template Grids<2> make_grids<2>(const Scene&);
template Grids<3> make_grids<3>(const Scene&);

}  // namespace geodrop
