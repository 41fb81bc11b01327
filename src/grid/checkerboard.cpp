#include "checkerboard.hpp"

#include <algorithm>
#include <geodrop/materials/materials.hpp>

#include "blocks.hpp"
#include "cell_pressure.hpp"
#include "neighbourhood.hpp"
#include "scene/needs.hpp"
#include "seams.hpp"

namespace geodrop {
namespace {

/// Whether undrained soil fills each cell of a row from flat index `begin` on, and none of it is across a sharp
/// interface: 1 or 0.
template <int Dim>
CellRow<Dim> whole_cells(const Grid<Dim>& grid, int begin, int count) {
  constexpr double enough = 0.9;
  const double *const soil = grid.pore_volume.data() + begin, *const all = grid.cell_volume.data() + begin;
  const std::uint8_t* const flags = grid.cell_flags.data() + begin;
  CellRow<Dim> whole;
  for (int k = 0; k < count; ++k)
    whole[k] = (flags[k] & cell_filled) && all[k] > 0 && soil[k] >= enough * all[k] ? 1.0 : 0.0;
  if (!grid.taken.empty())
    for (int k = 0; k < count; ++k)
      if (grid.taken[begin + k] != 0) whole[k] = 0;
  return whole;
}

/// Adds ((q_c+1 - q_c) / d+ - (q_c - q_c-1) / d-) / w_c along an axis to each cell of a row [Pa]; q is 0 unless a cell
/// and its two neighbours are whole. first: stored coordinate of the row's first cell along the axis.
template <int Dim>
void add_roughness(const Grid<Dim>& grid, int axis, int begin, int count, int first, double* sum) {
  const int stride = grid.layout.stride[axis], step = axis == 0 ? 1 : 0;
  std::array<CellRow<Dim>, 5> whole;  // of the cells two below to two above
  for (int m = 0; m < 5; ++m) whole[m] = whole_cells(grid, begin + (m - 2) * stride, count);
  constexpr int pad = GridLayout<Dim>::pad;
  const int least = grid.layout.periodic(axis) ? 1 : pad + 1;  // the first cell that has one on either side
  const int most = grid.layout.cells[axis] + 2 * pad - least;
  const double *const pressure = grid.cell_pressure.data() + begin, *const widths = grid.integrals[axis].width.data();
  for (int k = 0; k < count; ++k) {
    const int here = first + step * k;
    const auto slope = [&](int m) {  // from cell m to the next, m from -2 to 1
      return (pressure[k + (m + 1) * stride] - pressure[k + m * stride]) * 2 /
             (widths[here + m] + widths[here + m + 1]);
    };
    const auto bend = [&](int m, double below, double above) {
      const double w = widths[here + m], three = whole[m + 1][k] * whole[m + 2][k] * whole[m + 3][k];
      return three != 0 && here + m >= least && here + m <= most ? w * w * w * (above - below) : 0.0;
    };
    const double s0 = slope(-2), s1 = slope(-1), s2 = slope(0), s3 = slope(1);
    const double below = bend(-1, s0, s1), middle = bend(0, s1, s2), above = bend(1, s2, s3);
    const double w0 = widths[here - 1], w1 = widths[here], w2 = widths[here + 1];
    const double change = ((above - middle) * 2 / (w1 + w2) - (middle - below) * 2 / (w0 + w1)) / w1;
    sum[k] += whole[2][k] != 0 ? change : 0.0;
  }
}

}  // namespace

bool has_checkerboard(const Scene& scene, const BodySpec& body) {
  const MaterialSpec* material = find_material(scene, body.material);
  return material && body.pressure == PressureSupport::cell && pore_stiffness(make_material(*material)) > 0;
}

template <int Dim>
bool has_checkerboard(const Body<Dim>& body) {
  return !body.pore_pressure.empty() && body.pressure == PressureSupport::cell;
}

template <int Dim>
void filter_checkerboard(State<Dim>& state, Grid<Dim>& grid, double dt) {
  Array<double>& roughness = grid.volume_rate;  // free until the volume rate is computed
  for_each_active_real_row(grid, [&](int begin, int count, const std::array<int, Dim>& cell) {
    std::fill_n(roughness.begin() + begin, count, 0.0);
    const auto soil = grid.pore_volume.begin() + begin;
    if (std::all_of(soil, soil + count, [](double volume) { return volume == 0; })) return;
    for (int axis = 0; axis < Dim; ++axis)
      add_roughness(grid, axis, begin, count, cell[axis], roughness.data() + begin);
  });
  for_each_seam(grid.layout, [&](int axis) { copy_over_seam(grid.layout, axis, roughness); });
  constexpr double speed = 0.1;                 // of waves
  constexpr double most = 0.5;                  // of a checkerboard in a step, where implicit pores make that long
  constexpr double of_checkerboard = 16 * Dim;  // its roughness over its size
  for (Body<Dim>& body : state.bodies) {
    if (body.field != grid.field || !has_checkerboard(body)) continue;
    const double way = speed * wave_speed(body.material) * dt / of_checkerboard;
    const double share = std::min(way * grid.layout.inv_h, most / of_checkerboard);
    const auto n = static_cast<std::ptrdiff_t>(body.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t p = 0; p < n; ++p) body.pore_pressure[p] -= share * roughness[cell_at(grid.layout, body.x, p)];
  }
}

#define GEODROP_INSTANTIATE(D)                       \
  template bool has_checkerboard<D>(const Body<D>&); \
  template void filter_checkerboard<D>(State<D>&, Grid<D>&, double);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
