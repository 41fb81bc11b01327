#include "interface_contacts.hpp"

#include <geodrop/base/find_named.hpp>

#include <cmath>
#include <optional>

#include "cells_around.hpp"
#include "cut_cells.hpp"
#include "grid/point_support.hpp"
#include "membrane/outline.hpp"
#include "membrane/triangles.hpp"
#include "outline_pieces.hpp"

namespace geodrop {
namespace {

/// Size of a segment or triangle [m, m2].
double size_of(const Membrane<2>& membrane, std::size_t segment) { return segment_length(membrane, segment); }
double size_of(const Membrane<3>& membrane, std::size_t triangle) { return 0.5 * normal_of(membrane, triangle).norm(); }

/// Mean over a stretch of the effective pressure inside.
double pressure_inside(const Membrane<2>& membrane, const CutCells& cells, const Stretch& stretch) {
  const Array<double>& pressure = membrane.contents_pressure;
  double sum = 0;
  for_each_piece(cells, stretch, [&](const CutCells::Piece& piece) {
    const std::size_t start = piece.edge, end = end_of_edge(start, membrane.nodes());
    const double middle = 0.5 * (piece.from + piece.to);
    sum += length_of(membrane, piece) * ((1 - middle) * pressure[start] + middle * pressure[end]);
  });
  return stretch.size > 0 ? sum / stretch.size : 0;
}

/// Where the bed is around a membrane: volume of its particles in each cell of the box, and that times pore pressure.
struct BedCells {
  Array<double> volume, pore;
};

BedCells bed_around(const State<2>& state, const GridLayout<2>& layout, const Membrane<2>& membrane,
                    const CutCells& cells) {
  BedCells out{Array<double>(cells.size(), 0.0), Array<double>(cells.size(), 0.0)};
  const Body<2>& bed = find_named(state.bodies, membrane.bed);
  for (std::size_t p = 0; p < bed.size(); ++p) {
    const int cell = local_cell(layout, cells, bed.x[0][p], bed.x[1][p]);
    if (cell < 0) continue;
    const double volume = bed.volume(p);
    out.volume[cell] += volume;
    if (!bed.pore_pressure.empty()) out.pore[cell] += volume * bed.pore_pressure[p];
  }
  return out;
}

/// Whether a stretch lies on the bed: most of what is in the cells around it.
void look_for_bed(const Grid<2>& around, const CutCells& cells, const BedCells& bed, Contact<2>& contact) {
  double soil = 0, pore = 0, all = 0;
  for_each_piece(cells, contact.stretch, [&](const CutCells::Piece& piece) {
    for (int n = 0; n < 9; ++n) {
      const int local = local_around(cells, piece.cell, n);
      soil += bed.volume[local];
      pore += bed.pore[local];
      all += around.cell_volume[flat_of(around.layout, cells, local)];
    }
  });
  contact.on_bed = soil > 0.5 * all;
  if (contact.on_bed) contact.pore_pressure = pore / soil;
}

/// Velocity of a field at a place by its nodes that have mass; empty where most of the splines are of others.
std::optional<Vec4> velocity_at(const Grid<2>& grid, double x, double y) {
  const GridLayout<2>& layout = grid.layout;
  const std::array<double, 2> place{x, y};
  for (int a = 0; a < 2; ++a)
    if (!layout.periodic(a) && !(place[a] >= layout.lower[a] && place[a] <= layout.upper[a])) return {};
  Vec4 sum{};
  double weights = 0;
  PointSupport<2>(layout, place, 0).for_each_node(layout, [&](int node, double weight) {
    if (!(grid.sum[node][3] > 0)) return;
    sum += weight * grid.velocity[node];
    weights += weight;
  });
  if (weights < 0.5) return {};
  return sum / weights;
}

/// The velocity of slipping beyond the layer of 1.5 to 2 cells beside the membrane, which the grid slows down: with
/// that at the membrane the friction of a flat plate came out as half of what it is.
void look_outside(const Grids<2>& grids, const CutCells& cells, Contact<2>& contact) {
  constexpr double cells_away = 1.75;
  const Membrane<2>& membrane = *contact.membrane;
  const GridLayout<2>& layout = grids.front().layout;
  std::array<double, 2> middle{}, normal{};
  double width = std::numeric_limits<double>::infinity();
  for_each_piece(cells, contact.stretch, [&](const CutCells::Piece& piece) {
    const std::size_t from = piece.edge, to = end_of_edge(from, membrane.nodes());
    const double share = 0.5 * (piece.from + piece.to), length = length_of(membrane, piece);
    std::array<double, 2> way;
    for (int a = 0; a < 2; ++a) {
      way[a] = (piece.to - piece.from) * (membrane.x[a][to] - membrane.x[a][from]);
      middle[a] += length * (membrane.x[a][from] + share * (membrane.x[a][to] - membrane.x[a][from]));
    }
    normal[0] += cells.sense * way[1];
    normal[1] -= cells.sense * way[0];
    width = std::min(width, least_width(layout, flat_of(layout, cells, piece.cell)));
  });
  contact.distance = 0.5 * width;
  const double size = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1]);
  if (!(size > 0 && contact.stretch.size > 0)) return;
  for (int a = 0; a < 2; ++a) middle[a] /= contact.stretch.size, normal[a] /= size;
  const double away = cells_away * width;
  const auto water = velocity_at(grids.front(), middle[0] + away * normal[0], middle[1] + away * normal[1]);
  const auto own = velocity_at(grids[membrane.field], middle[0], middle[1]);
  if (!water || !own) return;
  const Vec4 slip = *water - *own;
  contact.velocity = std::abs(slip[1] * normal[0] - slip[0] * normal[1]);
  contact.distance = away;
}

/// What is beside a stretch in the plane.
void look_beside(const Grids<2>& grids, const CutCells& cells, const BedCells& bed, Contact<2>& contact) {
  const Membrane<2>& membrane = *contact.membrane;
  if (!membrane.bed.empty()) look_for_bed(grids.front(), cells, bed, contact);
  if (membrane.shear == Shear::rough_wall) look_outside(grids, cells, contact);
  if (contact.over_soil()) contact.inside = pressure_inside(membrane, cells, contact.stretch);
}

}  // namespace

template <int Dim>
Array<double>& traction_of(Membrane<Dim>& membrane, Says says) {
  if (says == Says::through) return membrane.pore_pressure;
  return says == Says::normal ? membrane.water_pressure : membrane.water_shear;
}

template <int Dim>
double last_traction(const Contact<Dim>& contact, const Outline<Dim>& cells, Says says) {
  const Array<double>& traction = traction_of(*contact.membrane, says);
  double sum = 0;
  for_each_share(cells, contact.stretch, [&](std::size_t part, double share) {
    sum += traction[part] * (share * size_of(*contact.membrane, part));
  });
  if constexpr (Dim == 2)
    if (says == Says::tangent) sum *= -cells.sense;
  return contact.stretch.size > 0 ? sum / contact.stretch.size : 0;
}

template <int Dim>
void forget_tractions(Membrane<Dim>& membrane) {
  for (Array<double>* traction : {&membrane.water_pressure, &membrane.water_shear, &membrane.bed_shear,
                                  &membrane.pore_pressure, &membrane.seepage})
    std::fill(traction->begin(), traction->end(), 0.0);
}

template <int Dim>
std::vector<Contact<Dim>> find_contacts(State<Dim>& state, const Grids<Dim>& grids) {
  std::vector<Contact<Dim>> contacts;
  const Grid<Dim>& around = grids.front();
  for (Membrane<Dim>& membrane : state.membranes) {
    if (!acts_sharply(membrane)) continue;
    const Outline<Dim>& cells = grids[membrane.field].outline;
    const std::size_t first = contacts.size();
    for (const Stretch& stretch : wet_stretches(around, membrane, cells)) contacts.push_back({&membrane, stretch});
    if constexpr (Dim == 2) {
      const BedCells bed = membrane.bed.empty() ? BedCells{} : bed_around(state, around.layout, membrane, cells);
      for (std::size_t c = first; c < contacts.size(); ++c) look_beside(grids, cells, bed, contacts[c]);
    }
  }
  return contacts;
}

#define GEODROP_INSTANTIATE(D)                                                  \
  template Array<double>& traction_of(Membrane<D>&, Says);                      \
  template double last_traction<D>(const Contact<D>&, const Outline<D>&, Says); \
  template void forget_tractions(Membrane<D>&);                                 \
  template std::vector<Contact<D>> find_contacts(State<D>&, const Grids<D>&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
