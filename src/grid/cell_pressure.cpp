#include "cell_pressure.hpp"

#include "blocks.hpp"

namespace geodrop {
namespace {

/// Calls f(flat neighbour, offsets a in {0,1,2}^Dim) for the 3^Dim neighbourhood.
template <int Dim, class F>
void for_neighbourhood(const GridLayout<Dim>& layout, int flat, F&& f) {
  std::array<int, Dim> a{};
  for (int z = 0; z < (Dim == 3 ? 3 : 1); ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) {
        a[0] = x;
        a[1] = y;
        int other = flat + (x - 1) + (y - 1) * layout.stride[1];
        if constexpr (Dim == 3) {
          a[2] = z;
          other += (z - 1) * layout.stride[2];
        }
        f(other, a);
      }
}

template <int Dim>
double cell_width_product(const Grid<Dim>& grid, const std::array<int, Dim>& cell) {
  double product = 1;
  for (int a = 0; a < Dim; ++a) product *= grid.integrals[a].width[cell[a]];
  return product;
}

template <int Dim>
double cell_measure(const GridLayout<Dim>& layout) {
  return Dim == 2 ? layout.h * layout.h : layout.h * layout.h * layout.h;
}

/// Along a wall the neighbour beyond it is the mirror image.
template <int Dim>
int mirrored(const GridLayout<Dim>& layout, const std::array<int, Dim>& cell, const std::array<int, Dim>& a) {
  int flat = 0;
  for (int axis = 0; axis < Dim; ++axis) {
    int c = cell[axis] - GridLayout<Dim>::pad + a[axis] - 1;
    if (c < 0) c = -c;
    if (c > layout.cells[axis]) c = 2 * layout.cells[axis] - c;
    flat += (c + GridLayout<Dim>::pad) * layout.stride[axis];
  }
  return flat;
}

/// cell_fill := V / V_c, not yet smoothed.
template <int Dim>
void raw_fill(const State<Dim>& state, Grid<Dim>& grid, Array<double>& fill) {
  const double inv_measure = 1 / cell_measure(grid.layout);
  for_each_active_real_row(state, grid.layout, [&](int begin, int count, std::array<int, Dim> cell) {
    for (int k = 0; k < count; ++k, ++cell[0])
      fill[begin + k] = grid.cell_volume[begin + k] * inv_measure / cell_width_product<Dim>(grid, cell);
  });
}

template <int Dim>
double smoothed_fill(const GridLayout<Dim>& layout, const Array<double>& fill, const std::array<int, Dim>& cell,
                     int flat) {
  constexpr double binomial[3] = {0.25, 0.5, 0.25};
  bool interior = true;
  for (int a = 0; a < Dim; ++a)
    interior = interior && cell[a] > GridLayout<Dim>::pad && cell[a] < layout.cells[a] + GridLayout<Dim>::pad;
  double sum = 0;
  for_neighbourhood(layout, flat, [&](int other, const std::array<int, Dim>& a) {
    double weight = 1;
    for (int axis = 0; axis < Dim; ++axis) weight *= binomial[a[axis]];
    sum += weight * fill[interior ? other : mirrored<Dim>(layout, cell, a)];
  });
  return sum;
}

/// Cells near a membrane do not shift: a shifted particle could slip through it.
template <int Dim>
void block_shift_near_membranes(const State<Dim>& state, Grid<Dim>& grid) {
  for (const Membrane<Dim>& membrane : state.membranes)
    for (std::size_t k = 0; k < membrane.nodes(); ++k) {
      std::array<int, Dim> base;
      for (int a = 0; a < Dim; ++a) base[a] = grid.layout.base(a, membrane.x[a][k]);
      for_neighbourhood(grid.layout, grid.layout.index(base), [&](int other, const auto&) {
        grid.cell_flags[other] &= static_cast<std::uint8_t>(~cell_shiftable);
      });
    }
}

/// A cell is shiftable where its whole neighbourhood is filled.
template <int Dim>
void mark_shiftable(const State<Dim>& state, Grid<Dim>& grid) {
  for_each_active_real_row(state, grid.layout, [&](int begin, int count, std::array<int, Dim> cell) {
    for (int k = 0; k < count; ++k, ++cell[0]) {
      bool full = true;
      for_neighbourhood(grid.layout, begin + k, [&](int, const std::array<int, Dim>& a) {
        full = full && (grid.cell_flags[mirrored<Dim>(grid.layout, cell, a)] & cell_filled);
      });
      if (full) grid.cell_flags[begin + k] |= cell_shiftable;
    }
  });
  block_shift_near_membranes(state, grid);
}

}  // namespace

template <int Dim>
void average_cell_pressure(const State<Dim>& state, Grid<Dim>& grid, bool shift) {
  Array<double>& fill = grid.volume_rate;  // free until the volume rate is computed
  raw_fill(state, grid, fill);
  for_each_active_real_row(state, grid.layout, [&](int begin, int count, std::array<int, Dim> cell) {
    for (int k = 0; k < count; ++k, ++cell[0]) {
      const int flat = begin + k;
      const double smooth = smoothed_fill<Dim>(grid.layout, fill, cell, flat);
      const bool filled = smooth >= filled_ratio && grid.cell_volume[flat] > 0;
      grid.cell_flags[flat] = filled ? cell_filled : 0;
      grid.cell_pressure[flat] = filled ? grid.cell_pressure[flat] / grid.cell_volume[flat] : 0.0;
    }
  });
  if (shift) mark_shiftable(state, grid);
}

template <int Dim>
std::array<double, Dim> cell_pressure_force(const Grid<Dim>& grid, const std::array<int, Dim>& node, int flat) {
  std::array<double, Dim> force{};
  for_neighbourhood(grid.layout, flat, [&](int cell, const std::array<int, Dim>& a) {
    const double pressure = grid.cell_pressure[cell];
    // The cell at offset a - 1 from the node sees this node at offset 1 - a, i.e. as its entry 2 - a.
    for (int component = 0; component < Dim; ++component) {
      double integral = 1;
      for (int axis = 0; axis < Dim; ++axis) {
        const auto& table = grid.integrals[axis];
        const int c = node[axis] + a[axis] - 1;
        integral *= axis == component ? table.slope[c][2 - a[axis]] : table.value[c][2 - a[axis]];
      }
      force[component] += pressure * integral;
    }
  });
  const double scale = Dim == 2 ? grid.layout.h : grid.layout.h * grid.layout.h;
  for (double& f : force) f *= scale;
  return force;
}

template <int Dim>
void cell_volume_rate(const State<Dim>& state, Grid<Dim>& grid) {
  for_each_active_real_row(state, grid.layout, [&](int begin, int count, std::array<int, Dim> cell) {
    for (int k = 0; k < count; ++k, ++cell[0]) {
      const int flat = begin + k;
      if (!(grid.cell_flags[flat] & cell_filled)) {
        grid.volume_rate[flat] = 0;
        continue;
      }
      double rate = 0;
      for_neighbourhood(grid.layout, flat, [&](int node, const std::array<int, Dim>& a) {
        for (int component = 0; component < Dim; ++component) {
          double integral = 1;
          for (int axis = 0; axis < Dim; ++axis) {
            const auto& table = grid.integrals[axis];
            integral *= axis == component ? table.slope[cell[axis]][a[axis]] : table.value[cell[axis]][a[axis]];
          }
          rate += grid.velocity[node][component] * integral;
        }
      });
      grid.volume_rate[flat] = rate * grid.layout.h / grid.cell_volume[flat];
    }
  });
}

#define GEODROP_INSTANTIATE(D)                                             \
  template void average_cell_pressure<D>(const State<D>&, Grid<D>&, bool); \
  template void cell_volume_rate<D>(const State<D>&, Grid<D>&);            \
  template std::array<double, D> cell_pressure_force<D>(const Grid<D>&, const std::array<int, D>&, int);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
