#include "span_probe.hpp"

#include <geodrop/base/find_named.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "membrane/membrane_nodes.hpp"

namespace geodrop {
namespace {

std::size_t nearest_node(const std::vector<Point>& nodes, const Point& place) {
  const auto distance = [&](const Point& x) { return std::hypot(x[0] - place[0], x[1] - place[1]); };
  const auto nearest = std::min_element(nodes.begin(), nodes.end(),
                                        [&](const Point& a, const Point& b) { return distance(a) < distance(b); });
  return static_cast<std::size_t>(nearest - nodes.begin());
}

/// Segments from one node on to another.
struct Segments {
  std::size_t first, count;
};

double unstretched_length(const Membrane<2>& membrane, const Segments& part) {
  double sum = 0;
  for (std::size_t k = 0; k < part.count; ++k) sum += membrane.rest_length[(part.first + k) % membrane.segments()];
  return sum;
}

Segments segments_between(const Membrane<2>& membrane, std::size_t a, std::size_t b) {
  if (!membrane.closed) return {std::min(a, b), std::max(a, b) - std::min(a, b)};
  const std::size_t n = membrane.segments();
  const Segments ahead{a, (b + n - a) % n}, back{b, (a + n - b) % n};
  return unstretched_length(membrane, ahead) <= unstretched_length(membrane, back) ? ahead : back;
}

}  // namespace

SpanTension span_tension(const Scene& scene, const SpanProbeSpec& probe, const State<2>& state) {
  const std::vector<Point> drawn = membrane_nodes(scene, find_named(scene.membranes, probe.membrane));
  const Membrane<2>& membrane = find_named(state.membranes, probe.membrane);
  const Segments part = segments_between(membrane, nearest_node(drawn, probe.from), nearest_node(drawn, probe.to));
  SpanTension tension;
  double weighted = 0;
  for (std::size_t k = 0; k < part.count; ++k) {
    const std::size_t s = (part.first + k) % membrane.segments();
    weighted += membrane.rest_length[s] * membrane.tension[s];
    tension.max = std::max(tension.max, membrane.tension[s]);
  }
  const double length = unstretched_length(membrane, part);
  tension.mean = length > 0 ? weighted / length : 0.0;
  return tension;
}

}  // namespace geodrop
