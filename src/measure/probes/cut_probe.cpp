#include "cut_probe.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

#include "membrane/triangles.hpp"

namespace geodrop {
namespace {

/// Where the plane crosses the boundary of a triangle, with what is behind to the left as seen from outside; a corner
/// on the plane counts as ahead. False if it misses the triangle.
bool crossings(const std::array<Vec<3>, 3>& corner, const std::array<double, 3>& height, std::array<Vec<3>, 2>& ends) {
  bool found = false;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const bool ahead = height[k] >= 0;
    if (ahead == (height[next] >= 0)) continue;
    ends[ahead ? 1 : 0] = corner[k] + height[k] / (height[k] - height[next]) * (corner[next] - corner[k]);
    found = true;
  }
  return found;
}

}  // namespace

Cut cut_membrane(const Membrane<3>& membrane, const Vec<3>& point, const Vec<3>& normal, double width) {
  Cut cut;
  const std::array<Array<double>, 3> force = triangle_forces(membrane);
  for (std::size_t k = 0; k < membrane.nodes(); ++k) {
    const double share = std::clamp(normal.dot(vector_at(membrane.x, k) - point) / width + 0.5, 0.0, 1.0);
    cut.force -= share * vector_at(force, k);
  }
  Vec<3> moment = Vec<3>::Zero();
  for (std::size_t t = 0; t < membrane.triangles.size(); ++t) {
    const std::array<Vec<3>, 3> corner = corners_of(membrane, t);
    std::array<double, 3> height;
    for (int k = 0; k < 3; ++k) height[k] = normal.dot(corner[k] - point);
    std::array<Vec<3>, 2> ends;
    if (!crossings(corner, height, ends)) continue;
    cut.girth += (ends[1] - ends[0]).norm();
    const Vec<3> from = ends[0] - point, to = ends[1] - point;
    const double area = 0.5 * normal.dot(to.cross(from));
    cut.area += area;
    moment += area / 3 * (from + to);
  }
  cut.middle = point + moment / cut.area;
  return cut;
}

}  // namespace geodrop
