#include "edge_line.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace geodrop {
namespace {

Vec<2> left_of(const Vec<2>& v) { return {-v[1], v[0]}; }

/// Shares of two faces, of which the first is the deeper one.
std::pair<double, double> shares(double depth, double less, double cosine) {
  constexpr double parallel = 1 - 1e-9;
  const double c = std::max(0.0, cosine);
  if (c > parallel || less <= c * depth) return {1, 0};
  return {(1 - c * less / depth) / (1 - c * c), (1 - c * depth / less) / (1 - c * c)};
}

}  // namespace

EdgeLine::EdgeLine(std::vector<Vec<2>> corners, double half_thickness)
    : corners_(std::move(corners)), half_thickness_(half_thickness), lower_(corners_.at(0)), upper_(corners_.at(0)) {
  for (std::size_t k = 0; k < edges(); ++k) {
    const Vec<2> way = end_of(k) - corners_[k];
    length_.push_back(way.norm());
    direction_.push_back(way / length_.back());
  }
  for (const Vec<2>& corner : corners_) {
    lower_ = lower_.cwiseMin(corner);
    upper_ = upper_.cwiseMax(corner);
  }
}

std::optional<EdgeLine::Face> EdgeLine::beside(std::size_t edge, const Vec<2>& x) const {
  const Vec<2> off = x - corners_[edge];
  const double along = direction_[edge].dot(off);
  if (!(along >= 0 && along <= length_[edge])) return std::nullopt;
  const Vec<2> left = left_of(direction_[edge]);
  const double height = left.dot(off);
  return Face{std::abs(height), left, height < 0 ? -1 : 1, static_cast<std::uint32_t>(edge)};
}

EdgeLine::Face EdgeLine::at_corner(std::size_t corner, const Vec<2>& x) const {
  const std::size_t n = corners_.size(), before = corner == 0 ? n - 1 : corner - 1;
  const Vec<2> off = x - corners_[corner];
  const double distance = off.norm();
  const auto piece = static_cast<std::uint32_t>(edges() + corner);
  if (!closed() && (corner == 0 || corner + 1 == n))
    return {distance, distance > 0 ? Vec<2>(off / distance) : Vec<2>::Zero(), 0, piece};
  const Vec<2> mean = left_of(direction_[before] + direction_[corner]);
  const int sign = mean.dot(off) < 0 ? -1 : 1;
  return {distance, distance > 0 ? Vec<2>(sign / distance * off) : mean.normalized(), sign, piece};
}

/// Whether no edge is beside the point where both end.
bool EdgeLine::in_cone(std::size_t corner, const Vec<2>& x) const {
  const std::size_t n = corners_.size(), before = corner == 0 ? n - 1 : corner - 1;
  const Vec<2> off = x - corners_[corner];
  const bool has_before = closed() || corner > 0, has_after = closed() || corner + 1 < n;
  return (!has_before || direction_[before].dot(off) > 0) && (!has_after || direction_[corner].dot(off) < 0);
}

std::optional<EdgeLine::Face> EdgeLine::nearest(const Vec<2>& x) const {
  std::optional<Face> found;
  const auto look = [&](const Face& face) {
    if (!found || face.distance < found->distance) found = face;
  };
  for (std::size_t k = 0; k < edges(); ++k)
    if (const auto face = beside(k, x)) look(*face);
  for (std::size_t k = 0; k < corners_.size(); ++k) look(at_corner(k, x));
  if (found->left.isZero()) return std::nullopt;  // on an end: no direction
  return found;
}

SurfaceGap EdgeLine::gap_to(const Face& face, int side) const {
  const int front = face.sign == 0 ? 1 : side * face.sign;
  const Vec<2> normal = face.sign == 0 ? face.left : Vec<2>(side * face.left);
  const bool known = !closed() && face.sign != 0;
  return {front * face.distance - half_thickness_, normal, static_cast<std::int8_t>(known ? side : 0), face.piece, 1};
}

std::optional<SurfaceGap> EdgeLine::gap(const Vec<2>& x, std::int8_t side) const {
  const auto face = nearest(x);
  if (!face) return std::nullopt;
  const SurfaceGap gap = gap_to(*face, closed() ? 1 : side != 0 ? side : face->sign);
  if (!closed() && gap.size < -2 * half_thickness_) return std::nullopt;
  return gap;
}

SurfaceTouch EdgeLine::touch(const Vec<2>& x, std::int8_t side, double reach) const {
  const auto first = gap(x, side);
  SurfaceTouch touch;
  if (!first || !(first->size < reach)) return touch;
  touch.gaps[0] = *first;
  touch.count = 1;
  const auto look = [&](const Face& face) {
    const int on = closed() ? 1 : first->side != 0 ? first->side : face.sign;
    if (face.piece == first->piece || (face.sign != 0 && face.sign != on)) return;
    const SurfaceGap gap = gap_to(face, on);
    if (!(gap.size < reach) || (touch.count == 2 && !(gap.size < touch.gaps[1].size))) return;
    touch.gaps[1] = gap;
    touch.count = 2;
  };
  for (std::size_t k = 0; k < edges(); ++k)
    if (const auto face = beside(k, x)) look(*face);
  for (std::size_t k = 0; k < corners_.size(); ++k)
    if (in_cone(k, x)) look(at_corner(k, x));
  if (touch.count < 2) return touch;
  auto& [deep, less] = touch.gaps;
  std::tie(deep.share, less.share) = shares(reach - deep.size, reach - less.size, deep.normal.dot(less.normal));
  if (less.share == 0)
    touch.count = 1;
  else if (less.piece < deep.piece)
    std::swap(deep, less);
  return touch;
}

double EdgeLine::distance(const Vec<2>& x, double far) const {
  const double to_box = (lower_ - x).cwiseMax(x - upper_).cwiseMax(0.0).norm() - half_thickness_;
  if (to_box > far) return to_box;
  const auto face = nearest(x);
  if (!face || (closed() && face->sign < 0)) return 0;
  return std::max(0.0, face->distance - half_thickness_);
}

std::vector<Vec<2>> EdgeLine::outline() const {
  if (closed()) return corners_;
  constexpr double most_pointed = 3;  // half thicknesses
  std::vector<Vec<2>> points;
  for (const int side : {1, -1})
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const std::size_t k = side > 0 ? i : corners_.size() - 1 - i;
      const Vec<2>& before = direction_[k == 0 ? 0 : k - 1];
      const Vec<2>& after = direction_[k + 1 == corners_.size() ? k - 1 : k];
      const Vec<2> mean = left_of(before + after).normalized();
      const double pointed = std::min(most_pointed, 1 / std::max(1e-3, mean.dot(left_of(after))));
      const int end = k == 0 ? -1 : k + 1 == corners_.size() ? 1 : 0;
      points.push_back(corners_[k] + half_thickness_ * (side * pointed * mean + end * after));
    }
  return points;
}

}  // namespace geodrop
