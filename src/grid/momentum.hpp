// The momentum equation on the nodes, and the walls.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/scene/numerics.hpp>
#include <geodrop/state/state.hpp>

#include <algorithm>
#include <type_traits>

#include "cell_pressure.hpp"
#include "neighbourhood.hpp"

namespace geodrop {

/// Whether the nodes of a layer, by their stored coordinate along the axis, are on a wall of the domain.
template <int Dim>
bool on_wall(const GridLayout<Dim>& layout, int axis, int stored) {
  const int at = stored - GridLayout<Dim>::pad;
  return !layout.periodic(axis) && (at == 0 || at == layout.cells[axis]);
}

/// Sign of component `component` under reflection at a wall normal to `axis`.
inline double mirror_sign(WallKind wall, int axis, int component) {
  if (axis == component) return -1;
  return wall == WallKind::slip ? 1 : -1;
}

/// f(node, mass) for the nodes around one, given by its stored coordinates: masses as they would be without walls.
template <int Dim, class F>
void for_masses_around(const Grid<Dim>& grid, int flat, const std::type_identity_t<std::array<int, Dim>>& node, F&& f) {
  if (far_from_walls<Dim>(grid.layout, 1, node)) {
    for_neighbourhood(grid.layout, flat, [&](int other, const auto&) { f(other, grid.sum[other][3]); });
    return;
  }
  for_neighbourhood(grid.layout, flat, [&](int other, const std::array<int, Dim>& at) {
    int images = 1;
    for (int a = 0; a < Dim; ++a)
      if (at[a] != 1 && on_wall(grid.layout, a, node[a] + at[a] - 1)) images *= 2;
    f(other, images * grid.sum[other][3]);
  });
}

/// Mass below which a node, given by its stored coordinates, is light [kg]: on a graded grid a share of what its own
/// spline holds, on a wall half of it.
template <int Dim>
double light_mass(const Grid<Dim>& grid, const std::array<int, Dim>& node);

/// Integrals of the splines of `count` nodes along x over the domain [m3], from the one with stored coordinates `node`.
template <int Dim>
CellRow<Dim> node_measures(const Grid<Dim>& grid, int count, std::array<int, Dim> node);

/// That of one node.
template <int Dim>
double node_measure(const Grid<Dim>& grid, const std::array<int, Dim>& node);

/// Volume of the particles of a field that a node's spline holds [m3]; in space where stresses have sums of their own.
template <int Dim>
double spline_volume(const Grid<Dim>& grid, int flat) {
  return Dim == 2 ? grid.sum[flat][2] : grid.force[flat][3];
}

/// Folds what particles scattered beyond the walls onto the mirror nodes: normal component with sign -1, tangential
/// with +1 (slip) or -1 (no-slip). Both sides of a periodic seam are added up and get the same sums. Of walls
/// only the active blocks are visited.
template <int Dim>
void fold_walls(Grid<Dim>& grid);

/// Likewise of one sum of vectors over particles.
template <int Dim>
void fold_walls(const Grid<Dim>& grid, Array<Vec4>& field);

/// v' = v + dt (f / m + g) with the cell pressure's force added; zero normal (no-slip: whole) velocity on walls; mirror
/// images in the ghost layer. Nodes with less mass than Grid::light_mass take only the part m / light_mass of their
/// impulse (with TPIC, where stresses joined the momentum: of the cell pressure's impulse) and hand the rest, as one
/// rigid velocity increment, to the nodes of their neighbourhood: momentum is kept to round-off (flux redistribution,
/// Chern & Colella 1987). With Weight::cell g is divided by the fill ratio where all cells in reach of a node are
/// filled: the weight is that of their volume.
template <int Dim>
void update_momentum(Grid<Dim>& grid, const std::array<double, Dim>& gravity, double dt,
                     Weight weight = Weight::particle);

/// Components of the velocity of a node that walls hold.
template <int Dim>
std::array<bool, Dim> held_by_walls(const GridLayout<Dim>& layout, int flat);

/// f(node, share) for where an impulse at a node goes: one of small mass keeps mass / light mass of it and hands on the
/// rest to the nodes around, by their mass. False if nothing around has mass: the rest goes nowhere.
template <int Dim, class F>
bool for_shares_of_impulse(const Grid<Dim>& grid, int flat, F&& f) {
  const std::array<int, Dim> node = stored_cell(grid.layout, flat);
  const double mass = grid.sum[flat][3], light = light_mass<Dim>(grid, node);
  const double kept = std::min(1.0, mass / light);
  if (kept > 0) f(flat, kept);
  if (!(kept < 1)) return true;
  double around = 0;
  for_masses_around<Dim>(grid, flat, node, [&](int, double m) { around += m; });
  if (around <= 0) return false;
  for_masses_around<Dim>(grid, flat, node, [&](int other, double m) {
    if (m > 0) f(other, (1 - kept) * m / around);
  });
  return true;
}

/// Velocity at a node as impulses see it [m/s]: that of a node of small mass counts by the part of an impulse that it
/// takes, that of its neighbourhood by the rest (the adjoint of for_shares_of_impulse). Rates of volume from it are the
/// adjoint of update_momentum.
template <int Dim>
Vec4 carried_velocity(const Grid<Dim>& grid, int flat, const std::array<int, Dim>& node);

/// Holds the nodal velocity at the walls, ghosts included.
template <int Dim>
void impose_wall_velocity(Grid<Dim>& grid);

}  // namespace geodrop
