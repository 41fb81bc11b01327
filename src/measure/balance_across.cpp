// T kappa of membranes beside the pressure on them: a balance that no row of the step solves for, so that it can fail.
#include <geodrop/grid/graded_axis.hpp>
#include <geodrop/measure/measure.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "membrane/fluid_load.hpp"
#include "membrane/means_beside.hpp"
#include "membrane/outline.hpp"
#include "membrane_balance.hpp"

namespace geodrop {
namespace {

using Vector = std::array<double, 2>;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1]; }

/// The stress of some bodies at the nodes of a membrane: means of what is beside it, brought there with its weight.
class StressBeside {
 public:
  StressBeside(const Scene& scene, const GridLayout<2>& layout, const Membrane<2>& membrane)
      : layout_(layout), membrane_(membrane), gravity_{scene.gravity[0], scene.gravity[1]} {
    stress_.begin(layout, membrane);
    place_.begin(layout, membrane);
  }

  void add(const Body<2>& body) {
    stress_.add(layout_, body, [&](std::size_t p) {
      const auto stress = total_stress(body, p);
      return std::array<double, 3>{stress[0], stress[1], stress[3]};
    });
    place_.add(layout_, body, [&](std::size_t p) {
      return std::array<double, 3>{body.x[0][p], body.x[1][p], body.mass[p] / body.volume(p)};
    });
  }

  bool found(std::size_t k) const { return stress_.at(layout_, membrane_, k).volume > 0; }

  /// From the node to the particles that count, along a vector [m].
  double offset(std::size_t k, const Vector& along) const {
    const MeansBeside::Sums sum = place_.at(layout_, membrane_, k);
    return dot({sum.value[0] / sum.volume - membrane_.x[0][k], sum.value[1] / sum.volume - membrane_.x[1][k]}, along);
  }

  /// n . sigma n [Pa], 0 where there is nothing.
  double across(std::size_t k, const Vector& n) const {
    if (!found(k)) return 0;
    const MeansBeside::Sums sum = stress_.at(layout_, membrane_, k);
    const double pulled = sum.value[0] * n[0] * n[0] + sum.value[1] * n[1] * n[1] + 2 * sum.value[2] * n[0] * n[1];
    const double density = place_.at(layout_, membrane_, k).value[2] / sum.volume;
    return pulled / sum.volume + density * offset(k, gravity_);
  }

 private:
  const GridLayout<2>& layout_;
  const Membrane<2>& membrane_;
  Vector gravity_;
  MeansBeside stress_, place_;
};

/// The sides of a membrane: its body, and what the grid lets act from around. Solid skeletons and the water in their
/// pores are in one place, so that each has its own mean.
class Sides {
 public:
  Sides(const Scene& scene, const State<2>& state, const GridLayout<2>& layout, const Membrane<2>& membrane)
      : inside_(scene, layout, membrane),
        water_inside_(scene, layout, membrane),
        around_(scene, layout, membrane),
        soil_around_(scene, layout, membrane),
        membrane_(membrane) {
    const auto is_inside = [&](const BodySpec& body) { return body.name == membrane.body; };
    const auto own = std::ranges::find_if(scene.bodies, is_inside);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const Body<2>& body = state.bodies[b];
      if (body.field == waiting || body.pressure == PressureSupport::enclosed) continue;
      if (is_inside(scene.bodies[b]))
        inside_.add(body);
      else if (membrane.sharp && body.name == own->saturated_by)
        water_inside_.add(body);
      else if (!membrane.sharp && body.field == membrane.field)
        (scene.bodies[b].saturated_by.empty() ? around_ : soil_around_).add(body);
    }
  }

  /// Across an open line its body tells the side; where there is none of it, the left one is outside.
  bool body_on_side_of(const Vector& n, std::size_t k) const { return inside_.found(k) && inside_.offset(k, n) > 0; }

  /// Pressure from inside less that from around [Pa].
  double jump(std::size_t k, const Vector& n) const {
    double outside = -around_.across(k, n) - soil_around_.across(k, n);
    if (membrane_.sharp)
      outside = 0.5 * (membrane_.water_pressure[k] + membrane_.water_pressure[node_before(membrane_, k)]);
    return -inside_.across(k, n) - water_inside_.across(k, n) - outside;
  }

 private:
  StressBeside inside_, water_inside_, around_, soil_around_;
  const Membrane<2>& membrane_;
};

/// What acts across the line at each node, times the length of line that belongs to it, per metre of depth [N/m].
struct NodeLoads {
  std::vector<double> length, curvature, pressure;
};

/// Force of the segments beside a node [N/m].
Vector pull(const Membrane<2>& membrane, std::size_t k) {
  Vector force{};
  for (const std::size_t s : {k, node_before(membrane, k)}) {
    if (s >= membrane.segments() || (s == node_before(membrane, k) && s == k)) continue;
    const std::size_t end = end_of_edge(s, membrane.nodes());
    const double share = (s == k ? 1 : -1) * membrane.tension[s] / segment_length(membrane, s);
    for (int a = 0; a < 2; ++a) force[a] += share * (membrane.x[a][end] - membrane.x[a][s]);
  }
  return force;
}

NodeLoads loads_of(const Scene& scene, const State<2>& state, const Membrane<2>& membrane) {
  const GridLayout<2> layout(scene.grid, scene.walls);
  const Sides sides(scene, state, layout, membrane);
  const double sense = membrane.closed ? sense_of(membrane) : 1;
  NodeLoads loads;
  for (std::size_t k = 0; k < membrane.nodes(); ++k) {
    const std::size_t behind = node_before(membrane, k);
    const bool end = !membrane.closed && (k == 0 || k == membrane.segments());
    const auto [tx, ty] = tangent_at(membrane, k);
    Vector n{sense * ty, -sense * tx};
    if (!membrane.closed && sides.body_on_side_of(n, k)) n = {-n[0], -n[1]};
    const double length = end ? 0 : 0.5 * (segment_length(membrane, k) + segment_length(membrane, behind));
    const Vector weight{membrane.mass[k] * scene.gravity[0], membrane.mass[k] * scene.gravity[1]};
    double pressure = length > 0 ? sides.jump(k, n) * length + dot(weight, n) : 0;
    if (length > 0 && !membrane.load[0].empty()) pressure += dot({membrane.load[0][k], membrane.load[1][k]}, n);
    loads.length.push_back(length);
    loads.curvature.push_back(end ? 0 : -dot(pull(membrane, k), n));
    loads.pressure.push_back(pressure);
  }
  return loads;
}

/// Nodes from `k` on, to both sides, until half the width has passed.
std::vector<std::size_t> stretch_about(const Membrane<2>& membrane, const NodeLoads& loads, std::size_t k,
                                       double width) {
  std::vector<std::size_t> nodes{k};
  for (const auto& next : {node_before, node_after}) {
    double way = loads.length[k] / 2;
    for (std::size_t at = next(membrane, k); way < width / 2 && at != k; at = next(membrane, at)) {
      if (at == next(membrane, at) || nodes.size() > membrane.nodes() / 2) break;  // an end, or round
      nodes.push_back(at);
      way += loads.length[at];
    }
  }
  return nodes;
}

/// A cloth that bends by less than this over the stretch presses nowhere [rad].
constexpr double least_bend = 0.05;

AcrossLine mean_over(const std::vector<std::size_t>& nodes, const NodeLoads& loads, double tension) {
  double length = 0;
  AcrossLine mean;
  for (const std::size_t k : nodes) {
    length += loads.length[k];
    mean.curvature += loads.curvature[k];
    mean.pressure += loads.pressure[k];
  }
  if (!(length > 0)) return {0, 0, nan};
  mean.curvature /= length;
  mean.pressure /= length;
  const double scale = std::max({std::abs(mean.curvature), std::abs(mean.pressure), least_bend * tension / length});
  mean.error = tension > 0 ? std::abs(mean.curvature - mean.pressure) / scale : nan;
  return mean;
}

double tension_at(const Membrane<2>& membrane, std::size_t k) {
  return std::max(membrane.tension[std::min(k, membrane.segments() - 1)], membrane.tension[node_before(membrane, k)]);
}

}  // namespace

std::vector<AcrossLine> balance_across(const Scene& scene, const State<2>& state, const Membrane<2>& membrane) {
  const NodeLoads loads = loads_of(scene, state, membrane);
  const double width = std::max(membrane.gauge_length, 2 * finest_spacing(scene.grid));
  std::vector<AcrossLine> balance;
  for (std::size_t k = 0; k < membrane.nodes(); ++k)
    balance.push_back(mean_over(stretch_about(membrane, loads, k, width), loads, tension_at(membrane, k)));
  return balance;
}

AcrossLine balance_at_gauge(const Scene& scene, const State<2>& state, const Membrane<2>& membrane) {
  if (!(membrane.gauge.now > 0)) return {0, 0, nan};
  const auto& at = membrane.gauge.now_at;
  std::vector<std::size_t> nodes(membrane.nodes());
  std::iota(nodes.begin(), nodes.end(), 0);
  const auto nearest = std::ranges::min_element(
      nodes, {}, [&](std::size_t k) { return std::hypot(membrane.x[0][k] - at[0], membrane.x[1][k] - at[1]); });
  const NodeLoads loads = loads_of(scene, state, membrane);
  const double width = std::max(membrane.gauge_length, 2 * finest_spacing(scene.grid));
  return mean_over(stretch_about(membrane, loads, *nearest, width), loads, tension_at(membrane, *nearest));
}

}  // namespace geodrop
