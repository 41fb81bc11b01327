#include "pores.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/side_by_side.hpp"
#include "cut/cells_around.hpp"
#include "cut/interface_cells.hpp"
#include "grid/blocks.hpp"
#include "grid/cell_pressure.hpp"
#include "grid/momentum.hpp"
#include "grid/neighbourhood.hpp"
#include "grid/seams.hpp"
#include "pore_motion.hpp"
#include "transfer/cell_sums.hpp"
#include "transfer/slabs.hpp"

namespace geodrop {
namespace {

constexpr double least_porosity = 0.01;

/// Calls f(soil) once for each pair of fields, of a soil and of its water.
template <class F>
void for_each_pair(const std::vector<PoreSoil>& soils, F f) {
  for (std::size_t s = 0; s < soils.size(); ++s) {
    const auto same = [&](const PoreSoil& other) {
      return other.field == soils[s].field && other.water == soils[s].water;
    };
    if (std::find_if(soils.begin(), soils.end(), same) == soils.begin() + static_cast<std::ptrdiff_t>(s)) f(soils[s]);
  }
}

template <int Dim>
void sum_range(const PoreSoil& soil, const Body<Dim>& body, Grid<Dim>& grid, std::size_t begin, std::size_t end) {
  alignas(64) double grains[chunk_size], volume[chunk_size], n[chunk_size];
  alignas(64) std::int32_t cell[chunk_size], row[chunk_size];
  const double density = reference_density(body.material);
  for (std::size_t p = begin; p < end; p += chunk_size) {
    const int count = static_cast<int>(std::min<std::size_t>(chunk_size, end - p));
    cells_of_chunk(grid.layout, body, p, count, cell, row);
    for (int k = 0; k < count; ++k) {
      grains[k] = body.mass[p + k] / soil.grain_density;
      volume[k] = body.mass[p + k] * body.J[p + k] / density;
      n[k] = std::max(least_porosity, soil.porosity_at(body.J[p + k]));
    }
    for (int k = 0; k < count; ++k) {
      grid.grain_volume[cell[k]] += grains[k];
      grid.drag_resistance[cell[k]] += soil.resistance(n[k]) * volume[k];
    }
    if (soil.forchheimer > 0)
      for (int k = 0; k < count; ++k) grid.inertial_resistance[cell[k]] += soil.inertial_resistance(n[k]) * volume[k];
  }
}

/// Parts of the spline of a node that are in the cells below, at and above it along one axis [-].
template <int Dim>
std::array<double, 3> parts_of_spline(const Grid<Dim>& grid, int axis, int node) {
  std::array<double, 3> part{};
  for (int a = 0; a < 3; ++a) {
    const int cell = node + a - 1;
    const double width = grid.integrals[axis].width[cell];
    if (width > 0) part[a] = grid.integrals[axis].value[cell][2 - a] / width;
  }
  return part;
}

/// Parts of the splines of the nodes of a row.
template <int Dim>
struct RowParts {
  std::array<CellRow<Dim>, 3> along{};                  ///< in the cells before, at and behind each node along x
  std::array<std::array<double, 3>, Dim - 1> across{};  ///< along the other axes, alike for the whole row
};
template <int Dim>
RowParts<Dim> parts_of_row(const Grid<Dim>& grid, int count, const std::array<int, Dim>& node) {
  RowParts<Dim> parts;
  for (int k = 0; k < count; ++k) {
    const std::array<double, 3> part = parts_of_spline<Dim>(grid, 0, node[0] + k);
    for (int a = 0; a < 3; ++a) parts.along[a][k] = part[a];
  }
  for (int axis = 1; axis < Dim; ++axis) parts.across[axis - 1] = parts_of_spline<Dim>(grid, axis, node[axis]);
  return parts;
}

/// What a field of cells has at the nodes of a row: shares of the cells around by their part of the spline.
template <int Dim>
CellRow<Dim> at_nodes(const Grid<Dim>& grid, const Array<double>& cells, const RowParts<Dim>& parts, int begin,
                      int count) {
  CellRow<Dim> sum{};
  for_rows_around<Dim>(grid.layout, [&](int offset, int y, int z) {
    const double* const row = cells.data() + begin + offset;
    const double of_y = parts.across[0][y], of_z = Dim == 3 ? parts.across[Dim - 2][z] : 1.0;
    for (int k = 0; k < count; ++k)
      for (int a = 0; a < 3; ++a) sum[k] += row[k + a - 1] * parts.along[a][k] * of_y * of_z;
  });
  return sum;
}

/// Whether a node is beside cells of which a sharp membrane takes a part: particles on one side of an outline fill the
/// splines of the nodes around in part only.
template <int Dim>
bool beside_membrane(const Grid<Dim>& grid, const Grid<Dim>& around, int flat) {
  return grid.outline.size() > 0 || beside_cut(around, flat);  // all nodes of the content of a bag
}

/// Share of the room at a node beside a membrane that grains have: the room is what they and the water have.
template <int Dim>
double grains_beside(const Grid<Dim>& grid, const Grid<Dim>& around, double grain_density, int flat) {
  const double grains = grid.sum[flat][3] / grain_density, water = spline_volume(around, flat);
  return grains > 0 ? grains / (grains + water) : 0.0;
}

/// What of the drag acts at a node between a bag and a bed of the porosity `of_bed`, where n of the room is water: none
/// where a tenth of that water or more is outside the pores. A node has one velocity of water. Dragged with the soil
/// below, a film thinner than a cell never left: the bag hovered over the bed by 0.8 h.
double drag_under_bag(double n, double of_bed) {
  constexpr double least_free = 0.1;
  const double in_pores = of_bed / (1 - of_bed) * (1 - n) / n;  // share of the water
  return std::clamp((in_pores - (1 - least_free)) / least_free, 0.0, 1.0);
}

/// Porosity, resistance and lightness of grains at the nodes of the water.
template <int Dim>
void weigh_nodes(const Grid<Dim>& grid, double grain_density, double porosity, Grid<Dim>& around) {
  const bool bed = grid.outline.size() == 0;
  for_each_active_real_row(around, [&](int begin, int count, std::array<int, Dim> node) {
    const RowParts<Dim> parts = parts_of_row<Dim>(around, count, node);
    const CellRow<Dim> room = node_measures<Dim>(around, count, node);
    const CellRow<Dim> occupied = at_nodes<Dim>(around, around.occupied, parts, begin, count);
    const CellRow<Dim> resistance = at_nodes<Dim>(around, grid.drag_resistance, parts, begin, count);
    for (int k = 0; k < count; ++k, ++node[0]) {
      const int flat = begin + k;
      const bool beside = beside_membrane(grid, around, flat);
      const double grains = beside ? grains_beside(grid, around, grain_density, flat) : occupied[k] / room[k];
      const double n = std::max(0.0, 1 - grains);
      around.pore_share[flat] = n;
      // The flow n w is even where the porosity jumps, hence n^2 of the node, not of the soil: with that of the soil
      // water leaves as if the soil ended half a cell lower.
      around.node_drag[flat] = grains > 0 ? n * n * resistance[k] : 0.0;
      if (bed && beside && grains > 0) around.node_drag[flat] *= drag_under_bag(n, porosity);
      const double mass = std::max(grid.sum[flat][3], light_mass<Dim>(grid, node));
      around.grain_lightness[flat] = grid.sum[flat][3] > 0 ? (1 - n) * (1 - n) / mass : 0.0;
    }
  });
}

/// Forchheimer's drag at the nodes of the water.
template <int Dim>
void weigh_inertial_drag(const Grid<Dim>& grid, Grid<Dim>& around) {
  for_each_active_real_row(around, [&](int begin, int count, const std::array<int, Dim>& node) {
    const RowParts<Dim> parts = parts_of_row<Dim>(around, count, node);
    const CellRow<Dim> resistance = at_nodes<Dim>(around, grid.inertial_resistance, parts, begin, count);
    for (int k = 0; k < count; ++k)
      around.node_inertial_drag[begin + k] = std::pow(around.pore_share[begin + k], 3) * resistance[k];
  });
}

/// The drag c + b |w| with the w = v_w - v_s after the impulse, which solves (1 + dt L (c + b |w|)) |w| = |w before|, L
/// the sum of both 1/m: no time step is too large for it.
double implicit_drag(double c, double b, double dt_lightness, double speed) {
  const double linear = 1 + dt_lightness * c;
  const double after = 2 * speed / (linear + std::sqrt(linear * linear + 4 * dt_lightness * b * speed));
  return c + b * after;
}

/// The drag between both new nodal velocities as an impulse and its opposite; drag(node, v_w - v_s) [N s/m].
template <int Dim, class F>
void exchange_impulses(double dt, Grid<Dim>& around, Grid<Dim>& grid, F drag) {
  for_each_active_real_row(around, [&](int begin, int count, const std::array<int, Dim>&) {
    for (int flat = begin; flat < begin + count; ++flat) {
      const double of_water = around.sum[flat][3], of_soil = grid.sum[flat][3];
      if (!(of_water > 0 && of_soil > 0 && around.node_drag[flat] > 0)) continue;
      Vec4 impulse = around.velocity[flat] - grid.velocity[flat];
      const double c = drag(flat, impulse);
      impulse *= dt * c / (1 + dt * c * (1 / of_water + 1 / of_soil));
      impulse[3] = 0;
      const auto act = [&](Grid<Dim>& on, const Vec4& change) {
        on.velocity[flat] += change;
        if (!on.velocity_change.empty()) on.velocity_change[flat] += change;
      };
      act(around, -impulse / of_water);
      act(grid, impulse / of_soil);
    }
  });
}

/// Whether a wall takes a component of the force on a node.
template <int Dim>
bool wall_takes(const GridLayout<Dim>& layout, const std::array<int, Dim>& node, int component) {
  constexpr int pad = GridLayout<Dim>::pad;
  for (int axis = 0; axis < Dim; ++axis) {
    if (layout.periodic(axis) || (node[axis] != pad && node[axis] != pad + layout.cells[axis])) continue;
    const WallKind wall = node[axis] == pad ? layout.lower_wall[axis] : layout.upper_wall[axis];
    if (axis == component || wall == WallKind::no_slip) return true;
  }
  return false;
}

/// Adds the soil's part of the force of the cell pressures. What a wall takes is left out: nodes of small mass, as
/// those over the surface of a bed, would hand it to their neighbours.
template <int Dim>
void push_grains(Grid<Dim>& grid, const Grid<Dim>& around) {
  for_each_active_real_row(around, [&](int begin, int count, std::array<int, Dim> node) {
    const RowForce<Dim> force = cell_pressure_force<Dim>(around, begin, count, node);
    for (int k = 0; k < count; ++k, ++node[0])
      for (int a = 0; a < Dim && grid.sum[begin + k][3] > 0; ++a)
        if (!wall_takes<Dim>(grid.layout, node, a))
          grid.force[begin + k][a] += (1 - around.pore_share[begin + k]) * force[a][k];
  });
}

/// What the parts of cells beside a membrane change of that, for both.
template <int Dim>
void push_beside_membrane(Grid<Dim>& grid, Grid<Dim>& around) {
  for_each_interface_force<Dim>(around, [&](int node, const std::array<double, Dim>& force) {
    const double n = around.pore_share[node];
    for (int a = 0; a < Dim; ++a) {
      around.force[node][a] += n * force[a];
      if (n < 1) grid.force[node][a] += (1 - n) * force[a];
    }
  });
}

/// n v_w + (1 - n) v_s. In a bag as impulses see both: with the velocities of nodes of small mass, those beside a
/// membrane, a fifth of what seeped through it was lost.
template <int Dim>
void mix_velocities(const Grid<Dim>& grid, Grid<Dim>& around) {
  for_each_active_row(around, [&](int begin, int count, std::array<int, Dim> node) {
    for (int flat = begin; flat < begin + count; ++flat, ++node[0]) {
      const double n = around.sum[flat][3] > 0 ? around.pore_share[flat] : 1.0;
      if ((around.sum[flat][3] > 0 || grid.sum[flat][3] > 0) && beside_membrane(grid, around, flat))
        around.mixture_velocity[flat] = around.pore_share[flat] * carried_velocity<Dim>(around, flat, node) +
                                        (1 - around.pore_share[flat]) * carried_velocity<Dim>(grid, flat, node);
      else
        around.mixture_velocity[flat] = n * around.velocity[flat] + (1 - n) * grid.velocity[flat];
    }
  });
}

}  // namespace

template <int Dim>
void sum_grains(const std::vector<PoreSoil>& soils, const State<Dim>& state, Grids<Dim>& grids) {
  for_each_pair(soils, [&](const PoreSoil& pair) {
    Grid<Dim>&grid = grids[pair.field], &around = grids[pair.water];
    for_each_slab_by_colour(state, grid, [&](const Body<Dim>& body, std::size_t begin, std::size_t end) {
      for (const PoreSoil& soil : soils) {
        if (&body != &state.bodies[soil.body]) continue;
        with_level([&](auto) { sum_range(soil, body, grid, begin, end); });
      }
    });
    for_each_seam(grid.layout, [&](int axis) {
      sum_over_seam(grid.layout, axis, grid.grain_volume);
      sum_over_seam(grid.layout, axis, grid.drag_resistance);
      if (!grid.inertial_resistance.empty()) sum_over_seam(grid.layout, axis, grid.inertial_resistance);
    });
    for_each_active_row(around, [&](int begin, int count, const auto&) {
      std::copy_n(grid.grain_volume.begin() + begin, count, around.occupied.begin() + begin);
    });
  });
}

template <int Dim>
void share_pore_pressure(const std::vector<PoreSoil>& soils, double dt, Grids<Dim>& grids) {
  for_each_pair(soils, [&](const PoreSoil& soil) {
    Grid<Dim>&grid = grids[soil.field], &around = grids[soil.water];
    weigh_nodes(grid, soil.grain_density, soil.porosity, around);
    if (!around.node_inertial_drag.empty()) weigh_inertial_drag(grid, around);
    if (around.largest_modulus > 0) {
      soften_light_parts(around, dt);
      soften_light_cells(around, dt);
    }
    push_grains(grid, around);
    push_beside_membrane(grid, around);
  });
}

template <int Dim>
void drag_pore_water(const std::vector<PoreSoil>& soils, double dt, Grids<Dim>& grids) {
  for_each_pair(soils, [&](const PoreSoil& soil) {
    Grid<Dim>&around = grids[soil.water], &grid = grids[soil.field];
    const auto of_darcy = [&](int node, const Vec4&) { return around.node_drag[node]; };
    const auto of_forchheimer = [&](int node, const Vec4& w) {
      double square = 0;
      for (int a = 0; a < Dim; ++a) square += w[a] * w[a];
      const double lightness = 1 / around.sum[node][3] + 1 / grid.sum[node][3];
      return implicit_drag(around.node_drag[node], around.node_inertial_drag[node], dt * lightness, std::sqrt(square));
    };
    if (around.node_inertial_drag.empty())
      exchange_impulses(dt, around, grid, of_darcy);
    else
      exchange_impulses(dt, around, grid, of_forchheimer);
    impose_wall_velocity(around);
    impose_wall_velocity(grid);
  });
}

template <int Dim>
void press_implicitly(const std::vector<PoreSoil>& soils, double dt, State<Dim>& state, Grids<Dim>& grids) {
  std::vector<std::function<void()>> presses;
  std::vector<int> moved;  // fields
  for (Grid<Dim>& grid : grids)
    if (!grid.pore_modulus.empty() && grid.pore_share.empty()) {
      presses.emplace_back([&] { press_pores(state, grid, dt); });
      moved.push_back(grid.field);
    }
  for_each_pair(soils, [&](const PoreSoil& soil) {
    if (grids[soil.water].pore_modulus.empty()) return;
    presses.emplace_back([&, field = soil.field, water = soil.water] {
      PoreMotion<Dim> motion(grids[field], grids[water], dt);
      press_pores(state, grids[water], dt, &motion);
    });
    moved.insert(moved.end(), {soil.field, soil.water});
  });
  std::ranges::sort(moved);
  run_side_by_side(presses, std::ranges::adjacent_find(moved) == moved.end());
}

template <int Dim>
void update_pore_rate(const std::vector<PoreSoil>& soils, Grids<Dim>& grids) {
  for_each_pair(soils, [&](const PoreSoil& soil) {
    Grid<Dim>&around = grids[soil.water], &grid = grids[soil.field];
    mix_velocities(grid, around);
    std::swap(around.velocity, around.mixture_velocity);
    cell_volume_rate(around);
    std::swap(around.velocity, around.mixture_velocity);
  });
}

#define GEODROP_INSTANTIATE(D)                                                                \
  template void sum_grains(const std::vector<PoreSoil>&, const State<D>&, Grids<D>&);         \
  template void share_pore_pressure(const std::vector<PoreSoil>&, double, Grids<D>&);         \
  template void drag_pore_water(const std::vector<PoreSoil>&, double, Grids<D>&);             \
  template void press_implicitly(const std::vector<PoreSoil>&, double, State<D>&, Grids<D>&); \
  template void update_pore_rate(const std::vector<PoreSoil>&, Grids<D>&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
