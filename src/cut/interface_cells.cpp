#include "interface_cells.hpp"

#include <geodrop/base/error.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <sstream>

#include "cell_slopes.hpp"
#include "grid/blocks.hpp"
#include "grid/momentum.hpp"
#include "grid/nearby_cells.hpp"
#include "outline_pieces.hpp"
#include "wet_cells.hpp"

namespace geodrop {
namespace {

/// A part stands by itself if it is this share of its cell, and particles fill this share.
constexpr double least_part = 0.5, least_filled = 0.3;

/// Cells at walls are half cells with mirrored nodes: an outline stays out of them.
void check_walls(const GridLayout<2>& layout, const Membrane<2>& membrane, const CutCells& cells) {
  constexpr int margin = 1;  // of the box around the outline
  for (int a = 0; a < 2; ++a) {
    const int first = cells.first[a] + margin - GridLayout<2>::pad;
    const int last = first + cells.count[a] - 2 * margin - 1;
    if (first >= 1 && last <= layout.cells[a] - 1) continue;
    std::ostringstream text;
    text << "membrane '" << membrane.name << "' came within half a cell of a wall of the domain (axis " << a
         << "), where a sharp interface has no room";
    throw RunError(text.str());
  }
}

/// Integral of a node's spline over the plane [m2].
double spline_area(const GridLayout<2>& layout, int node) {
  const int i = node % layout.stride[1] - layout.pad, j = node / layout.stride[1] - layout.pad;
  return layout.spline_width(0, i) * layout.spline_width(1, j) * layout.h * layout.h;
}

/// What an outline makes of a cell that it cuts: a_ic, int N over the part inside [m2], the sum of outward normals [m].
struct CutCell {
  int flat;
  Slope inside{};
  std::array<double, 9> value{};
  std::array<double, 2> normal{};
};

std::vector<CutCell> cut_cells_of(const Grid<2>& grid, const Membrane<2>& membrane) {
  const CutCells& cells = grid.outline;
  std::vector<int> place(cells.size(), -1);
  std::vector<CutCell> cut;
  for (const CutCells::Piece& piece : cells.pieces) {
    if (place[piece.cell] < 0) {
      place[piece.cell] = static_cast<int>(cut.size());
      const int flat = flat_of(grid.layout, cells, piece.cell);
      const CellSpans spans = spans_of(grid.layout, flat);
      cut.push_back({flat, faces_of(cells, piece.cell, spans), beside_right_face(cells, piece.cell, spans), {}});
    }
    CutCell& cell = cut[place[piece.cell]];
    const PieceIntegral integral = integrate_piece(grid.layout, membrane, cells, piece);
    for (int n = 0; n < 9; ++n) cell.value[n] += integral.beside[n] * integral.normal[0];
    for (int a = 0; a < 2; ++a) {
      cell.normal[a] += integral.normal[a];
      for (int n = 0; n < 9; ++n) cell.inside[n][a] += integral.mean[n] * integral.normal[a];
    }
  }
  return cut;
}

/// Whether the field's part of a cell stands by itself.
bool stands(const Grid<2>& grid, int flat) {
  const double whole = cell_area(grid.layout, flat);
  const double grains = grid.occupied.empty() ? 0.0 : grid.occupied[flat];
  return 1 - grid.taken[flat] >= least_part && (grid.cell_flags[flat] & cell_filled) && grid.cell_volume[flat] > 0 &&
         grid.cell_volume[flat] + grains >= least_filled * whole;
}

/// The nearest cell that stands by itself, rather one to the side that `towards` points to: a thin body has water on
/// both sides. -1 if there is none nearby.
int find_host(const Grid<2>& grid, int flat, const std::array<double, 2>& towards) {
  static const std::vector<std::array<int, 2>> nearby = offsets_by_distance<2>();
  if (stands(grid, flat)) return flat;
  for (const bool same_side : {true, false})
    for (const auto& [x, y] : nearby) {
      if ((x * towards[0] + y * towards[1] > 0) != same_side) continue;
      const int other = flat + x + y * grid.layout.stride[1];
      if (stands(grid, other)) return other;
    }
  return -1;
}

/// Collects the parts that a field has of cells, at most one for each cell.
class PartList {
 public:
  explicit PartList(Grid<2>& grid) : grid_(grid) {}

  PartCell& at(int flat, const Slope& if_new) {
    const auto [place, is_new] = place_.try_emplace(flat, grid_.part_cells.size());
    if (is_new) grid_.part_cells.push_back({flat, -1, if_new});
    return grid_.part_cells[place->second];
  }

 private:
  Grid<2>& grid_;
  std::map<int, std::size_t> place_;
};

/// f(flat) for the cells that an outline does not cut and that lie inside, or else outside.
template <class F>
void for_each_uncut(const GridLayout<2>& layout, const CutCells& cells, bool inside, F&& f) {
  std::vector<bool> cut(cells.size(), false);
  for (const CutCells::Piece& piece : cells.pieces) cut[piece.cell] = true;
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (!cut[c] && (cells.area[c] > 0.5) == inside) f(flat_of(layout, cells, static_cast<int>(c)));
}

/// Cells whose pressure others share are parts too, so that a host and its guests stand together in the list.
void sort_by_host(Grid<2>& grid, PartList& parts) {
  const std::size_t guests = grid.part_cells.size();
  for (std::size_t n = 0; n < guests; ++n)
    if (const int host = grid.part_cells[n].host; host >= 0)
      parts.at(host, whole_cell(spans_of(grid.layout, host))).host = host;
  std::sort(grid.part_cells.begin(), grid.part_cells.end(),
            [](const PartCell& a, const PartCell& b) { return std::pair(a.host, a.flat) < std::pair(b.host, b.flat); });
}

/// f(first, last) for the parts that share one pressure.
template <class Parts, class F>
void for_each_group(Parts& parts, F&& f) {
  auto first = std::find_if(parts.begin(), parts.end(), [](const PartCell& part) { return part.host >= 0; });
  while (first != parts.end()) {
    const auto last = std::find_if(first, parts.end(), [&](const PartCell& p) { return p.host != first->host; });
    f(first, last);
    first = last;
  }
}

double volume_of_group(const Grid<2>& grid, auto first, auto last) {
  double volume = 0;
  for (auto part = first; part != last; ++part) volume += grid.cell_volume[part->flat];
  return volume;
}

/// One pressure for all parts of each group; parts without a host leave it to their particles.
void share_pressure(Grid<2>& grid) {
  for (const PartCell& part : grid.part_cells)
    if (part.host < 0) {
      grid.cell_flags[part.flat] = 0;
      grid.cell_pressure[part.flat] = 0;
    }
  for_each_group(grid.part_cells, [&](auto first, auto last) {
    double sum = 0;
    for (auto part = first; part != last; ++part) sum += grid.cell_pressure[part->flat] * grid.cell_volume[part->flat];
    const double pressure = sum / volume_of_group(grid, first, last);
    for (auto part = first; part != last; ++part) {
      grid.cell_pressure[part->flat] = pressure;
      grid.cell_flags[part->flat] |= cell_filled;
    }
  });
}

/// The field inside a sharp membrane whose cells have its pressure: that of the water, if water flows in the pores.
Grid<2>& pressed_field(const Membrane<2>& membrane, Grids<2>& grids) {
  const int water = grids[membrane.field].pore_water;
  return grids[water < 0 ? membrane.field : water];
}

/// What the last step left in cells beside an interface, in blocks that may not be active any more.
void forget_cells(Grids<2>& grids) {
  Grid<2>& around = grids.front();
  for (Grid<2>& grid : grids) {
    for (std::size_t c = 0; c < grid.outline.size(); ++c) {
      const int flat = flat_of(grid.layout, grid.outline, static_cast<int>(c));
      grid.taken[flat] = around.taken[flat] = 0;
      if (grid.pore_water > 0) grids[grid.pore_water].taken[flat] = 0;
    }
    for (const PartCell& part : grid.part_cells) {
      grid.cell_flags[part.flat] = 0;
      grid.cell_pressure[part.flat] = grid.volume_rate[part.flat] = 0;
    }
    grid.part_cells.clear();
  }
}

}  // namespace

void cut_interface_cells(const State<2>& state, Grids<2>& grids) {
  forget_cells(grids);
  Grid<2>& around = grids.front();
  for (const Membrane<2>& membrane : state.membranes) {
    if (!acts_sharply(membrane)) continue;
    Grid<2>& grid = grids[membrane.field];
    cut_cells(grid.layout, membrane.x[0], membrane.x[1], grid.outline);
    check_walls(grid.layout, membrane, grid.outline);
    for (std::size_t c = 0; c < grid.outline.size(); ++c) {
      const int flat = flat_of(grid.layout, grid.outline, static_cast<int>(c));
      grid.taken[flat] = 1 - grid.outline.area[c];
      pressed_field(membrane, grids).taken[flat] = grid.taken[flat];
      around.taken[flat] += grid.outline.area[c];
    }
  }
}

void share_interface_pressure(const State<2>& state, Grids<2>& grids) {
  Grid<2>& around = grids.front();
  std::vector<PartList> lists;
  for (Grid<2>& grid : grids) lists.emplace_back(grid);
  for (const Membrane<2>& membrane : state.membranes) {
    if (!acts_sharply(membrane)) continue;
    const Grid<2>&grid = grids[membrane.field], &pressed = pressed_field(membrane, grids);
    for (const CutCell& cell : cut_cells_of(grid, membrane)) {
      PartCell& inside = lists[pressed.field].at(cell.flat, cell.inside);
      inside.host = find_host(pressed, cell.flat, {-cell.normal[0], -cell.normal[1]});
      const CellSpans spans = spans_of(around.layout, cell.flat);
      PartCell& outside = lists.front().at(cell.flat, whole_cell(spans));
      outside.host = is_wet(around, cell.flat) ? find_host(around, cell.flat, cell.normal) : -1;
      const std::array<double, 9> whole = whole_value(spans);
      for (int n = 0; n < 9; ++n) {
        inside.elsewhere[n] += whole[n] - cell.value[n];
        outside.elsewhere[n] += cell.value[n];
        for (int a = 0; a < 2; ++a) outside.slope[n][a] -= cell.inside[n][a];
      }
    }
    // Cells of the other field, and particles that strayed there.
    const auto take_in_strays = [&](const Grid<2>& field, PartList& list, bool inside) {
      for_each_uncut(field.layout, grid.outline, inside, [&](int flat) {
        if (field.cell_volume[flat] > 0) list.at(flat, Slope{}).host = find_host(field, flat, {});
      });
    };
    take_in_strays(pressed, lists[pressed.field], false);
    take_in_strays(around, lists.front(), true);
  }
  for (std::size_t f = 0; f < grids.size(); ++f) {
    if (grids[f].part_cells.empty()) continue;
    sort_by_host(grids[f], lists[f]);
    share_pressure(grids[f]);
  }
}

void even_out_volumes(State<2>& state, const Grids<2>& grids, double dt) {
  constexpr double evening = 0.1;  // share of the wave speed
  for (Body<2>& body : state.bodies) {
    const auto* fluid = std::get_if<Newtonian>(&body.material);
    if (!fluid || body.field == waiting || body.pressure != PressureSupport::cell) continue;
    const Grid<2>& grid = grids[body.field];
    // Cavities close as they opened, whatever the pressure of the cell.
    const double torn = fluid->cavitates() ? 1 / (1 - fluid->tension_cutoff / fluid->bulk_modulus)
                                           : std::numeric_limits<double>::infinity();
    const double way = evening * wave_speed(body.material) * dt, share = way * grid.layout.inv_h;
    const auto n = static_cast<std::ptrdiff_t>(body.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t p = 0; p < n; ++p) {
      const int cell = grid.layout.index({grid.layout.base(0, body.x[0][p]), grid.layout.base(1, body.x[1][p])});
      if (!(grid.cell_flags[cell] & cell_filled) || body.J[p] >= torn) continue;
      const double mean = 1 / (1 + grid.cell_pressure[cell] / fluid->bulk_modulus);
      const double here = grid.layout.graded() ? way / least_width(grid.layout, cell) : share;
      body.J[p] += here * (mean - body.J[p]);
    }
  }
}

namespace {

/// Grains at the nodes of pore water beside a membrane, by their volume: grid/momentum takes 1 - n, as if the splines
/// were full there.
void fill_with_grains(Grid<2>& water) {
  for_each_active_real_row(water, [&](int begin, int count, std::array<int, 2> node) {
    for (int flat = begin; flat < begin + count; ++flat, ++node[0]) {
      const double n = water.pore_share[flat];
      if (!(n > 0 && n < 1)) continue;
      const double grains = water.sum[flat][2] * (1 - n) / n;
      water.velocity[flat][3] += grains / node_measure<2>(water, node) - (1 - n);
    }
  });
}

}  // namespace

void fill_other_sides(const State<2>& state, Grids<2>& grids) {
  const GridLayout<2>& layout = grids.front().layout;
  const auto fill = [&](Grid<2>& grid, int flat, const std::array<double, 9>& value) {
    for (int n = 0; n < 9; ++n) {
      const int node = node_around(layout, flat, n);
      grid.velocity[node][3] += value[n] / spline_area(layout, node);
    }
  };
  for (Grid<2>& grid : grids)
    for (const PartCell& part : grid.part_cells) fill(grid, part.flat, part.elsewhere);
  for (const Membrane<2>& membrane : state.membranes) {
    if (!acts_sharply(membrane)) continue;
    if (Grid<2>& pressed = pressed_field(membrane, grids); !pressed.pore_share.empty()) fill_with_grains(pressed);
    for (const bool inside : {true, false})
      for_each_uncut(layout, grids[membrane.field].outline, inside, [&](int flat) {
        fill(inside ? grids.front() : pressed_field(membrane, grids), flat, whole_value(spans_of(layout, flat)));
      });
  }
}

void for_each_interface_force(const Grid<2>& grid, const std::function<void(int, const std::array<double, 2>&)>& f) {
  for (const PartCell& part : grid.part_cells) {
    const Slope whole = whole_cell(spans_of(grid.layout, part.flat));
    const double pressure = grid.cell_pressure[part.flat];
    for (int n = 0; n < 9; ++n)
      f(node_around(grid.layout, part.flat, n),
        {pressure * (part.slope[n][0] - whole[n][0]), pressure * (part.slope[n][1] - whole[n][1])});
  }
}

void add_interface_force(Grids<2>& grids) {
  for (Grid<2>& grid : grids) {
    if (!grid.pore_share.empty()) continue;  // shared with the grains, see pores/pores
    for_each_interface_force(grid, [&](int node, const std::array<double, 2>& force) {
      for (int a = 0; a < 2; ++a) grid.force[node][a] += force[a];
    });
  }
}

void update_interface_rates(Grids<2>& grids) {
  for (Grid<2>& grid : grids) {
    const int width = grid.layout.stride[1];
    const auto velocity = [&](int node) {
      return grid.mixture_velocity.empty() ? carried_velocity<2>(grid, node, {node % width, node / width})
                                           : grid.mixture_velocity[node];
    };
    for_each_group(grid.part_cells, [&](auto first, auto last) {
      double flow = 0;
      for (auto part = first; part != last; ++part)
        for (int n = 0; n < 9; ++n) {
          const Vec4 v = velocity(node_around(grid.layout, part->flat, n));
          flow += part->slope[n][0] * v[0] + part->slope[n][1] * v[1];
        }
      const double rate = flow / volume_of_group(grid, first, last);
      for (auto part = first; part != last; ++part) grid.volume_rate[part->flat] = rate;
    });
  }
}

}  // namespace geodrop
