#include "section_probe.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/grid/grid.hpp>
#include <geodrop/measure/measure.hpp>

#include <cmath>

#include "base/fixed_order_sum.hpp"
#include "geometry/polygon.hpp"
#include "grid/point_support.hpp"

namespace geodrop {
namespace {

/// Share of the nodes right of a section in the shape functions at a point, and its slope.
struct RightShare {
  double value, slope;  ///< [-], [1/m]
};

class UprightSection {
 public:
  UprightSection(const GridLayout<2>& layout, double position) : layout_(layout), position_(position) {}

  RightShare at(double x, double half_size) const {
    const auto [base, n] = support_along(layout_, 0, x, half_size);
    const double per_metre = layout_.graded() ? 1.0 : layout_.inv_h;
    const double below = right_of(base - 1), here = right_of(base), above = right_of(base + 1);
    return {below * n.w0 + here * n.w1 + above * n.w2, per_metre * (below * n.g0 + here * n.g1 + above * n.g2)};
  }

 private:
  double right_of(int node) const {
    const double offset = layout_.node(0, node) - position_;
    constexpr double round_off = 1e-9;  // [h]
    if (std::abs(offset) < round_off * layout_.h) return 0.5;
    return offset > 0 ? 1.0 : 0.0;
  }

  const GridLayout<2>& layout_;
  double position_;
};

double membrane_force(const UprightSection& section, const Membrane<2>& membrane) {
  double sum = 0;
  for (std::size_t s = 0; s < membrane.segments(); ++s) {
    const std::size_t end = end_of_edge(s, membrane.nodes());
    const Vec<2> d = vector_at(membrane.x, end) - vector_at(membrane.x, s);
    const double length = d.norm();
    if (length <= 0) continue;
    const auto share = [&](std::size_t k) { return section.at(membrane.x[0][k], membrane.half_size).value; };
    sum += membrane.tension[s] * d[0] / length * (share(end) - share(s));
  }
  return sum;
}

}  // namespace

SectionForces section_forces(const Scene& scene, const SectionProbeSpec& probe, const State<2>& state) {
  const GridLayout<2> layout(scene.grid, scene.walls);
  const UprightSection section(layout, probe.position);
  const Body<2>& body = find_named(state.bodies, probe.body);
  SectionForces forces;
  forces.soil = -fixed_order_sum<double>(body.size(), [&](double& sum, std::size_t p) {
    sum += body.volume(p) * total_stress(body, p)[0] * section.at(body.x[0][p], body.half_size).slope;
  });
  for (const Membrane<2>& membrane : state.membranes)
    if (membrane.body == body.name) forces.membrane += membrane_force(section, membrane);
  return forces;
}

}  // namespace geodrop
