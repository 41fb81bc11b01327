#include "even_out_volumes.hpp"

#include <algorithm>
#include <limits>

#include "cells_around.hpp"
#include "grid/neighbourhood.hpp"

namespace geodrop {

template <int Dim>
void even_out_volumes(State<Dim>& state, const Grids<Dim>& grids, double dt) {
  constexpr double evening = 0.1;  // share of the wave speed
  for (Body<Dim>& body : state.bodies) {
    const auto* fluid = std::get_if<Newtonian>(&body.material);
    if (!fluid || body.field == waiting || body.pressure != PressureSupport::cell) continue;
    const Grid<Dim>& grid = grids[body.field];
    // Cavities close as they opened, whatever the pressure of the cell.
    const auto torn = [&](double of_weight) {
      return fluid->cavitates() ? fluid_volume_ratio(*fluid, -fluid->tension_cutoff - of_weight)
                                : std::numeric_limits<double>::infinity();
    };
    const bool level = fluid->has_still_level();
    const double torn_anywhere = torn(0);
    // With an implicit pressure waves may go farther than a cell in a step.
    constexpr double most = 0.5;
    const double way = evening * wave_speed(body.material) * dt, share = std::min(most, way * grid.layout.inv_h);
    const double* const middle_of_row = grid.layout.middle_of_row.data() + GridLayout<Dim>::pad;
    const auto n = static_cast<std::ptrdiff_t>(body.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t p = 0; p < n; ++p) {
      const std::array<int, Dim> place = place_of_cell_at(grid.layout, body.x, p);
      const int cell = grid.layout.index(place);
      const double whole = level ? torn(fluid->of_weight(body.x[Dim - 1][p])) : torn_anywhere;
      if (!(grid.cell_flags[cell] & cell_filled) || body.J[p] >= whole) continue;
      const double of_weight = level ? fluid->of_weight(middle_of_row[place[Dim - 1]]) : 0.0;
      const double mean = fluid_volume_ratio(*fluid, grid.cell_pressure[cell] - of_weight, body.gas_at(p));
      const double here = grid.layout.graded() ? std::min(most, way / least_width(grid.layout, cell)) : share;
      body.J[p] += here * (mean - body.J[p]);
    }
  }
}

#define GEODROP_INSTANTIATE(D) template void even_out_volumes(State<D>&, const Grids<D>&, double);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
