#include "interface_cells.hpp"

#include <geodrop/base/error.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "cell_parts.hpp"
#include "cell_slopes.hpp"
#include "clipped_cells.hpp"
#include "cut_cells.hpp"
#include "grid/cell_pressure.hpp"
#include "grid/momentum.hpp"
#include "grid/part_groups.hpp"
#include "part_hosts.hpp"
#include "uncut_cells.hpp"
#include "wet_cells.hpp"

namespace geodrop {
namespace {

/// Whether a surface ends at a wall.
bool ends_at(const Membrane<2>&, int, bool) { return false; }
bool ends_at(const Membrane<3>& membrane, int axis, bool upper) {
  const Array<std::uint32_t>& walls = membrane.triangles.open_edge[2];
  return std::find(walls.begin(), walls.end(), wall_number(axis, upper)) != walls.end();
}

/// Cells at walls are half cells with mirrored nodes: an outline stays out of them, unless it ends there.
template <int Dim>
void check_walls(const GridLayout<Dim>& layout, const Membrane<Dim>& membrane, const Outline<Dim>& cells) {
  constexpr int margin = 1;  // of the box around the outline
  for (int a = 0; a < Dim; ++a) {
    const int first = cells.first[a] + margin - GridLayout<Dim>::pad;
    const int last = first + cells.count[a] - 2 * margin - 1;
    if ((first >= 1 || ends_at(membrane, a, false)) && (last <= layout.cells[a] - 1 || ends_at(membrane, a, true)))
      continue;
    throw RunError(fmt::format(
        "membrane '{}' came within half a cell of a wall of the domain (axis {}), where a sharp interface has no room",
        membrane.name, a));
  }
}

/// Collects the parts that a field has of cells, at most one for each cell.
template <int Dim>
class PartList {
 public:
  explicit PartList(Grid<Dim>& grid) : grid_(grid) {}

  PartCell<Dim>& at(int flat, const Slope<Dim>& if_new) {
    const auto [place, is_new] = place_.try_emplace(flat, grid_.part_cells.size());
    if (is_new) grid_.part_cells.push_back({flat, -1, if_new});
    return grid_.part_cells[place->second];
  }

 private:
  Grid<Dim>& grid_;
  std::map<int, std::size_t> place_;
};

/// Takes what rigid bodies have of cells from the parts of the fluid that they touch.
template <int Dim>
void leave_out_rigid(Grid<Dim>& grid, PartList<Dim>& parts) {
  for (const RigidPart<Dim>& rigid : grid.rigid_parts) {
    PartCell<Dim>& part = parts.at(rigid.flat, slopes_in_domain(grid.layout, rigid.flat));
    for (int n = 0; n < nodes_around<Dim>; ++n)
      for (int a = 0; a < Dim; ++a) part.slope[n][a] -= rigid.slope[n][a];
    part.host = host_beside_rigid(grid, rigid.flat, rigid.outward);
    if (part.host < 0) continue;
    int n = 0;
    for_neighbourhood(grid.layout, rigid.flat, [&](int, const std::array<int, Dim>& at) {
      grid.rigid_filled[mirrored<Dim>(grid.layout, stored_cell(grid.layout, rigid.flat), at)] += rigid.value[n++];
    });
  }
}

/// Cells whose pressure others share are parts too, so that a host and its guests stand together in the list.
template <int Dim>
void sort_by_host(Grid<Dim>& grid, PartList<Dim>& parts) {
  const std::size_t guests = grid.part_cells.size();
  for (std::size_t n = 0; n < guests; ++n)
    if (const int host = grid.part_cells[n].host; host >= 0)
      parts.at(host, slopes_in_domain(grid.layout, host)).host = host;
  std::sort(grid.part_cells.begin(), grid.part_cells.end(),
            [](const auto& a, const auto& b) { return std::pair(a.host, a.flat) < std::pair(b.host, b.flat); });
}

/// One pressure for all parts of each group; parts without a host leave it to their particles.
template <int Dim>
void share_pressure(Grid<Dim>& grid) {
  for (const PartCell<Dim>& part : grid.part_cells)
    if (part.host < 0) {
      grid.cell_flags[part.flat] = 0;
      grid.cell_pressure[part.flat] = 0;
    }
  for_each_group(grid.part_cells, [&](auto first, auto last) {
    double sum = 0;
    for (auto part = first; part != last; ++part) sum += grid.cell_pressure[part->flat] * grid.cell_volume[part->flat];
    const double pressure = sum / sum_of_group(grid.cell_volume, first, last);
    for (auto part = first; part != last; ++part) {
      grid.cell_pressure[part->flat] = pressure;
      grid.cell_flags[part->flat] |= cell_filled;
    }
  });
}

/// The fields inside a sharp membrane whose cells have a pressure: that above, and that of a skeleton by itself.
template <int Dim>
std::vector<int> fields_inside(const Membrane<Dim>& membrane, Grids<Dim>& grids) {
  std::vector<int> fields{pressed_field(membrane, grids).field};
  if (const Grid<Dim>& grid = grids[membrane.field]; grid.field != fields.front() && grid.largest_modulus > 0)
    fields.push_back(grid.field);
  return fields;
}

/// What the last step left in cells beside an interface, in blocks that may not be active any more.
template <int Dim>
void forget_cells(Grids<Dim>& grids) {
  Grid<Dim>& around = grids.front();
  for (Grid<Dim>& grid : grids) {
    for (std::size_t c = 0; c < grid.outline.size(); ++c) {
      const int flat = flat_of(grid.layout, grid.outline, static_cast<int>(c));
      grid.taken[flat] = around.taken[flat] = 0;
      if (grid.pore_water > 0) grids[grid.pore_water].taken[flat] = 0;
    }
    for (const PartCell<Dim>& part : grid.part_cells) {
      grid.cell_flags[part.flat] = 0;
      grid.cell_pressure[part.flat] = grid.volume_rate[part.flat] = 0;
    }
    grid.part_cells.clear();
  }
}

}  // namespace

template <int Dim>
void cut_interface_cells(const State<Dim>& state, Grids<Dim>& grids) {
  forget_cells(grids);
  Grid<Dim>& around = grids.front();
  for (const Membrane<Dim>& membrane : state.membranes) {
    if (!acts_sharply(membrane)) continue;
    Grid<Dim>& grid = grids[membrane.field];
    cut(grid.layout, membrane, grid.outline);
    check_walls(grid.layout, membrane, grid.outline);
    for (std::size_t c = 0; c < grid.outline.size(); ++c) {
      const int flat = flat_of(grid.layout, grid.outline, static_cast<int>(c));
      grid.taken[flat] = 1 - inside_of(grid.outline)[c];
      pressed_field(membrane, grids).taken[flat] = grid.taken[flat];
      around.taken[flat] += inside_of(grid.outline)[c];
    }
  }
}

template <int Dim>
void share_interface_pressure(const State<Dim>& state, Grids<Dim>& grids) {
  Grid<Dim>& around = grids.front();
  std::vector<PartList<Dim>> lists;
  for (Grid<Dim>& grid : grids) lists.emplace_back(grid);
  for (const Membrane<Dim>& membrane : state.membranes) {
    if (!acts_sharply(membrane)) continue;
    const Grid<Dim>& grid = grids[membrane.field];
    const std::vector<int> inner = fields_inside(membrane, grids);
    for (const CutCell<Dim>& cell : cut_cells_of(grid, membrane)) {
      const CellSpans<Dim> spans = spans_of(around.layout, cell.flat);
      PartCell<Dim>& outside = lists.front().at(cell.flat, slopes_in_domain(around.layout, cell.flat));
      outside.host = is_wet(around, cell.flat) ? find_host(around, cell.flat, cell.normal) : -1;
      const SplineVolumes<Dim> whole = whole_value(spans);
      for (int n = 0; n < nodes_around<Dim>; ++n) {
        outside.elsewhere[n] += cell.value[n];
        for (int a = 0; a < Dim; ++a) outside.slope[n][a] -= cell.inside[n][a];
      }
      std::array<double, Dim> inwards;
      for (int a = 0; a < Dim; ++a) inwards[a] = -cell.normal[a];
      for (const int field : inner) {
        PartCell<Dim>& inside = lists[field].at(cell.flat, cell.inside);
        inside.host = find_host(grids[field], cell.flat, inwards);
        for (int n = 0; n < nodes_around<Dim>; ++n) inside.elsewhere[n] += whole[n] - cell.value[n];
      }
    }
    // Whole cells with too little pore water for a pressure: what flows into them would leave the bag.
    if (const int water = grid.pore_water; water > 0)
      for_each_uncut(grid.layout, grid.outline, true, [&](int flat) {
        const int host = find_host(grids[water], flat, {});
        if (host >= 0 && host != flat) lists[water].at(flat, slopes_in_domain(grid.layout, flat)).host = host;
      });
    // Cells of the other field, and particles that strayed there.
    const auto take_in_strays = [&](int field, bool inside) {
      for_each_uncut(grid.layout, grid.outline, inside, [&](int flat) {
        if (grids[field].cell_volume[flat] > 0)
          lists[field].at(flat, Slope<Dim>{}).host = find_host(grids[field], flat, {});
      });
    };
    for (const int field : inner) take_in_strays(field, false);
    take_in_strays(0, true);
  }
  for (std::size_t f = 0; f < grids.size(); ++f) {
    leave_out_rigid(grids[f], lists[f]);
    if (grids[f].part_cells.empty()) continue;
    sort_by_host(grids[f], lists[f]);
    share_pressure(grids[f]);
  }
}

template <int Dim>
void for_each_interface_force(const Grid<Dim>& grid, const ForceAtNode<Dim>& f) {
  for (const PartCell<Dim>& part : grid.part_cells) {
    const Slope<Dim> whole = slopes_in_domain(grid.layout, part.flat);
    const double pressure = grid.cell_pressure[part.flat];
    for (int n = 0; n < nodes_around<Dim>; ++n) {
      std::array<double, Dim> force;
      for (int a = 0; a < Dim; ++a) force[a] = pressure * (part.slope[n][a] - whole[n][a]);
      f(node_around(grid.layout, part.flat, n), force);
    }
  }
}

template <int Dim>
void add_interface_force(Grids<Dim>& grids, double dt) {
  for (Grid<Dim>& grid : grids) {
    if (!grid.pore_share.empty()) continue;  // shared with the grains, see pores/pores
    if (grid.largest_modulus > 0) soften_light_parts(grid, dt);
    for_each_interface_force(grid, [&](int node, const std::array<double, Dim>& force) {
      for (int a = 0; a < Dim; ++a) grid.force[node][a] += force[a];
    });
  }
}

template <int Dim>
void update_interface_rates(Grids<Dim>& grids) {
  for (Grid<Dim>& grid : grids) {
    const auto velocity = [&](int node) {
      return grid.mixture_velocity.empty() ? carried_velocity<Dim>(grid, node, stored_cell(grid.layout, node))
                                           : grid.mixture_velocity[node];
    };
    for_each_group(grid.part_cells, [&](auto first, auto last) {
      double flow = 0;
      for (auto part = first; part != last; ++part)
        for (int n = 0; n < nodes_around<Dim>; ++n) {
          const Vec4 v = velocity(node_around(grid.layout, part->flat, n));
          double along = part->slope[n][0] * v[0];
          for (int a = 1; a < Dim; ++a) along += part->slope[n][a] * v[a];
          flow += along;
        }
      const double rate = first->share * flow / sum_of_group(grid.cell_volume, first, last);
      for (auto part = first; part != last; ++part) grid.volume_rate[part->flat] = rate;
    });
  }
}

#define GEODROP_INSTANTIATE(D)                                                   \
  template void cut_interface_cells(const State<D>&, Grids<D>&);                 \
  template void share_interface_pressure(const State<D>&, Grids<D>&);            \
  template void for_each_interface_force(const Grid<D>&, const ForceAtNode<D>&); \
  template void add_interface_force(Grids<D>&, double);                          \
  template void update_interface_rates(Grids<D>&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
