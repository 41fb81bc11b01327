#include "implicit_pressure.hpp"

#include <geodrop/base/error.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <optional>
#include <vector>

#include "base/levels.hpp"
#include "blocks.hpp"
#include "cell_pressure.hpp"
#include "cell_slopes.hpp"
#include "momentum.hpp"
#include "neighbourhood.hpp"
#include "node_vectors.hpp"
#include "part_groups.hpp"

namespace geodrop {
namespace {

/// What `acts` of a row of a block, from the first to the last; nothing if none does.
template <int Dim>
std::optional<RowAt<Dim>> acting_part(int begin, int count, std::array<int, Dim> first, auto&& acts) {
  while (count > 0 && !acts(begin + count - 1)) --count;
  for (; count > 0 && !acts(begin); ++begin, ++first[0]) --count;
  if (count == 0) return {};
  return RowAt<Dim>{begin, count, first};
}

/// A row of cells that have a pore pressure each.
template <int Dim>
struct PressedCells {
  RowAt<Dim> at;
  int unknown;         ///< of the first of them
  CellRow<Dim> share;  ///< of soften_light_cells, times the measure of g; 0: a cell without a pore pressure
};

/// The g of parts of cells beside a sharp interface that share a pressure, where shares_of(node, f) has impulses go.
template <int Dim>
std::vector<NodeVector<Dim>> slopes_of_parts(const Grid<Dim>& grid, auto&& shares_of, auto first, auto last) {
  std::vector<NodeVector<Dim>> carried;
  for (auto part = first; part != last; ++part) {
    std::size_t n = 0;
    for_neighbourhood(grid.layout, part->flat, [&](int node, const auto&) {
      const std::array<double, Dim>& g = part->slope[n++];
      shares_of(node, [&](int to, double share) {
        carried.push_back({to, g});
        for (double& component : carried.back().value) component *= part->share * share;
      });
    });
  }
  add_up_by_node(carried);
  return carried;
}

template <int Dim>
auto components_of(const NodeVectors<Dim>& v) {
  return [&v](int component, int node) { return v[component][node]; };
}

/// Smaller systems are not worth waking threads for: a product with 2000 pressures takes 5 us.
constexpr int pressures_worth_threads = 20000;

/// The system for q = dt dp: of cells, row by row, then of parts of cells.
template <int Dim>
class PoreSystem {
  using Columns = IntegralColumns<Dim>;
  using Slopes = CellSlopes<Dim, Columns>;
  static Slopes columns_of(const Grid<Dim>& grid, typename Columns::Of of) { return {grid.layout, Columns(grid, of)}; }

 public:
  PoreSystem(const Grid<Dim>& grid, double dt, Medium<Dim>* medium)
      : slopes_(columns_of(grid, Columns::Of::integrals)), medium_(medium) {
    std::vector<double> compressibility;
    const auto stores = [&](double volume, double modulus) { return volume * volume / (modulus * dt * dt); };
    find_cells(grid, stores, compressibility);
    // As the volume rates of parts see what nodes of small mass hand on (carried_velocity); a medium does that itself.
    const auto shares_of = [&](int node, auto&& f) {
      if (medium_)
        f(node, 1.0);
      else
        for_shares_of_impulse<Dim>(grid, node, f);
    };
    for_each_group(grid.part_cells, [&](auto first, auto last) {
      const double modulus = sum_of_group(grid.pore_modulus, first, last);
      if (!(modulus > 0)) return;
      parts_.push_back(slopes_of_parts(grid, shares_of, first, last));
      compressibility.push_back(stores(sum_of_group(grid.cell_volume, first, last), modulus));
    });
    compressibility_ = Eigen::Map<Eigen::VectorXd>(compressibility.data(), std::ssize(compressibility));
    if (empty()) return;
    find_nodes(grid);
    find_diagonal(grid);
    if (medium_) leave_to_medium();
  }

  bool empty() const { return compressibility_.size() == 0; }
  const Eigen::VectorXd& diagonal() const { return diagonal_; }

  /// (V_c / (K_c dt^2) + g M^-1 g^T) q.
  Eigen::VectorXd times(const Eigen::VectorXd& q) {
    find_changes(q);
    return compressibility_.cwiseProduct(q) + flows();
  }

  /// -g . v.
  Eigen::VectorXd rates(const Grid<Dim>& grid) {
    if (medium_)
      medium_->velocities(velocity_);
    else
      for_each_node([&](int node) {
        for (int a = 0; a < Dim; ++a) velocity_[a][node] = grid.velocity[node][a];
      });
    return -flows();
  }

  /// Adds what q does to the velocities of nodes.
  void move_nodes(const Eigen::VectorXd& q, Grid<Dim>& grid) {
    find_changes(q);
    if (medium_) return medium_->move();
    for_each_node([&](int node) {
      for (int a = 0; a < Dim; ++a) {
        grid.velocity[node][a] += velocity_[a][node];
        if (!grid.velocity_change.empty()) grid.velocity_change[node][a] += velocity_[a][node];
      }
    });
  }

 private:
  /// Cells that parts take have no pressure of their own.
  void find_cells(const Grid<Dim>& grid, auto&& stores, std::vector<double>& compressibility) {
    std::vector<bool> cut(grid.layout.nodes(), false);
    for (const PartCell<Dim>& part : grid.part_cells) cut[part.flat] = true;
    const auto acts = [&](int flat) {
      return grid.pore_modulus[flat] > 0 && carries_pressure(grid, flat) && !cut[flat];
    };
    for (const std::uint32_t block : grid.active_blocks)
      for_each_real_row_of_block(grid.layout, block, [&](int begin, int count, const std::array<int, Dim>& first) {
        const auto at = acting_part<Dim>(begin, count, first, acts);
        if (!at) return;
        cells_.push_back({*at, static_cast<int>(compressibility.size()), {}});
        for (int k = 0; k < at->count; ++k) {
          const int flat = at->begin + k;
          if (acts(flat)) cells_.back().share[k] = grid.volume_rate[flat] * face_measure(grid.layout);
          compressibility.push_back(acts(flat) ? stores(grid.cell_volume[flat], grid.pore_modulus[flat]) : 1.0);
        }
      });
  }

  /// Nodes that a pressure moves, and 1 / m of each component, 0 for what does not move [1/kg]; of a medium, about.
  void find_nodes(const Grid<Dim>& grid) {
    std::vector<bool> moves(grid.layout.nodes(), false);
    for (const auto& [at, unknown, share] : cells_)
      for_rows_around<Dim>(grid.layout, [&, begin = at.begin - 1, count = at.count + 2](int offset, int, int) {
        std::fill_n(moves.begin() + begin + offset, count, true);
      });
    for (const auto& part : parts_)
      for (const auto& [node, g] : part) moves[node] = true;
    if (medium_) medium_->begin(moves);
    for (auto* vectors : {&velocity_, &lightness_, &by_parts_})
      for (std::vector<double>& component : *vectors) component.assign(grid.layout.nodes(), 0.0);
    pressure_.assign(grid.layout.nodes(), 0.0);
    for (const std::uint32_t block : grid.active_blocks)
      for_each_real_row_of_block(grid.layout, block, [&](int begin, int count, const std::array<int, Dim>& first) {
        if (const auto at = acting_part<Dim>(begin, count, first, [&](int node) { return moves[node]; }))
          nodes_.push_back(*at);
      });
    for_each_node([&](int node) {
      const std::array<bool, Dim> held = held_by_walls(grid.layout, node);
      const double mass = grid.sum[node][3], lightness = medium_ ? medium_->lightness(node) : mass > 0 ? 1 / mass : 0;
      for (int a = 0; a < Dim; ++a) lightness_[a][node] = held[a] ? 0 : lightness;
    });
  }

  void find_diagonal(const Grid<Dim>& grid) {
    const Slopes squares = columns_of(grid, Columns::Of::squares);
    diagonal_ = compressibility_;
    for (const auto& [at, unknown, share] : cells_) {
      const CellRow<Dim> moved = squares.flow(at, components_of<Dim>(lightness_));
      for (int k = 0; k < at.count; ++k) diagonal_[unknown + k] += share[k] * share[k] * moved[k];
    }
    for (std::size_t r = 0; r < parts_.size(); ++r)
      for (const auto& [node, g] : parts_[r])
        for (int a = 0; a < Dim; ++a) diagonal_[first_part() + r] += g[a] * g[a] * lightness_[a][node];
  }

  /// A medium takes impulses, where it has mass and is not held.
  void leave_to_medium() {
    for_each_node([&](int node) {
      for (std::vector<double>& component : lightness_) component[node] = component[node] > 0 ? 1 : 0;
    });
  }

  /// velocity_: what q does to nodes [m/s].
  void find_changes(const Eigen::VectorXd& q) {
    for (const auto& [at, unknown, share] : cells_)
      for (int k = 0; k < at.count; ++k) pressure_[at.begin + k] = share[k] * q[unknown + k];
    for (const auto& part : parts_)
      for (const auto& [node, g] : part)
        for (int a = 0; a < Dim; ++a) by_parts_[a][node] = 0;
    for (std::size_t r = 0; r < parts_.size(); ++r)
      for (const auto& [node, g] : parts_[r])
        for (int a = 0; a < Dim; ++a) by_parts_[a][node] += g[a] * q[first_part() + r];
    const auto rows = std::ssize(nodes_);
#pragma omp parallel for schedule(static) if (q.size() >= pressures_worth_threads)
    for (std::ptrdiff_t r = 0; r < rows; ++r)
      with_level([&](auto) {
        const RowAt<Dim>& at = nodes_[r];
        const RowForce<Dim> impulse = slopes_.force(at, pressure_);
        for (int a = 0; a < Dim; ++a)
          for (int k = 0; k < at.count; ++k)
            velocity_[a][at.begin + k] = lightness_[a][at.begin + k] * (impulse[a][k] + by_parts_[a][at.begin + k]);
      });
    if (medium_) medium_->respond(velocity_);
  }

  /// g . velocity_.
  Eigen::VectorXd flows() const {
    Eigen::VectorXd out(compressibility_.size());
    const auto rows = std::ssize(cells_);
#pragma omp parallel for schedule(static) if (out.size() >= pressures_worth_threads)
    for (std::ptrdiff_t r = 0; r < rows; ++r)
      with_level([&](auto) {
        const auto& [at, unknown, share] = cells_[r];
        const CellRow<Dim> flow = slopes_.flow(at, components_of<Dim>(velocity_));
        for (int k = 0; k < at.count; ++k) out[unknown + k] = share[k] * flow[k];
      });
    for (std::size_t r = 0; r < parts_.size(); ++r) {
      double sum = 0;
      for (const auto& [node, g] : parts_[r])
        for (int a = 0; a < Dim; ++a) sum += g[a] * velocity_[a][node];
      out[first_part() + r] = sum;
    }
    return out;
  }

  Eigen::Index first_part() const { return compressibility_.size() - std::ssize(parts_); }

  void for_each_node(auto&& f) const {
    for (const RowAt<Dim>& at : nodes_)
      for (int node = at.begin; node < at.begin + at.count; ++node) f(node);
  }

  Slopes slopes_;
  Medium<Dim>* medium_;  ///< null: the field of the grid
  std::vector<PressedCells<Dim>> cells_;
  std::vector<std::vector<NodeVector<Dim>>> parts_;
  std::vector<RowAt<Dim>> nodes_;
  Eigen::VectorXd compressibility_, diagonal_;  ///< V_c^2 / (K_c V_c dt^2)
  NodeVectors<Dim> lightness_;                  ///< 1 / m
  NodeVectors<Dim> velocity_, by_parts_;        // of the product that is being computed
  std::vector<double> pressure_;                // the same
};

/// Conjugate gradients with the diagonal as preconditioner.
template <int Dim>
Eigen::VectorXd solve(PoreSystem<Dim>& system, const Eigen::VectorXd& rates) {
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
void press_cells(Grid<Dim>& grid, double dt, Medium<Dim>* medium) {
  PoreSystem<Dim> system(grid, dt, medium);
  if (system.empty()) return;
  system.move_nodes(solve(system, system.rates(grid)), grid);
  impose_wall_velocity(grid);
}

template <int Dim>
void press_pores(State<Dim>& state, Grid<Dim>& grid, double dt, Medium<Dim>* medium) {
  bool open = false;
  const auto for_each_soil = [&](auto&& f) {
    for (Body<Dim>& body : state.bodies)
      if (!body.implicit_pores.empty() && body.field == grid.field) f(body);
  };
  for_each_soil([&](const Body<Dim>& soil) { open = open || soil.implicit_pores.front(); });
  if (!open) press_cells(grid, dt, medium);
  open = any_open_pores(grid);
  for_each_soil([&](Body<Dim>& soil) { soil.implicit_pores.front() = open; });
}

#define GEODROP_INSTANTIATE(D)                                \
  template void press_cells<D>(Grid<D>&, double, Medium<D>*); \
  template void press_pores<D>(State<D>&, Grid<D>&, double, Medium<D>*);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
