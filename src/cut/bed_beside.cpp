#include "bed_beside.hpp"

#include <geodrop/base/find_named.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cells_around.hpp"
#include "clipped_cells.hpp"
#include "cut_cells.hpp"
#include "grid/momentum.hpp"

namespace geodrop {
namespace {

/// Share of a coupled bed that is grains; 0 if none of it is in the box of an outline.
template <int Dim>
double share_of_grains(const Grid<Dim>& around, const Outline<Dim>& cells, const BedCells& bed) {
  double soil = 0, grains = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (!(bed.volume[c] > 0)) continue;
    soil += bed.volume[c];
    grains += around.occupied[flat_of(around.layout, cells, static_cast<int>(c))];
  }
  return soil > 0 ? grains / soil : 0.0;
}

/// Whether a stretch lies on the bed: most of what is in the cells around it.
template <int Dim>
void look_for_soil(const Grid<Dim>& around, const Outline<Dim>& cells, const BedCells& bed, Contact<Dim>& contact) {
  double soil = 0, pore = 0, all = 0;
  for_each_cell_of(cells, contact.stretch, [&](int cell) {
    for (int n = 0; n < nodes_around<Dim>; ++n) {
      const int local = local_around(cells, cell, n);
      soil += bed.volume[local];
      pore += bed.pore[local];
      all += around.cell_volume[flat_of(around.layout, cells, local)];
    }
  });
  contact.on_bed = soil > 0.5 * all;
  if (contact.on_bed) contact.pore_pressure = pore / soil;
}

/// The least width of the cells of a stretch [m].
template <int Dim>
double width_beside(const GridLayout<Dim>& layout, const Outline<Dim>& cells, const Contact<Dim>& contact) {
  double width = std::numeric_limits<double>::infinity();
  for_each_cell_of(cells, contact.stretch,
                   [&](int cell) { width = std::min(width, least_width(layout, flat_of(layout, cells, cell))); });
  return width;
}

/// How far a stretch is from a coupled bed of a share of grains, from that share at the stretch: where the bed ends at
/// a gap g, particles to nodes and nodes to the stretch have smoothed it to 1 - 2 (66 / 120) g / h of the whole.
template <int Dim>
void look_for_grains(const Grid<Dim>& around, const Outline<Dim>& cells, double share, Contact<Dim>& contact) {
  constexpr double slope = 1.1, most = 0.5;  // of the gap [cells]
  double grains = 0, all = 0;
  for (const auto& [node, value] : normals_of(around.layout, cells, contact)) {
    const double n = around.pore_share[node];
    if (!(n > 0)) continue;
    double weight = 0;
    for (const double part : value) weight += part * part;
    weight = std::sqrt(weight) * spline_volume(around, node) / n;
    grains += weight * (1 - n);
    all += weight;
  }
  if (!(all > 0)) return;
  const double gap = (1 - grains / all / share) / slope;
  contact.on_grains = gap < most;
  contact.gap = std::max(0.0, gap) * width_beside(around.layout, cells, contact);
}

}  // namespace

template <int Dim>
BedCells bed_around(const State<Dim>& state, const Grid<Dim>& around, const Membrane<Dim>& membrane,
                    const Outline<Dim>& cells) {
  const GridLayout<Dim>& layout = around.layout;
  BedCells out{Array<double>(cells.size(), 0.0), Array<double>(cells.size(), 0.0)};
  const Body<Dim>& bed = find_named(state.bodies, membrane.bed);
  const BoxOfCells<Dim> box(layout, cells);
  for (std::size_t p = 0; p < bed.size(); ++p) {
    if (!box.may_hold(bed.x, p)) continue;
    const int cell = local_cell(layout, cells, vector_at(bed.x, p));
    if (cell < 0) continue;
    const double volume = bed.volume(p);
    out.volume[cell] += volume;
    if (!bed.pore_pressure.empty()) out.pore[cell] += volume * bed.pore_pressure[p];
  }
  if (!membrane.bed_pressure.empty()) out.grains = share_of_grains(around, cells, out);
  return out;
}

template <int Dim>
void look_for_bed(const Grid<Dim>& around, const Outline<Dim>& cells, const BedCells& bed, Contact<Dim>& contact) {
  if (contact.membrane->bed_pressure.empty())
    look_for_soil(around, cells, bed, contact);
  else if (bed.grains > 0)
    look_for_grains(around, cells, bed.grains, contact);
}

#define GEODROP_INSTANTIATE(D)                                                                          \
  template BedCells bed_around(const State<D>&, const Grid<D>&, const Membrane<D>&, const Outline<D>&); \
  template void look_for_bed(const Grid<D>&, const Outline<D>&, const BedCells&, Contact<D>&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
