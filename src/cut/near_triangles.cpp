#include "near_triangles.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "clipped_cells.hpp"
#include "geometry/triangle.hpp"
#include "membrane/triangles.hpp"

namespace geodrop {

NearTriangles::NearTriangles(const GridLayout<3>& layout, const Membrane<3>& membrane, const ClippedSurface& cells)
    : layout_(layout), membrane_(membrane), cells_(cells), plates_(cells.pieces.size()), parts_(cells.size()) {
  const auto n = static_cast<std::ptrdiff_t>(plates_.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    Plate& plate = plates_[k];
    plate.triangle = cells.pieces[k].triangle;
    plate.normal = normal_of(membrane, plate.triangle).normalized();
    plate.middle = middle_of(membrane, plate.triangle);
    plate.radius = 0;
    for (const Vec<3>& corner : corners_of(membrane, plate.triangle))
      plate.radius = std::max(plate.radius, (corner - plate.middle).norm());
  }
  for (const ClippedSurface::Flank& flank : cells.flanks) {
    auto& [one, other] = parts_[flank.cell];
    (one.second == 0 ? one : other) = {flank.first_piece, flank.first_piece + flank.pieces};
  }
}

/// Of triangles that meet in the nearest point, the one that x is most before or behind tells the side.
void NearTriangles::look_at(const Plate& plate, const Vec<3>& x, Nearest& nearest) const {
  constexpr double alike = 1e-9;  // of distances to one point
  const double height = plate.normal.dot(x - plate.middle), farthest = (1 + alike) * nearest.distance;
  if (std::abs(height) > farthest) return;
  // Along the plane the triangle ends within its radius.
  const double square = (x - plate.middle).squaredNorm() - height * height;
  const double beyond = std::sqrt(std::max(0.0, square)) - plate.radius;
  if (beyond > 0 && height * height + beyond * beyond > farthest * farthest) return;
  const Vec<3> point = nearest_point(corners_of(membrane_, plate.triangle), x);
  const double distance = (x - point).norm();
  if (distance > farthest) return;
  if (distance >= (1 - alike) * nearest.distance && std::abs(height) <= std::abs(nearest.height)) return;
  nearest = {distance, height, point, plate.normal, plate.triangle};
}

std::optional<RightSide<3>> NearTriangles::on_side(const Vec<3>& x, bool inside) const {
  constexpr double distance = 1e-3;  // from the membrane [h]
  const int own = local_cell(layout_, cells_, x);
  if (own < 0) return {};
  const bool cut = parts_[own][0].second > 0;
  if (!cut && (cells_.inside[own] > 0.5) == inside) return {};  // a whole cell of its side
  Nearest nearest;
  std::array<double, 3> low, width;  // of x over the lower side of its cell, and of that [m]
  for (int a = 0; a < 3; ++a) {
    const int place = layout_.base(a, x[a]);
    width[a] = layout_.span_width(a, place) * layout_.h;
    low[a] = x[a] - layout_.node(a, place) + 0.5 * width[a];
  }
  const std::array<int, 3> stride{1, cells_.count[0], cells_.count[0] * cells_.count[1]};
  const std::array<int, 3> at{own % stride[1], own / stride[1] % cells_.count[1], own / stride[2]};
  for (const int n :
       {13, 12, 14, 10, 16, 4, 22, 0, 1, 2, 3, 5, 6, 7, 8, 9, 11, 15, 17, 18, 19, 20, 21, 23, 24, 25, 26}) {
    const std::array<int, 3> offset{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
    double square = 0;  // to the cell there
    int cell = own;
    bool in_box = true;
    for (std::size_t a = 0; a < 3; ++a) {
      const double gap = offset[a] < 0 ? low[a] : offset[a] > 0 ? width[a] - low[a] : 0.0;
      square += gap * gap;
      cell += offset[a] * stride[a];
      in_box = in_box && at[a] + offset[a] >= 0 && at[a] + offset[a] < cells_.count[a];
    }
    if (!in_box || square > nearest.distance * nearest.distance) continue;
    for (const auto& [first, last] : parts_[cell])
      for (std::uint32_t k = first; k < last; ++k) look_at(plates_[k], x, nearest);
  }
  if (!std::isfinite(nearest.distance) || (nearest.height < 0) == inside) return {};
  const auto& corner = membrane_.triangles.corner;
  const std::uint32_t t = nearest.triangle;
  return RightSide<3>{nearest.point + (inside ? -1 : 1) * distance * layout_.finest * nearest.normal,
                      {corner[0][t], corner[1][t], corner[2][t]},
                      corner_shares(corners_of(membrane_, t), nearest.point)};
}

}  // namespace geodrop
