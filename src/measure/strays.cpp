#include "strays.hpp"

#include <geodrop/measure/measure.hpp>

#include <algorithm>
#include <limits>

#include "base/fixed_order_sum.hpp"
#include "geometry/polygon.hpp"
#include "geometry/polygon_edge.hpp"

namespace geodrop {

namespace {

double distance_from(const Membrane<2>& membrane, const Vec<2>& x) {
  const auto& [mx, my] = membrane.x;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < membrane.nodes(); ++k) {
    const std::size_t end = end_of_edge(k, membrane.nodes());
    least = std::min(least, distance_to(PolygonEdge{mx[k], my[k], mx[end], my[end]}, {x[0], x[1]}));
  }
  return least;
}

bool is_inside(const Membrane<2>& membrane, const Vec<2>& x) {
  return winding_number(membrane.x[0], membrane.x[1], x) != 0;
}

}  // namespace

double strays_inside(const State<2>& state, const Membrane<2>& membrane, const std::string& pore_water, double skin) {
  const MembraneMeasures<2> around = measure(membrane);
  double volume = 0;
  for (const Body<2>& body : state.bodies) {
    if (body.name == membrane.body || body.name == pore_water || body.field == waiting) continue;
    volume += fixed_order_sum<double>(body.size(), [&](double& sum, std::size_t p) {
      const Vec<2> x = vector_at(body.x, p);
      const bool in_box = (x.array() > around.lower.array()).all() && (x.array() < around.upper.array()).all();
      if (!in_box || !is_inside(membrane, x) || distance_from(membrane, x) < skin) return;
      const bool in_overlap = std::any_of(state.membranes.begin(), state.membranes.end(), [&](const auto& other) {
        return &other != &membrane && other.closed && is_inside(other, x);
      });
      if (!in_overlap) sum += body.volume(p);
    });
  }
  return volume;
}

}  // namespace geodrop
