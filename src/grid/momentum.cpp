#include "momentum.hpp"

#include "blocks.hpp"
#include "cell_pressure.hpp"
#include "neighbourhood.hpp"
#include "seams.hpp"
#include "weight_at_rigid.hpp"

namespace geodrop {
template <int Dim>
double light_mass(const Grid<Dim>& grid, const std::array<int, Dim>& node) {
  double mass = grid.light_mass;
  if (grid.layout.graded())
    for (int a = 0; a < Dim; ++a) mass *= grid.layout.spline_width(a, node[a] - GridLayout<Dim>::pad);
  for (int a = 0; a < Dim; ++a)
    if (on_wall(grid.layout, a, node[a])) mass *= 0.5;
  return mass;
}

template <int Dim>
CellRow<Dim> node_measures(const Grid<Dim>& grid, int count, std::array<int, Dim> node) {
  CellRow<Dim> whole;
  for (int k = 0; k < count; ++k) whole[k] = grid.integrals[0].width[node[0] + k] * grid.layout.h;
  for (int a = 1; a < Dim; ++a) {
    const double width = grid.integrals[a].width[node[a]] * grid.layout.h;
    for (int k = 0; k < count; ++k) whole[k] *= width;
  }
  // On a graded grid the integral is not the width of the span: 3 % of a difference where cells begin to grow kept a
  // column of water in motion for ever (0.11 m/s).
  for (int k = 0; k < count && grid.layout.graded(); ++k, ++node[0])
    for (int a = 0, i = 0; a < Dim; ++a) {
      i = node[a] - GridLayout<Dim>::pad;
      whole[k] *= grid.layout.spline_width(a, i) / grid.layout.span_width(a, i);
    }
  return whole;
}

template <int Dim>
double node_measure(const Grid<Dim>& grid, const std::array<int, Dim>& node) {
  return node_measures<Dim>(grid, 1, node)[0];
}

template <int Dim>
std::array<bool, Dim> held_by_walls(const GridLayout<Dim>& layout, int flat) {
  std::array<bool, Dim> fixed{};
  const std::array<int, Dim> stored = stored_cell(layout, flat);
  for (int a = 0; a < Dim; ++a) {
    if (!on_wall(layout, a, stored[a])) continue;
    fixed[a] = true;
    const WallKind wall = stored[a] == layout.pad ? layout.lower_wall[a] : layout.upper_wall[a];
    if (wall == WallKind::no_slip) fixed.fill(true);
  }
  return fixed;
}

namespace {

template <int Dim>
Vec4 mirror(WallKind wall, int axis, Vec4 record) {
  for (int c = 0; c < Dim; ++c) record[c] *= mirror_sign(wall, axis, c);
  return record;
}

/// Calls f(flat index) for the nodes of active blocks that have `coordinate` along `axis`; ghosts of the other axes
/// included. Each call may touch the nodes of its own line along `axis`: lines are shared out among the threads.
template <int Dim, class F>
void for_each_active_node_of_layer(const Grid<Dim>& grid, int axis, int coordinate, F&& f) {
  const GridLayout<Dim>& layout = grid.layout;
  const int layer_block = coordinate / GridLayout<Dim>::block_width[axis];
  int blocks_per_layer = 1;
  for (int a = 0; a < axis; ++a) blocks_per_layer *= layout.blocks[a];
  const auto n = static_cast<std::ptrdiff_t>(grid.active_blocks.size());
  constexpr std::ptrdiff_t layers_of_a_block = 64;  // a layer takes a small part of the time of its blocks
#pragma omp parallel for schedule(static) if (n >= layers_of_a_block * blocks_worth_threads)
  for (std::ptrdiff_t b = 0; b < n; ++b) {
    const std::uint32_t block = grid.active_blocks[b];
    if (static_cast<int>(block) / blocks_per_layer % layout.blocks[axis] != layer_block) continue;
    for_each_row_of_block(layout, block, [&](int begin, int count, const std::array<int, Dim>& node) {
      if (axis == 0)
        f(begin + coordinate - node[0]);
      else if (node[axis] == coordinate)
        for (int k = 0; k < count; ++k) f(begin + k);
    });
  }
}

/// Calls f(coordinate, step into the domain, wall) for both walls normal to `axis`.
template <int Dim, class F>
void for_both_walls(const GridLayout<Dim>& layout, int axis, F&& f) {
  constexpr int pad = GridLayout<Dim>::pad;
  f(pad, 1, layout.lower_wall[axis]);
  f(pad + layout.cells[axis], -1, layout.upper_wall[axis]);
}

template <int Dim>
void fold_field(const Grid<Dim>& grid, Array<Vec4>& field) {
  if (field.empty()) return;
  const GridLayout<Dim>& layout = grid.layout;
  for (int axis = 0; axis < Dim; ++axis) {
    if (layout.periodic(axis)) {
      sum_over_seam(layout, axis, field);
      continue;
    }
    for_both_walls(layout, axis, [&](int at, int inward, WallKind wall) {
      const int to_image = 2 * inward * layout.stride[axis];
      for_each_active_node_of_layer(grid, axis, at - inward, [&](int ghost) {
        field[ghost + to_image] += mirror<Dim>(wall, axis, field[ghost]);
        field[ghost] = Vec4{};
      });
    });
  }
}

/// Velocity of walls and of their ghost nodes.
template <int Dim>
void impose_walls(const Grid<Dim>& grid, Array<Vec4>& field) {
  if (field.empty()) return;
  const GridLayout<Dim>& layout = grid.layout;
  for (int axis = 0; axis < Dim; ++axis) {
    if (layout.periodic(axis)) {
      copy_over_seam(layout, axis, field);
      continue;
    }
    for_both_walls(layout, axis, [&](int at, int inward, WallKind wall) {
      for_each_active_node_of_layer(grid, axis, at, [&](int node) {
        for (int c = 0; c < Dim; ++c)
          if (mirror_sign(wall, axis, c) < 0) field[node][c] = 0;
      });
      const int to_image = 2 * inward * layout.stride[axis];
      for_each_active_node_of_layer(
          grid, axis, at - inward, [&](int ghost) { field[ghost] = mirror<Dim>(wall, axis, field[ghost + to_image]); });
    });
  }
}

/// Adds what rigid bodies have of the splines of a row's nodes, and what lies empty behind a thin one.
template <int Dim>
void add_rigid(const Grid<Dim>& grid, int begin, int count, const CellRow<Dim>& whole, CellRow<Dim>& volume) {
  for (int k = 0; k < count; ++k) {
    const double mass = grid.room_mass[begin + k];
    if (mass > 0)
      volume[k] = whole[k] + (1 - mass / grid.sum[begin + k][3]) * volume[k];
    else
      volume[k] += grid.rigid_splines[begin + k];
  }
}

/// Volume of particles and rigid bodies over the integral of the splines of a row's nodes [-]: what particles shift
/// down the gradient of. The smooth spline sum, not the count in the cell: counts jump when a particle changes cells
/// (jittered column: error 2.0 instead of 1.0 %).
template <int Dim>
CellRow<Dim> fill_ratios(const Grid<Dim>& grid, int begin, int count, const std::array<int, Dim>& node) {
  CellRow<Dim> fill{};
  if (grid.cell_volume.empty() || (Dim == 3 && grid.force.empty())) return fill;
  for (int k = 0; k < count; ++k) fill[k] = spline_volume(grid, begin + k);
  const CellRow<Dim> whole = node_measures<Dim>(grid, count, node);
  if (!grid.rigid_splines.empty()) add_rigid(grid, begin, count, whole, fill);
  for (int k = 0; k < count; ++k) fill[k] /= whole[k];
  for (int k = 0; k < count && !grid.pore_share.empty(); ++k) fill[k] += 1 - grid.pore_share[begin + k];
  return fill;
}

/// Impulses that light nodes could not take, by node.
using LeftOver = std::vector<std::pair<int, Vec4>>;

struct MomentumStep {
  Vec4 gravity;  ///< dt g [m/s]
  double dt;
  Weight weight;
};

/// Whether particles fill all cells in reach of a node, without rigid bodies, sharp interfaces and surface.
template <int Dim>
bool filled_around(const Grid<Dim>& grid, int flat, const std::array<int, Dim>& node) {
  bool filled = true;
  for_neighbourhood(grid.layout, flat, [&](int, const std::array<int, Dim>& a) {
    const int cell = mirrored<Dim>(grid.layout, node, a);
    filled = filled && (grid.cell_flags[cell] & cell_filled) && (grid.taken.empty() || grid.taken[cell] == 0);
  });
  return filled;
}

/// Velocity of one node from its sums and `impulse` [N s], the cell pressure's and, if separate, the stresses'.
template <int Dim>
void update_node(Grid<Dim>& grid, int flat, const std::array<int, Dim>& node, const Vec4& impulse,
                 const MomentumStep& step, LeftOver& left_over) {
  const double m = grid.sum[flat][3];
  Vec4 velocity{}, change{};
  if (m > 0) {
    // No node counts as light above Grid::light_mass: most are not asked for their own limit.
    const double light = m < grid.light_mass ? light_mass<Dim>(grid, node) : 0.0;
    const double inv_m = 1 / m, carried = m < light ? 1 / light : inv_m;
    change = impulse * carried + step.gravity;
    velocity = grid.sum[flat] * inv_m + change;
    if (m < light) left_over.emplace_back(flat, (1 - m / light) * impulse);
  } else if (impulse[0] != 0 || impulse[1] != 0 || (Dim == 3 && impulse[2] != 0)) {
    left_over.emplace_back(flat, impulse);  // of a massless skin that reaches beyond the particles
  }
  grid.velocity[flat] = velocity;
  if (!grid.velocity_change.empty()) grid.velocity_change[flat] = change;
}

/// Velocities of a row where nothing but gravity is left to act: stresses have joined the momentum, no cell has a
/// pressure, nobody asks for the change. 13 -> 5 ns a node.
template <int Dim>
void update_plain_row(Grid<Dim>& grid, int begin, int count, const Vec4& gravity) {
  for (int node = begin; node < begin + count; ++node) {
    const Vec4 sum = grid.sum[node];
    Vec4 velocity{};
    if (sum[3] > 0) velocity = sum * (1 / sum[3]) + gravity;
    velocity[3] = 0;
    grid.velocity[node] = velocity;
  }
}

template <int Dim>
void update_row(Grid<Dim>& grid, int begin, int count, std::array<int, Dim> node, const MomentumStep& step,
                LeftOver& left_over) {
  if (grid.cell_pressure.empty() && grid.force.empty() && grid.velocity_change.empty())
    return update_plain_row<Dim>(grid, begin, count, step.gravity);
  const RowForce<Dim> force =
      grid.cell_pressure.empty() ? RowForce<Dim>{} : cell_pressure_force<Dim>(grid, begin, count, node);
  const CellRow<Dim> fill = fill_ratios<Dim>(grid, begin, count, node);
  const bool separate = !grid.force.empty(), pores = !grid.pore_share.empty(), at_rigid = !grid.room_mass.empty();
  for (int k = 0; k < count; ++k, ++node[0]) {
    Vec4 impulse{};
    for (int a = 0; a < Dim; ++a) impulse[a] = force[a][k];
    if (pores) impulse *= grid.pore_share[begin + k];
    if (separate) impulse += grid.force[begin + k];
    MomentumStep here = step;
    // The force of cell pressures knows the volume only, so the weight of that is what it balances.
    if (step.weight == Weight::cell && fill[k] > 0 && filled_around<Dim>(grid, begin + k, node))
      here.gravity /= fill[k];
    impulse *= step.dt;
    // Pressure and weight of a node in the surface cancel before the node of small mass hands them on.
    if (at_rigid && grid.room_mass[begin + k] > 0) {
      impulse += grid.room_mass[begin + k] * step.gravity;
      here.gravity = Vec4{};
    }
    update_node<Dim>(grid, begin + k, node, impulse, here, left_over);
    grid.velocity[begin + k][3] = fill[k];
  }
}

/// Hands an impulse to the neighbourhood of a node. Of the nodes that a periodic seam doubles, the lower one acts and
/// takes for both; impose_walls copies it.
template <int Dim>
void share_left_over(Grid<Dim>& grid, int flat, Vec4 impulse) {
  if (node_of_seam(grid.layout, flat) != flat) return;
  const std::array<int, Dim> node = stored_cell(grid.layout, flat);
  double mass = 0;
  for_masses_around<Dim>(grid, flat, node, [&](int, double m) { mass += m; });
  impulse[3] = 0;
  if (!far_from_walls<Dim>(grid.layout, 1, node)) {
    const std::array<bool, Dim> held = held_by_walls(grid.layout, flat);
    for (int a = 0; a < Dim; ++a)
      if (held[a]) impulse[a] = 0;
  }
  const Vec4 change = impulse / mass;
  for_masses_around<Dim>(grid, flat, node, [&](int neighbour, double m) {
    if (m <= 0) return;
    const int other = node_of_seam(grid.layout, neighbour);
    const Vec4 here = m / grid.sum[neighbour][3] * change;
    grid.velocity[other] += here;
    if (!grid.velocity_change.empty()) grid.velocity_change[other] += here;
  });
}

}  // namespace

template <int Dim>
Vec4 carried_velocity(const Grid<Dim>& grid, int flat, const std::array<int, Dim>& node) {
  const double mass = grid.sum[flat][3];
  if (mass >= grid.light_mass) return grid.velocity[flat];
  const double light = light_mass<Dim>(grid, node);
  if (mass >= light) return grid.velocity[flat];
  Vec4 momentum{};
  double around = 0;
  for_masses_around<Dim>(grid, flat, node, [&](int other, double m) {
    momentum += m * grid.velocity[other];
    around += m;
  });
  const double kept = mass / light;
  return around > 0 ? kept * grid.velocity[flat] + (1 - kept) / around * momentum : grid.velocity[flat];
}

template <int Dim>
void fold_walls(const Grid<Dim>& grid, Array<Vec4>& field) {
  fold_field(grid, field);
}

template <int Dim>
void fold_walls(Grid<Dim>& grid) {
  for_each_array<grid_role::folded>(grid, [&](auto& values) { fold_field(grid, values); });
}

template <int Dim>
void impose_wall_velocity(Grid<Dim>& grid) {
  for_each_array<grid_role::velocity_like>(grid, [&](auto& values) { impose_walls(grid, values); });
}

template <int Dim>
void update_momentum(Grid<Dim>& grid, const std::array<double, Dim>& gravity, double dt, Weight weight) {
  MomentumStep step{{}, dt, weight};
  for (int a = 0; a < Dim; ++a) step.gravity[a] = dt * gravity[a];
  if constexpr (Dim == 2)
    if (!grid.room_mass.empty()) step.gravity *= weigh_by_room(grid);
  const auto blocks = static_cast<std::ptrdiff_t>(grid.active_blocks.size());
  std::vector<LeftOver> left_over(blocks);
#pragma omp parallel for schedule(static) if (blocks >= blocks_worth_threads)
  for (std::ptrdiff_t b = 0; b < blocks; ++b)
    for_each_real_row_of_block(grid.layout, grid.active_blocks[b],
                               [&](int begin, int count, const std::array<int, Dim>& node) {
                                 update_row<Dim>(grid, begin, count, node, step, left_over[b]);
                               });
  for (const auto& block : left_over)
    for (const auto& [flat, impulse] : block) share_left_over(grid, flat, impulse);
  impose_wall_velocity(grid);
}

#define GEODROP_INSTANTIATE(D)                                                       \
  template double light_mass<D>(const Grid<D>&, const std::array<int, D>&);          \
  template CellRow<D> node_measures<D>(const Grid<D>&, int, std::array<int, D>);     \
  template double node_measure<D>(const Grid<D>&, const std::array<int, D>&);        \
  template Vec4 carried_velocity<D>(const Grid<D>&, int, const std::array<int, D>&); \
  template std::array<bool, D> held_by_walls<D>(const GridLayout<D>&, int);          \
  template void impose_wall_velocity<D>(Grid<D>&);                                   \
  template void fold_walls<D>(Grid<D>&);                                             \
  template void fold_walls<D>(const Grid<D>&, Array<Vec4>&);                         \
  template void update_momentum<D>(Grid<D>&, const std::array<double, D>&, double, Weight);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
