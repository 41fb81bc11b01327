#include "rigid_surface.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "geometry/polygon.hpp"
#include "rigid_motion.hpp"

namespace geodrop {
namespace {

Vec<2> as_vector(const std::array<double, 2>& v) { return Vec<2>(v.data()); }
Vec<2> as_vector(const Point& v) { return Vec<2>(v.data()); }
std::array<double, 2> as_array(const Vec<2>& v) { return {v[0], v[1]}; }

Vec<2> turned_left(const Vec<2>& v) { return {-v[1], v[0]}; }

/// Where a point of the body is that was at x at the start.
Vec<2> moved(const RigidBody<2>& body, const Vec<2>& x) {
  const Vec<2> centre = as_vector(body.centre);
  return centre + Eigen::Rotation2Dd(body.angle) * (x - centre) + as_vector(body.displacement);
}

double distance_to_segment(const Vec<2>& x, const Vec<2>& from, const Vec<2>& to) {
  const Vec<2> d = to - from;
  const double length2 = d.squaredNorm();
  const double share = length2 > 0 ? std::clamp(d.dot(x - from) / length2, 0.0, 1.0) : 0.0;
  return (x - from - share * d).norm();
}

/// From where to where a line is in the domain, as distances from a point of it; 0 and 0 if it is nowhere.
std::pair<double, double> stretch_in_domain(const Vec<2>& point, const Vec<2>& direction, const GridSpec& domain) {
  double first = -std::numeric_limits<double>::infinity(), last = -first;
  for (int a = 0; a < 2; ++a) {
    const double lower = domain.lower[a] - point[a], upper = domain.upper[a] - point[a];
    if (direction[a] == 0 && lower * upper > 0) return {0, 0};
    if (direction[a] == 0) continue;
    first = std::max(first, std::min(lower / direction[a], upper / direction[a]));
    last = std::min(last, std::max(lower / direction[a], upper / direction[a]));
  }
  return first < last ? std::pair{first, last} : std::pair{0.0, 0.0};
}

void set_corners(const RigidShape& shape, RigidBody<2>& body) {
  const auto* line = std::get_if<PolylineShape>(&shape);
  if (line) body.radius = line->radius;
  for (const Point& point : line ? line->points : clockwise_corners(shape))
    body.corners.push_back({point[0], point[1]});
  body.from = body.corners.front();
  body.to = body.corners.back();
}

std::optional<EdgeLine> line_of(const RigidBody<2>& body) {
  if (body.corners.empty()) return std::nullopt;
  std::vector<Vec<2>> corners;
  for (const auto& corner : body.corners) corners.push_back(moved(body, as_vector(corner)));
  return EdgeLine(std::move(corners), body.radius);
}

}  // namespace

std::vector<Point> clockwise_corners(const RigidShape& shape) {
  if (const auto* box = std::get_if<BoxShape>(&shape))
    return {box->lower, {box->lower[0], box->upper[1]}, box->upper, {box->upper[0], box->lower[1]}};
  std::vector<Point> points = std::get<PolygonShape>(shape).points;
  Array<double> x, y;
  for (const Point& point : points) {
    x.push_back(point[0]);
    y.push_back(point[1]);
  }
  if (signed_area(x, y) > 0) std::reverse(points.begin(), points.end());
  return points;
}

RigidBody<2> make_rigid_body(const RigidSpec& spec, const GridSpec& domain) {
  RigidBody<2> body;
  body.name = spec.name;
  body.centre = centre_of<2>(spec.motion);
  if (const auto* half = std::get_if<HalfPlaneShape>(&spec.shape)) {
    body.half_plane = true;
    const Vec<2> normal = as_vector(half->normal).normalized(), point = as_vector(half->point);
    const auto [first, last] = stretch_in_domain(point, turned_left(normal), domain);
    body.normal = as_array(normal);
    body.from = as_array(point + first * turned_left(normal));
    body.to = as_array(point + last * turned_left(normal));
  } else if (const auto* capsule = std::get_if<CapsuleShape>(&spec.shape)) {
    body.from = as_array(as_vector(capsule->from));
    body.to = as_array(as_vector(capsule->to));
    body.radius = capsule->radius;
  } else {
    set_corners(spec.shape, body);
  }
  return body;
}

RigidSurface::RigidSurface(const RigidBody<2>& body)
    : half_plane_(body.half_plane),
      radius_(body.radius),
      from_(moved(body, as_vector(body.from))),
      to_(moved(body, as_vector(body.to))),
      length_((to_ - from_).norm()),
      line_(line_of(body)),
      centre_(as_vector(body.centre) + as_vector(body.displacement)),
      drift_(as_vector(body.velocity)),
      spin_(body.angle_rate) {
  if (half_plane_)
    normal_ = Eigen::Rotation2Dd(body.angle) * as_vector(body.normal);
  else
    normal_ = length_ > 0 ? Vec<2>(turned_left(to_ - from_) / length_) : Vec<2>::Zero();
}

std::optional<RigidSurface::Gap> RigidSurface::gap(const Vec<2>& x, std::int8_t side) const {
  if (line_) return line_->gap(x, side);
  const Vec<2> off = x - from_;
  if (half_plane_) return Gap{normal_.dot(off), normal_, side};
  const double along = length_ > 0 ? (to_ - from_).dot(off) / length_ : 0.0;
  if (along > 0 && along < length_) {
    const double height = normal_.dot(off);
    const std::int8_t now = side != 0 ? side : static_cast<std::int8_t>(height < 0 ? -1 : 1);
    const double size = now * height - radius_;
    if (size < -2 * radius_) return std::nullopt;
    return Gap{size, now * normal_, now};
  }
  const Vec<2> radial = along > 0 ? Vec<2>(x - to_) : off;
  const double distance = radial.norm();
  if (distance == 0) return std::nullopt;
  return Gap{distance - radius_, radial / distance, side};
}

SurfaceTouch RigidSurface::touch(const Vec<2>& x, std::int8_t side, double reach) const {
  if (line_) return line_->touch(x, side, reach);
  const auto only = gap(x, side);
  SurfaceTouch touch;
  if (!only || !(only->size < reach)) return touch;
  touch.gaps[0] = *only;
  touch.count = 1;
  return touch;
}

Vec<2> RigidSurface::velocity(const Vec<2>& x) const { return drift_ + spin_ * turned_left(x - centre_); }

double RigidSurface::speed() const {
  double ends = std::max(velocity(from_).norm(), velocity(to_).norm());
  for (const Vec<2>& corner : corners()) ends = std::max(ends, velocity(corner).norm());
  return ends + std::abs(spin_) * radius_;
}

bool RigidSurface::may_touch(const Vec<2>& lower, const Vec<2>& upper, double reach) const {
  const Vec<2> middle = (lower + upper) / 2, half = (upper - lower) / 2;
  if (half_plane_) return normal_.dot(middle - from_) - normal_.cwiseAbs().dot(half) < reach;
  if (line_) return line_->distance(middle, half.norm() + reach) - half.norm() < reach;
  return distance_to_segment(middle, from_, to_) - half.norm() < radius_ + reach;
}

std::vector<Vec<2>> outline(const RigidBody<2>& body) {
  if (const auto line = line_of(body)) return line->outline();
  const Vec<2> from = moved(body, as_vector(body.from)), to = moved(body, as_vector(body.to));
  if (body.half_plane) return {from, to};
  constexpr int chords = 16;  // of each rounded end
  const double towards = to == from ? 0.0 : std::atan2(to[1] - from[1], to[0] - from[0]);
  std::vector<Vec<2>> points;
  for (int k = 0; k <= 2 * chords + 1; ++k) {
    const int step = k <= chords ? k : k - 1;  // the point between the ends is on both
    const double turn = towards - std::numbers::pi / 2 + std::numbers::pi * step / chords;
    points.push_back((k <= chords ? to : from) + body.radius * Vec<2>(std::cos(turn), std::sin(turn)));
  }
  return points;
}

}  // namespace geodrop
