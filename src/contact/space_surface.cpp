#include "space_surface.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "rigid_motion.hpp"

namespace geodrop {
namespace {

std::array<double, 2> across_x(const std::array<double, 3>& v) { return {v[1], v[2]}; }

/// Seen from +x.
RigidBody<2> section_of(const RigidBody<3>& body) {
  RigidBody<2> section;
  for (const auto& corner : body.corners) section.corners.push_back(across_x(corner));
  section.from = section.corners.front();
  section.to = section.corners.back();
  section.centre = across_x(body.centre);
  section.angle = body.angle;
  section.displacement = across_x(body.displacement);
  section.angle_rate = body.angle_rate;
  section.velocity = across_x(body.velocity);
  return section;
}

/// Section of a box or prism at the start, as a shape of the plane of y and z.
RigidShape section_of(const RigidShape& shape) {
  if (const auto* box = std::get_if<BoxShape>(&shape))
    return BoxShape{{box->lower[1], box->lower[2]}, {box->upper[1], box->upper[2]}};
  return section_of(std::get<PrismShape>(shape));
}

/// Least and largest x of a box or prism at the start [m].
std::pair<double, double> ends_of(const RigidShape& shape) {
  if (const auto* box = std::get_if<BoxShape>(&shape)) return {box->lower[0], box->upper[0]};
  const auto& prism = std::get<PrismShape>(shape);
  return {prism.points.front()[0], prism.points.front()[0] + prism.length};
}

}  // namespace

PolygonShape section_of(const PrismShape& prism) {
  PolygonShape section;
  for (const Point& point : prism.points) section.points.push_back({point[1], point[2]});
  return section;
}

RigidBody<3> make_rigid_body(const RigidSpec& spec) {
  RigidBody<3> body;
  body.name = spec.name;
  body.centre = centre_of<3>(spec.motion);
  if (const auto* half = std::get_if<HalfPlaneShape>(&spec.shape)) {
    body.half_plane = true;
    const Vec<3> normal = Vec<3>(half->normal.data()).normalized();
    for (int a = 0; a < 3; ++a) {
      body.from[a] = body.to[a] = half->point[a];
      body.normal[a] = normal[a];
    }
    return body;
  }
  std::tie(body.from[0], body.to[0]) = ends_of(spec.shape);
  for (const Point& point : clockwise_corners(section_of(spec.shape)))
    body.corners.push_back({body.from[0], point[0], point[1]});
  return body;
}

SpaceSurface::SpaceSurface(const RigidBody<3>& body)
    : point_(body.from.data()),
      normal_(body.normal.data()),
      drift_(body.velocity.data()),
      least_x_(body.from[0] + body.displacement[0]),
      largest_x_(body.to[0] + body.displacement[0]) {
  point_ += Vec<3>(body.displacement.data());
  if (!body.half_plane) section_.emplace(section_of(body));
}

std::optional<SpaceDepth> SpaceSurface::depth(const Vec<3>& x) const {
  if (!section_) {
    const double size = -normal_.dot(x - point_);
    return size > 0 ? std::optional(SpaceDepth{size, normal_}) : std::nullopt;
  }
  const double to_least = x[0] - least_x_, to_largest = largest_x_ - x[0], to_end = std::min(to_least, to_largest);
  if (!(to_end > 0)) return std::nullopt;
  const auto across = section_->gap(Vec<2>(x[1], x[2]), 0);
  if (!across || !(across->size < 0)) return std::nullopt;
  if (to_end < -across->size) return SpaceDepth{to_end, Vec<3>(to_least < to_largest ? -1 : 1, 0, 0)};
  return SpaceDepth{-across->size, Vec<3>(0, across->normal[0], across->normal[1])};
}

Vec<3> SpaceSurface::velocity(const Vec<3>& x) const {
  if (!section_) return drift_;
  const Vec<2> across = section_->velocity(Vec<2>(x[1], x[2]));
  return {drift_[0], across[0], across[1]};
}

double SpaceSurface::speed() const { return section_ ? std::hypot(drift_[0], section_->speed()) : drift_.norm(); }

std::vector<Vec<3>> corners(const RigidBody<3>& body) {
  if (body.half_plane) return {};
  std::vector<Vec<3>> points;
  for (const double x : {body.from[0], body.to[0]})
    for (const Vec<2>& corner : RigidSurface(section_of(body)).corners())
      points.emplace_back(x + body.displacement[0], corner[0], corner[1]);
  return points;
}

}  // namespace geodrop
