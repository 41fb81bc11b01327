// T kappa of membranes beside the pressure on them: a balance that no row of the step solves for, so that it can fail.
#include <geodrop/grid/graded_axis.hpp>
#include <geodrop/measure/measure.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "membrane/means_beside.hpp"
#include "membrane/membrane_force.hpp"
#include "membrane_balance.hpp"
#include "tributary_areas.hpp"

namespace geodrop {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Places of the components of a total stress in a symmetric matrix, by rows.
template <int Dim>
constexpr auto places_of_stress() {
  if constexpr (Dim == 2)
    return std::array{0, 3, 3, 1};
  else
    return std::array{0, 3, 5, 3, 1, 4, 5, 4, 2};
}

/// The stress of some bodies at the nodes of a membrane: means of what is beside it, brought there with its weight.
template <int Dim>
class StressBeside {
 public:
  StressBeside(const Scene& scene, const GridLayout<Dim>& layout, const Membrane<Dim>& membrane)
      : layout_(layout), membrane_(membrane), gravity_(scene.gravity.data()) {
    stress_.begin(layout, membrane);
    place_.begin(layout, membrane);
  }

  void add(const Body<Dim>& body) {
    stress_.add(layout_, body, [&](std::size_t p) { return total_stress(body, p); });
    place_.add(layout_, body, [&](std::size_t p) {
      std::array<double, Dim + 1> out;
      for (std::size_t a = 0; a < Dim; ++a) out[a] = body.x[a][p];
      out[Dim] = body.mass[p] / body.volume(p);
      return out;
    });
  }

  bool found(std::size_t k) const { return place_.at(layout_, membrane_, k).volume > 0; }

  /// From the node to the particles that count, along a vector [m].
  double offset(std::size_t k, const Vec<Dim>& along) const {
    const auto sum = place_.at(layout_, membrane_, k);
    return (Vec<Dim>(sum.value.data()) / sum.volume - vector_at(membrane_.x, k)).dot(along);
  }

  /// n . sigma n [Pa], 0 where there is nothing.
  double across(std::size_t k, const Vec<Dim>& n) const {
    if (!found(k)) return 0;
    const auto sum = stress_.at(layout_, membrane_, k);
    double pulled = 0;
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) pulled += sum.value[places_of_stress<Dim>()[Dim * a + b]] * n[a] * n[b];
    const double density = place_.at(layout_, membrane_, k).value[Dim] / sum.volume;
    return pulled / sum.volume + density * offset(k, gravity_);
  }

 private:
  const GridLayout<Dim>& layout_;
  const Membrane<Dim>& membrane_;
  Vec<Dim> gravity_;
  MeansBeside<Dim, stress_components<Dim>> stress_;
  MeansBeside<Dim, Dim + 1> place_;
};

/// The sides of a membrane: its body, and what the grid lets act from around. Solid skeletons and the water in their
/// pores are in one place, so that each has its own mean.
template <int Dim>
class Sides {
 public:
  Sides(const Scene& scene, const State<Dim>& state, const GridLayout<Dim>& layout, const Membrane<Dim>& membrane)
      : inside_(scene, layout, membrane),
        water_inside_(scene, layout, membrane),
        around_(scene, layout, membrane),
        soil_around_(scene, layout, membrane),
        membrane_(membrane) {
    const auto is_inside = [&](const BodySpec& body) { return body.name == membrane.body; };
    const auto own = std::ranges::find_if(scene.bodies, is_inside);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const Body<Dim>& body = state.bodies[b];
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
  bool body_on_side_of(const Vec<Dim>& n, std::size_t k) const { return inside_.found(k) && inside_.offset(k, n) > 0; }

  /// Pressure from inside less that from around [Pa].
  double jump(const TributaryAreas<Dim>& areas, std::size_t k, const Vec<Dim>& n) const {
    const double outside =
        membrane_.sharp ? areas.mean(membrane_.water_pressure, k) : -around_.across(k, n) - soil_around_.across(k, n);
    return -inside_.across(k, n) - water_inside_.across(k, n) - outside;
  }

 private:
  StressBeside<Dim> inside_, water_inside_, around_, soil_around_;
  const Membrane<Dim>& membrane_;
};

/// What acts across the line or surface at each node, and how much of it belongs to that [N/m, N].
template <int Dim>
struct NodeLoads {
  TributaryAreas<Dim> areas;
  std::vector<double> curvature, pressure;
};

template <int Dim>
NodeLoads<Dim> loads_of(const Scene& scene, const State<Dim>& state, const Membrane<Dim>& membrane) {
  const GridLayout<Dim> layout(scene.grid, scene.walls);
  const Sides<Dim> sides(scene, state, layout, membrane);
  const auto pull = membrane_forces(membrane);
  const Vec<Dim> gravity(scene.gravity.data());
  NodeLoads<Dim> loads{TributaryAreas<Dim>(membrane), {}, {}};
  for (std::size_t k = 0; k < membrane.nodes(); ++k) {
    Vec<Dim> n = loads.areas.normal(k);
    if (!membrane.closed && sides.body_on_side_of(n, k)) n = -n;
    const double size = loads.areas.size(k);
    double pressure = 0;
    if (size > 0) {
      pressure = sides.jump(loads.areas, k, n) * size + membrane.mass[k] * gravity.dot(n);
      if (!membrane.load[0].empty()) pressure += vector_at(membrane.load, k).dot(n);
    }
    loads.curvature.push_back(size > 0 ? -vector_at(pull, k).dot(n) : 0);
    loads.pressure.push_back(pressure);
  }
  return loads;
}

/// A cloth that bends by less than this over the stretch presses nowhere [rad].
constexpr double least_bend = 0.05;

/// Means over what of the line or surface is about a node.
template <int Dim>
AcrossLine mean_about(std::size_t k, const NodeLoads<Dim>& loads, const Scene& scene, const Membrane<Dim>& membrane) {
  const double width = std::max(membrane.gauge_length, 2 * finest_spacing(scene.grid));
  double tension = loads.areas.largest(membrane.tension, k), size = 0;
  if constexpr (Dim == 3) tension = std::max(tension, loads.areas.largest(membrane.triangles.cross_tension, k));
  AcrossLine mean;
  for (const std::size_t node : loads.areas.about(k, width)) {
    size += loads.areas.size(node);
    mean.curvature += loads.curvature[node];
    mean.pressure += loads.pressure[node];
  }
  if (!(size > 0)) return {0, 0, nan};
  mean.curvature /= size;
  mean.pressure /= size;
  const double length = Dim == 2 ? size : std::sqrt(size);
  const double scale = std::max({std::abs(mean.curvature), std::abs(mean.pressure), least_bend * tension / length});
  mean.error = tension > 0 ? std::abs(mean.curvature - mean.pressure) / scale : nan;
  return mean;
}

}  // namespace

template <int Dim>
std::vector<AcrossLine> balance_across(const Scene& scene, const State<Dim>& state, const Membrane<Dim>& membrane) {
  const NodeLoads<Dim> loads = loads_of(scene, state, membrane);
  std::vector<AcrossLine> balance;
  for (std::size_t k = 0; k < membrane.nodes(); ++k) balance.push_back(mean_about(k, loads, scene, membrane));
  return balance;
}

template <int Dim>
AcrossLine balance_at_gauge(const Scene& scene, const State<Dim>& state, const Membrane<Dim>& membrane) {
  if (!(membrane.gauge.now > 0)) return {0, 0, nan};
  const Vec<Dim> at(membrane.gauge.now_at.data());
  std::vector<std::size_t> nodes(membrane.nodes());
  std::iota(nodes.begin(), nodes.end(), 0);
  const auto nearest =
      std::ranges::min_element(nodes, {}, [&](std::size_t k) { return (vector_at(membrane.x, k) - at).norm(); });
  return mean_about(*nearest, loads_of(scene, state, membrane), scene, membrane);
}

#define GEODROP_INSTANTIATE(D)                                                                           \
  template std::vector<AcrossLine> balance_across<D>(const Scene&, const State<D>&, const Membrane<D>&); \
  template AcrossLine balance_at_gauge<D>(const Scene&, const State<D>&, const Membrane<D>&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
