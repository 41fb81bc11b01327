#include "anchors.hpp"

#include <geodrop/base/find_named.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "grid/momentum.hpp"
#include "grid/neighbourhood.hpp"
#include "grid/point_support.hpp"
#include "grid/seams.hpp"

namespace geodrop {
namespace {

/// Whether walls leave it free.
template <int Dim>
bool is_free(const GridLayout<Dim>& layout, int flat) {
  const std::array<int, Dim> node = stored_cell(layout, flat);
  for (int a = 0; a < Dim; ++a) {
    const int i = node[a] - GridLayout<Dim>::pad;
    if (!layout.periodic(a) && (i <= 0 || i >= layout.cells[a])) return false;
  }
  return true;
}

/// An anchor in this step: how its node answers to an impulse.
template <int Dim>
class Hold {
 public:
  Hold(Anchor<Dim>& anchor, const Membrane<Dim>& membrane, const Grid<Dim>& grid)
      : anchor_(anchor), support_(grid.layout, place_at(membrane.x, anchor.node), membrane.half_size) {
    const Vec<Dim> way = Vec<Dim>(anchor.to.data()) - vector_at(membrane.x, anchor.node);
    distance_ = way.norm();
    way_ = way;
    double weights = 0;
    support_.for_each_node(grid.layout, [&](int node, double weight) {
      const double mass = grid.sum[node][3];
      if (weight == 0 || !(mass > 0) || !is_free(grid.layout, node)) return;
      const double carried = weight / std::max(mass, light_mass<Dim>(grid, stored_cell(grid.layout, node)));
      nodes_.emplace_back(node_of_seam(grid.layout, node), carried);
      weights += carried * mass;
      answer_ += carried * weight;
    });
    if (weights > 0) answer_ /= weights;
    for (auto& [node, share] : nodes_) share /= weights;
  }

  /// The change of its impulse [N s].
  Vec<Dim> missing(const Grid<Dim>& grid, double dt) {
    if (nodes_.empty()) return Vec<Dim>::Zero();
    const Vec<Dim> v = velocity(grid);
    if (!anchor_.line) return (way_ / dt - v) / answer_;
    if (distance_ == 0) return Vec<Dim>::Zero();
    const Vec<Dim> towards = way_ / distance_;
    anchor_.stretch = distance_ - anchor_.length - dt * towards.dot(v);
    const double beyond = anchor_.stretch + dt * dt * answer_ * tension_;  // of the line if it bore nothing
    const double tension = std::max(0.0, beyond / (anchor_.compliance + dt * dt * answer_));
    Vec<Dim> change = dt * (tension - tension_) * towards;
    tension_ = tension;
    return change;
  }

  /// The impulse that makes its node move as its force has let it, in velocities that were mapped anew.
  Vec<Dim> astray(const Grid<Dim>& grid, double dt) const {
    if (nodes_.empty()) return Vec<Dim>::Zero();
    const Vec<Dim> v = velocity(grid);
    if (!anchor_.line) return (way_ / dt - v) / answer_;
    if (distance_ == 0 || Vec<Dim>(anchor_.force.data()).isZero(0)) return Vec<Dim>::Zero();
    const Vec<Dim> towards = way_ / distance_;
    const double speed = (distance_ - anchor_.length - anchor_.stretch) / dt;
    return (speed - towards.dot(v)) / answer_ * towards;
  }

  void add(const Vec<Dim>& impulse, Grid<Dim>& grid) {
    impulse_ += impulse;
    Vec4 push{};
    for (int a = 0; a < Dim; ++a) push[a] = impulse[a];
    for (const auto& [node, share] : nodes_) {
      grid.velocity[node] += share * push;
      if (!grid.velocity_change.empty()) grid.velocity_change[node] += share * push;
    }
  }

  /// Change of its own velocity by an impulse [m/s].
  double speed(const Vec<Dim>& impulse) const { return answer_ * impulse.norm(); }

  void keep_force(double dt) {
    for (int a = 0; a < Dim; ++a) anchor_.force[a] = impulse_[a] / dt;
  }

 private:
  Vec<Dim> velocity(const Grid<Dim>& grid) const {
    const Vec4 v4 = interpolate(grid.layout, support_, grid.velocity);
    Vec<Dim> v;
    for (int a = 0; a < Dim; ++a) v[a] = v4[a];
    return v;
  }

  Anchor<Dim>& anchor_;
  PointSupport<Dim> support_;
  Vec<Dim> way_ = Vec<Dim>::Zero();  ///< to where it is held, or to the end of the line [m]
  double distance_ = 0;
  double answer_ = 0;  ///< of its velocity to an impulse [1/kg]
  double tension_ = 0;
  Vec<Dim> impulse_ = Vec<Dim>::Zero();
  std::vector<std::pair<int, double>> nodes_;  ///< and the change of their velocity for an impulse [1/kg]
};

template <int Dim>
std::vector<Hold<Dim>> holds_on(State<Dim>& state, const Grid<Dim>& grid) {
  std::vector<Hold<Dim>> holds;
  for (Anchor<Dim>& anchor : state.anchors) {
    const Membrane<Dim>& membrane = find_named(state.membranes, anchor.membrane);
    if (membrane.field == grid.field && !membrane.sharp) holds.emplace_back(anchor, membrane, grid);
  }
  return holds;
}

/// Adds the impulses f(hold), one after the other, until none changes.
template <int Dim, class F>
void sweep(std::vector<Hold<Dim>>& holds, Grid<Dim>& grid, double dt, F impulse_of) {
  constexpr int most_sweeps = 100;
  constexpr double enough = 1e-12;  // of a cell in a step
  double largest = 0;
  for (int sweep = 0; sweep < most_sweeps && !holds.empty(); ++sweep) {
    largest = 0;
    for (Hold<Dim>& hold : holds) {
      const Vec<Dim> impulse = impulse_of(hold);
      largest = std::max(largest, hold.speed(impulse));
      hold.add(impulse, grid);
    }
    impose_wall_velocity(grid);
    if (largest * dt <= enough * grid.layout.h) break;
  }
}

}  // namespace

template <int Dim>
Anchor<Dim> make_anchor(const AnchorSpec& spec, const State<Dim>& state) {
  const Membrane<Dim>& membrane = find_named(state.membranes, spec.membrane);
  Anchor<Dim> anchor;
  anchor.name = spec.name;
  anchor.membrane = spec.membrane;
  const Vec<Dim> at(spec.point.data());
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t k = 0; k < membrane.nodes(); ++k)
    if (const double distance = (vector_at(membrane.x, k) - at).squaredNorm(); distance < nearest) {
      nearest = distance;
      anchor.node = k;
    }
  anchor.to = place_at(membrane.x, anchor.node);
  if (const auto* line = std::get_if<AnchorLineSpec>(&spec.by)) {
    anchor.line = true;
    std::copy_n(line->to.begin(), Dim, anchor.to.begin());
    anchor.compliance = 1 / line->stiffness;
    anchor.length = line->length;
  }
  return anchor;
}

template <int Dim>
void hold_anchors(State<Dim>& state, Grid<Dim>& grid, double dt) {
  std::vector<Hold<Dim>> holds = holds_on(state, grid);
  sweep(holds, grid, dt, [&](Hold<Dim>& hold) { return hold.missing(grid, dt); });
  for (Hold<Dim>& hold : holds) hold.keep_force(dt);
}

template <int Dim>
void hold_remapped(State<Dim>& state, Grid<Dim>& grid, double dt) {
  std::vector<Hold<Dim>> holds = holds_on(state, grid);
  sweep(holds, grid, dt, [&](const Hold<Dim>& hold) { return hold.astray(grid, dt); });
}

#define GEODROP_INSTANTIATE(D)                                           \
  template Anchor<D> make_anchor<D>(const AnchorSpec&, const State<D>&); \
  template void hold_anchors<D>(State<D>&, Grid<D>&, double);            \
  template void hold_remapped<D>(State<D>&, Grid<D>&, double);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
