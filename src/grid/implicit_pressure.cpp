#include "implicit_pressure.hpp"

#include <geodrop/base/error.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "blocks.hpp"
#include "cell_pressure.hpp"
#include "momentum.hpp"
#include "neighbourhood.hpp"

namespace geodrop {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

template <int Dim>
std::vector<int> find_pressed(const Grid<Dim>& grid) {
  std::vector<int> out;
  for (const std::uint32_t block : grid.active_blocks)
    for_each_real_row_of_block(grid.layout, block, [&](int begin, int count, const std::array<int, Dim>&) {
      for (int flat = begin; flat < begin + count; ++flat)
        if (grid.pore_modulus[flat] > 0 && carries_pressure(grid, flat)) out.push_back(flat);
    });
  return out;
}

/// Whether a cell of a row along x is less than two cells from the box around a sharp membrane.
template <int Dim>
bool near_outline(const Grids<Dim>& grids, std::array<int, Dim> cell, int along) {
  constexpr int margin = 1;  // of a box that has one already
  cell[0] += along;
  return std::any_of(grids.begin(), grids.end(), [&](const Grid<Dim>& grid) {
    bool inside = grid.outline.size() > 0;
    for (int a = 0; a < Dim && inside; ++a) {
      const int from_first = cell[a] - grid.outline.first[a];
      inside = from_first >= -margin && from_first < grid.outline.count[a] + margin;
    }
    return inside;
  });
}

/// The system, by rows of E = g W^1/2 and the columns' W^1/2.
struct PoreSystem {
  Matrix E, transposed;
  Eigen::VectorXd compressibility;  ///< V_c^2 / (K_c V_c dt^2)
  Eigen::VectorXd rate;             ///< -g . v

  Eigen::VectorXd times(const Eigen::VectorXd& q) const {
    const Eigen::VectorXd columns = transposed * q;
    return E * columns + compressibility.cwiseProduct(q);
  }
};

/// W^1/2 of each component of each node: what does not move has none [kg^-1/2].
template <int Dim>
Eigen::VectorXd root_lightness(const Grid<Dim>& grid) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(grid.layout.nodes()));
  for_each_active_real_row(grid, [&](int begin, int count, const std::array<int, Dim>&) {
    for (int flat = begin; flat < begin + count; ++flat) {
      if (!(grid.sum[flat][3] > 0)) continue;
      const std::array<bool, Dim> held = held_by_walls(grid.layout, flat);
      for (int a = 0; a < Dim; ++a) out[Dim * flat + a] = held[a] ? 0 : 1 / std::sqrt(grid.sum[flat][3]);
    }
  });
  return out;
}

template <int Dim>
void fill_row(const Grid<Dim>& grid, int flat, const Eigen::VectorXd& root, double dt, int r, PoreSystem& system) {
  const std::array<int, Dim> cell = stored_cell(grid.layout, flat);
  const double share = grid.volume_rate[flat] * face_measure(grid.layout);  // of soften_light_cells
  int at = system.E.outerIndexPtr()[r];
  double flow = 0;
  for_neighbourhood(grid.layout, flat, [&](int node, const std::array<int, Dim>& entry) {
    for (int a = 0; a < Dim; ++a) {
      const double g = share * slope_integral<Dim>(grid, cell, entry, a);
      system.E.innerIndexPtr()[at] = Dim * node + a;
      system.E.valuePtr()[at++] = g * root[Dim * node + a];
      flow += g * grid.velocity[node][a];
    }
  });
  system.compressibility[r] = grid.cell_volume[flat] * grid.cell_volume[flat] / (grid.pore_modulus[flat] * dt * dt);
  system.rate[r] = -flow;
}

template <int Dim>
PoreSystem assemble(const Grid<Dim>& grid, const std::vector<int>& cells, const Eigen::VectorXd& root, double dt) {
  constexpr int width = Dim * (Dim == 2 ? 9 : 27);
  const auto rows = static_cast<int>(cells.size());
  PoreSystem system{Matrix(rows, root.size()), {}, Eigen::VectorXd(rows), Eigen::VectorXd(rows)};
  for (int r = 0; r <= rows; ++r) system.E.outerIndexPtr()[r] = r * width;
  system.E.resizeNonZeros(rows * width);
#pragma omp parallel for schedule(static)
  for (int r = 0; r < rows; ++r) fill_row(grid, cells[r], root, dt, r, system);
  system.transposed = system.E.transpose();
  return system;
}

/// Conjugate gradients with the diagonal as preconditioner.
Eigen::VectorXd solve(const PoreSystem& system) {
  constexpr double tolerance = 1e-6;  // of the residual
  constexpr int most_iterations = 2000;
  Eigen::VectorXd inverse = system.compressibility;
  for (Eigen::Index r = 0; r < inverse.size(); ++r) {
    for (Matrix::InnerIterator entry(system.E, r); entry; ++entry) inverse[r] += entry.value() * entry.value();
    inverse[r] = 1 / inverse[r];
  }
  Eigen::VectorXd q = Eigen::VectorXd::Zero(inverse.size()), residual = system.rate;
  Eigen::VectorXd scaled = inverse.cwiseProduct(residual), way = scaled;
  const double enough = tolerance * tolerance * residual.squaredNorm();
  double descent = residual.dot(scaled);
  for (int k = 0; k < most_iterations; ++k) {
    if (residual.squaredNorm() <= enough) return q;
    const Eigen::VectorXd image = system.times(way);
    const double step = descent / way.dot(image);
    q += step * way;
    residual -= step * image;
    scaled = inverse.cwiseProduct(residual);
    const double next = residual.dot(scaled);
    way = scaled + (next / descent) * way;
    descent = next;
  }
  throw RunError(
      "the implicit pore pressure was not found: conjugate gradients to 1e-6 of the residual took more than 2000 "
      "iterations");
}

/// Whether the next step has to be explicit.
template <int Dim>
bool any_open_pores(const Grids<Dim>& grids, const Grid<Dim>& grid) {
  std::atomic<bool> any = false;
  for_each_active_real_row(grid, [&](int begin, int count, const std::array<int, Dim>& cell) {
    for (int flat = begin; flat < begin + count; ++flat)
      if (grid.pore_modulus[flat] > 0 &&
          (!carries_pressure(grid, flat) || near_outline<Dim>(grids, cell, flat - begin)))
        any = true;
  });
  return any;
}

}  // namespace

template <int Dim>
void press_cells(Grid<Dim>& grid, double dt) {
  const std::vector<int> cells = find_pressed(grid);
  if (cells.empty()) return;
  const Eigen::VectorXd root = root_lightness(grid);
  const PoreSystem system = assemble(grid, cells, root, dt);
  const Eigen::VectorXd change = system.transposed * solve(system);  // of velocities, over W^1/2
  for_each_active_real_row(grid, [&](int begin, int count, const std::array<int, Dim>&) {
    for (int flat = begin; flat < begin + count; ++flat)
      for (int a = 0; a < Dim; ++a) {
        const Eigen::Index column = Dim * static_cast<Eigen::Index>(flat) + a;
        const double v = root[column] * change[column];
        grid.velocity[flat][a] += v;
        if (!grid.velocity_change.empty()) grid.velocity_change[flat][a] += v;
      }
  });
  impose_wall_velocity(grid);
}

template <int Dim>
void press_pores(State<Dim>& state, const Grids<Dim>& grids, Grid<Dim>& grid, double dt) {
  bool open = false;
  const auto for_each_soil = [&](auto&& f) {
    for (Body<Dim>& body : state.bodies)
      if (!body.implicit_pores.empty() && body.field == grid.field) f(body);
  };
  for_each_soil([&](const Body<Dim>& soil) { open = open || soil.implicit_pores.front(); });
  if (!open) press_cells(grid, dt);
  open = any_open_pores(grids, grid);
  for_each_soil([&](Body<Dim>& soil) { soil.implicit_pores.front() = open; });
}

#define GEODROP_INSTANTIATE(D)                    \
  template void press_cells<D>(Grid<D>&, double); \
  template void press_pores<D>(State<D>&, const Grids<D>&, Grid<D>&, double);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
