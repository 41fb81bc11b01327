#include "implicit_pressure.hpp"

#include <geodrop/base/error.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <atomic>
#include <vector>

#include "blocks.hpp"
#include "cell_pressure.hpp"
#include "momentum.hpp"
#include "neighbourhood.hpp"
#include "node_vectors.hpp"
#include "part_groups.hpp"

namespace geodrop {
namespace {

/// What has one pore pressure: a cell, or the parts of cells beside a sharp interface that share one.
template <int Dim>
struct Pressed {
  using Part = typename std::vector<PartCell<Dim>>::const_iterator;
  int cell;          ///< -1: parts
  Part first, last;  ///< of Grid::part_cells
};

template <int Dim>
std::vector<Pressed<Dim>> find_pressed(const Grid<Dim>& grid) {
  const auto& parts = grid.part_cells;
  std::vector<int> cut;
  for (const PartCell<Dim>& part : parts) cut.push_back(part.flat);
  std::sort(cut.begin(), cut.end());
  std::vector<Pressed<Dim>> out;
  for (const std::uint32_t block : grid.active_blocks)
    for_each_real_row_of_block(grid.layout, block, [&](int begin, int count, const std::array<int, Dim>&) {
      for (int flat = begin; flat < begin + count; ++flat)
        if (grid.pore_modulus[flat] > 0 && carries_pressure(grid, flat) &&
            !std::binary_search(cut.begin(), cut.end(), flat))
          out.push_back({flat, parts.end(), parts.end()});
    });
  for_each_group(parts, [&](auto first, auto last) {
    if (sum_of_group(grid.pore_modulus, first, last) > 0) out.push_back({-1, first, last});
  });
  return out;
}

/// g of a pressure at a node, or of a node at a pressure [m, m2].
template <int Dim>
struct SlopeAt {
  int at;
  std::array<double, Dim> g;
};

/// The g of each row of a matrix.
template <int Dim>
struct SlopesByRow {
  std::vector<std::size_t> begin{0};
  std::vector<SlopeAt<Dim>> entries;

  int rows() const { return static_cast<int>(begin.size()) - 1; }
};

template <int Dim>
void add_slopes_of_cell(const Grid<Dim>& grid, int flat, std::vector<SlopeAt<Dim>>& slopes) {
  const std::array<int, Dim> cell = stored_cell(grid.layout, flat);
  const double share = grid.volume_rate[flat] * face_measure(grid.layout);  // of soften_light_cells
  std::array<std::array<double, 3>, Dim> value, slope;
  for (int a = 0; a < Dim; ++a) {
    value[a] = grid.integrals[a].value[cell[a]];
    slope[a] = grid.integrals[a].slope[cell[a]];
  }
  for_neighbourhood(grid.layout, flat, [&](int node, const std::array<int, Dim>& entry) {
    SlopeAt<Dim> at{node, {}};
    for (int a = 0; a < Dim; ++a) {
      at.g[a] = share;
      for (int b = 0; b < Dim; ++b) at.g[a] *= (a == b ? slope : value)[b][entry[b]];
    }
    slopes.push_back(at);
  });
}

/// With what nodes of small mass hand on, as the volume rates of parts see it (carried_velocity).
template <int Dim>
void add_slopes_of_parts(const Grid<Dim>& grid, const Pressed<Dim>& pressed, std::vector<SlopeAt<Dim>>& slopes) {
  std::vector<NodeVector<Dim>> carried;
  for (auto part = pressed.first; part != pressed.last; ++part) {
    std::size_t n = 0;
    for_neighbourhood(grid.layout, part->flat, [&](int node, const auto&) {
      const std::array<double, Dim>& g = part->slope[n++];
      for_shares_of_impulse<Dim>(grid, node, [&](int to, double share) {
        carried.push_back({to, g});
        for (double& component : carried.back().value) component *= part->share * share;
      });
    });
  }
  add_up_by_node(carried);
  for (const auto& [node, g] : carried) slopes.push_back({node, g});
}

/// Shorter products are not worth waking threads for: one of 2000 rows takes 15 us.
constexpr int rows_worth_threads = 8192;

/// The system for q = dt dp.
template <int Dim>
class PoreSystem {
 public:
  PoreSystem(const Grid<Dim>& grid, double dt) {
    const std::vector<Pressed<Dim>> all = find_pressed(grid);
    compressibility_.resize(static_cast<Eigen::Index>(all.size()));
    of_pressure_.begin.reserve(all.size() + 1);
    of_pressure_.entries.reserve(all.size() * (Dim == 2 ? 9 : 27));
    for (std::size_t r = 0; r < all.size(); ++r) add_row(grid, all[r], dt, compressibility_[r]);
    number_nodes(grid);
    transpose();
  }

  bool empty() const { return of_pressure_.rows() == 0; }

  /// (V_c / (K_c dt^2) + g M^-1 g^T) q.
  Eigen::VectorXd times(const Eigen::VectorXd& q) const {
    const std::vector<std::array<double, Dim>> moved = changes(q);
    Eigen::VectorXd out(q.size());
#pragma omp parallel for schedule(static) if (of_pressure_.rows() >= rows_worth_threads)
    for (int r = 0; r < of_pressure_.rows(); ++r) out[r] = compressibility_[r] * q[r] + flow(r, moved);
    return out;
  }

  Eigen::VectorXd diagonal() const {
    Eigen::VectorXd out = compressibility_;
    for (int r = 0; r < of_pressure_.rows(); ++r)
      for (std::size_t k = of_pressure_.begin[r]; k < of_pressure_.begin[r + 1]; ++k) {
        const auto& [node, g] = of_pressure_.entries[k];
        for (int a = 0; a < Dim; ++a) out[r] += g[a] * g[a] * lightness_[node][a];
      }
    return out;
  }

  /// -g . v.
  Eigen::VectorXd rates(const Grid<Dim>& grid) const {
    std::vector<std::array<double, Dim>> velocity(nodes_.size());
    for (std::size_t n = 0; n < nodes_.size(); ++n)
      for (int a = 0; a < Dim; ++a) velocity[n][a] = grid.velocity[nodes_[n]][a];
    Eigen::VectorXd out(of_pressure_.rows());
    for (int r = 0; r < of_pressure_.rows(); ++r) out[r] = -flow(r, velocity);
    return out;
  }

  /// What q does to the velocities of nodes() [m/s].
  std::vector<std::array<double, Dim>> changes(const Eigen::VectorXd& q) const {
    std::vector<std::array<double, Dim>> out(nodes_.size());
#pragma omp parallel for schedule(static) if (of_node_.rows() >= rows_worth_threads)
    for (int n = 0; n < of_node_.rows(); ++n) {
      std::array<double, Dim> impulse{};
      for (std::size_t k = of_node_.begin[n]; k < of_node_.begin[n + 1]; ++k)
        for (int a = 0; a < Dim; ++a) impulse[a] += of_node_.entries[k].g[a] * q[of_node_.entries[k].at];
      for (int a = 0; a < Dim; ++a) out[n][a] = lightness_[n][a] * impulse[a];
    }
    return out;
  }

  const std::vector<int>& nodes() const { return nodes_; }

 private:
  void add_row(const Grid<Dim>& grid, const Pressed<Dim>& pressed, double dt, double& compressibility) {
    double volume = 0, modulus = 0;
    if (pressed.cell >= 0) {
      add_slopes_of_cell(grid, pressed.cell, of_pressure_.entries);
      volume = grid.cell_volume[pressed.cell];
      modulus = grid.pore_modulus[pressed.cell];
    } else {
      add_slopes_of_parts(grid, pressed, of_pressure_.entries);
      volume = sum_of_group(grid.cell_volume, pressed.first, pressed.last);
      modulus = sum_of_group(grid.pore_modulus, pressed.first, pressed.last);
    }
    of_pressure_.begin.push_back(of_pressure_.entries.size());
    compressibility = volume * volume / (modulus * dt * dt);
  }

  /// Numbers in the place of flat indices; 1 / m of each component, 0 for what does not move [1/kg].
  void number_nodes(const Grid<Dim>& grid) {
    std::vector<int> number(grid.layout.nodes(), -1);
    for (SlopeAt<Dim>& entry : of_pressure_.entries) {
      int& column = number[entry.at];
      if (column < 0) {
        column = static_cast<int>(nodes_.size());
        nodes_.push_back(entry.at);
        const std::array<bool, Dim> held = held_by_walls(grid.layout, entry.at);
        const double mass = grid.sum[entry.at][3];
        lightness_.emplace_back();
        for (int a = 0; a < Dim; ++a) lightness_.back()[a] = held[a] || !(mass > 0) ? 0 : 1 / mass;
      }
      entry.at = column;
    }
  }

  void transpose() {
    of_node_.begin.assign(nodes_.size() + 1, 0);
    for (const SlopeAt<Dim>& entry : of_pressure_.entries) ++of_node_.begin[entry.at + 1];
    for (std::size_t n = 0; n < nodes_.size(); ++n) of_node_.begin[n + 1] += of_node_.begin[n];
    of_node_.entries.resize(of_pressure_.entries.size());
    std::vector<std::size_t> next(of_node_.begin.begin(), of_node_.begin.end() - 1);
    for (int r = 0; r < of_pressure_.rows(); ++r)
      for (std::size_t k = of_pressure_.begin[r]; k < of_pressure_.begin[r + 1]; ++k)
        of_node_.entries[next[of_pressure_.entries[k].at]++] = {r, of_pressure_.entries[k].g};
  }

  double flow(int r, const std::vector<std::array<double, Dim>>& velocity) const {
    double sum = 0;
    for (std::size_t k = of_pressure_.begin[r]; k < of_pressure_.begin[r + 1]; ++k) {
      const auto& [node, g] = of_pressure_.entries[k];
      for (int a = 0; a < Dim; ++a) sum += g[a] * velocity[node][a];
    }
    return sum;
  }

  SlopesByRow<Dim> of_pressure_, of_node_;
  std::vector<int> nodes_;                          ///< flat indices
  std::vector<std::array<double, Dim>> lightness_;  ///< by node
  Eigen::VectorXd compressibility_;                 ///< V_c^2 / (K_c V_c dt^2)
};

/// Conjugate gradients with the diagonal as preconditioner.
template <int Dim>
Eigen::VectorXd solve(const PoreSystem<Dim>& system, const Eigen::VectorXd& rates) {
  constexpr double tolerance = 1e-6;  // of the residual
  constexpr int most_iterations = 2000;
  const Eigen::VectorXd inverse = system.diagonal().cwiseInverse();
  Eigen::VectorXd q = Eigen::VectorXd::Zero(inverse.size()), residual = rates;
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
bool any_open_pores(const Grid<Dim>& grid) {
  std::atomic<bool> any = false;
  for_each_active_real_row(grid, [&](int begin, int count, const std::array<int, Dim>&) {
    for (int flat = begin; flat < begin + count; ++flat)
      if (grid.pore_modulus[flat] > 0 && !carries_pressure(grid, flat)) any = true;
  });
  return any;
}

}  // namespace

template <int Dim>
void press_cells(Grid<Dim>& grid, double dt) {
  const PoreSystem<Dim> system(grid, dt);
  if (system.empty()) return;
  const std::vector<std::array<double, Dim>> changes = system.changes(solve(system, system.rates(grid)));
  for (std::size_t n = 0; n < changes.size(); ++n)
    for (int a = 0; a < Dim; ++a) {
      grid.velocity[system.nodes()[n]][a] += changes[n][a];
      if (!grid.velocity_change.empty()) grid.velocity_change[system.nodes()[n]][a] += changes[n][a];
    }
  impose_wall_velocity(grid);
}

template <int Dim>
void press_pores(State<Dim>& state, Grid<Dim>& grid, double dt) {
  bool open = false;
  const auto for_each_soil = [&](auto&& f) {
    for (Body<Dim>& body : state.bodies)
      if (!body.implicit_pores.empty() && body.field == grid.field) f(body);
  };
  for_each_soil([&](const Body<Dim>& soil) { open = open || soil.implicit_pores.front(); });
  if (!open) press_cells(grid, dt);
  open = any_open_pores(grid);
  for_each_soil([&](Body<Dim>& soil) { soil.implicit_pores.front() = open; });
}

#define GEODROP_INSTANTIATE(D)                    \
  template void press_cells<D>(Grid<D>&, double); \
  template void press_pores<D>(State<D>&, Grid<D>&, double);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
