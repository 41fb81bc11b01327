#include "cell_pressure.hpp"

#include "cell_slopes.hpp"
#include "neighbourhood.hpp"
#include "seams.hpp"

namespace geodrop {
namespace {

constexpr double interior_slope[3] = {-0.5, 0, 0.5};  ///< int N' of the nodes below, at, above a cell

template <int Dim>
void add_interior_force(const Grid<Dim>& grid, int begin, int count, RowForce<Dim>& force) {
  const auto& interior_value = grid.interior_value;
  for_rows_around<Dim>(grid.layout, [&](int offset, int y, int z) {
    const double* const p = grid.cell_pressure.data() + begin + offset;
    // Seen from the node, a cell below has the node at its upper side: slopes change sign.
    const double value_y = interior_value[y], value_z = Dim == 3 ? interior_value[z] : 1.0;
    const double x_weight = value_y * value_z, y_weight = -interior_slope[y] * value_z;
    const double z_weight = Dim == 3 ? -value_y * interior_slope[z] : 0.0;
    for (int k = 0; k < count; ++k) {
      const double mean = interior_value[0] * (p[k - 1] + p[k + 1]) + interior_value[1] * p[k];
      force[0][k] += x_weight * 0.5 * (p[k - 1] - p[k + 1]);
      force[1][k] += y_weight * mean;
      if constexpr (Dim == 3) force[2][k] += z_weight * mean;
    }
  });
}

template <int Dim>
std::array<double, Dim> force_near_wall(const Grid<Dim>& grid, const std::array<int, Dim>& node, int flat) {
  std::array<double, Dim> force{};
  for_neighbourhood(grid.layout, flat, [&](int cell, const std::array<int, Dim>& a) {
    // The cell at offset a - 1 from the node sees this node at offset 1 - a, i.e. as its entry 2 - a.
    std::array<int, Dim> at, entry;
    for (int axis = 0; axis < Dim; ++axis) {
      at[axis] = node[axis] + a[axis] - 1;
      entry[axis] = 2 - a[axis];
    }
    for (int component = 0; component < Dim; ++component)
      force[component] += grid.cell_pressure[cell] * slope_integral<Dim>(grid, at, entry, component);
  });
  return force;
}

/// sum_i v_i . int_c grad N_i for cells along x, h = 1.
template <int Dim>
void add_interior_flux(const Grid<Dim>& grid, int begin, int count, CellRow<Dim>& flux) {
  const auto& interior_value = grid.interior_value;
  for_rows_around<Dim>(grid.layout, [&](int offset, int y, int z) {
    const Vec4* const v = grid.velocity.data() + begin + offset;
    const double value_y = interior_value[y], value_z = Dim == 3 ? interior_value[z] : 1.0;
    const double x_weight = 0.5 * value_y * value_z, y_weight = interior_slope[y] * value_z;
    const double z_weight = Dim == 3 ? value_y * interior_slope[z] : 0.0;
    for (int k = 0; k < count; ++k) {
      const auto mean = [&](int a) {
        return interior_value[0] * (v[k - 1][a] + v[k + 1][a]) + interior_value[1] * v[k][a];
      };
      flux[k] += x_weight * (v[k + 1][0] - v[k - 1][0]) + y_weight * mean(1) + (Dim == 3 ? z_weight * mean(2) : 0.0);
    }
  });
}

template <int Dim>
double flux_near_wall(const Grid<Dim>& grid, const std::array<int, Dim>& cell, int flat) {
  double flux = 0;
  for_neighbourhood(grid.layout, flat, [&](int node, const std::array<int, Dim>& a) {
    for (int component = 0; component < Dim; ++component)
      flux += grid.velocity[node][component] * slope_integral<Dim>(grid, cell, a, component);
  });
  return flux;
}

}  // namespace

template <int Dim>
RowForce<Dim> cell_pressure_force(const Grid<Dim>& grid, int begin, int count, const std::array<int, Dim>& node) {
  RowForce<Dim> force{};
  if (grid.layout.graded()) {
    force = cell_slopes(grid).force({begin, count, node}, grid.cell_pressure);
  } else if (far_from_walls<Dim>(grid.layout, count, node)) {
    add_interior_force<Dim>(grid, begin, count, force);
  } else {
    std::array<int, Dim> at = node;
    for (int k = 0; k < count; ++k, ++at[0]) {
      const auto f = force_near_wall<Dim>(grid, at, begin + k);
      for (int a = 0; a < Dim; ++a) force[a][k] = f[a];
    }
  }
  const double scale = face_measure(grid.layout);
  for (auto& component : force)
    for (double& f : component) f *= scale;
  return force;
}

template <int Dim>
void cell_volume_rate(Grid<Dim>& grid) {
  const double scale = face_measure(grid.layout);
  for_each_active_real_row(grid, [&](int begin, int count, std::array<int, Dim> cell) {
    CellRow<Dim> flux{};
    if (grid.layout.graded()) {
      const auto velocity = [v = grid.velocity.data()](int component, int node) { return v[node][component]; };
      flux = cell_slopes(grid).flow({begin, count, cell}, velocity);
    } else if (far_from_walls<Dim>(grid.layout, count, cell)) {
      add_interior_flux<Dim>(grid, begin, count, flux);
    } else {
      for (int k = 0; k < count; ++k, ++cell[0]) flux[k] = flux_near_wall<Dim>(grid, cell, begin + k);
    }
    for (int k = 0; k < count; ++k) {
      const int flat = begin + k;
      const bool filled = carries_pressure(grid, flat);
      const double share = grid.volume_rate[flat];  // of soften_light_cells
      grid.volume_rate[flat] = filled ? share * scale * flux[k] / grid.cell_volume[flat] : 0.0;
    }
  });
  for_each_seam(grid.layout, [&](int axis) { copy_over_seam(grid.layout, axis, grid.volume_rate); });
}

#define GEODROP_INSTANTIATE(D)                 \
  template void cell_volume_rate<D>(Grid<D>&); \
  template RowForce<D> cell_pressure_force<D>(const Grid<D>&, int, int, const std::array<int, D>&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
