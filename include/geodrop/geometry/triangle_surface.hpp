// Triangulated surfaces in space, closed or up to planes at which they end: what a membrane is drawn as, and what a
// body inside it fills.
#pragma once

#include <geodrop/geometry/shape.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace geodrop {

using Corner = std::array<double, 3>;  ///< [m]

/// Corners and triangles, the latter anticlockwise as seen from outside.
struct TriangleSurface {
  std::vector<Corner> points;  ///< as drawn [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Corner> unstretched;  ///< of each point where the cloth was cut out flat [m]; empty: as drawn
};

/// A plane across an axis at which a surface ends: what lies beyond it is left out.
struct SurfaceEnd {
  int axis = 0;
  bool upper = false;  ///< it ends upwards along the axis
  double place = 0;    ///< coordinate of the plane [m]
};

/// 0, 1 for the lower and upper wall across x, 2, 3 across y, 4, 5 across z.
inline std::uint32_t wall_number(int axis, bool upper) {
  return static_cast<std::uint32_t>(2 * axis + (upper ? 1 : 0));
}

/// From point to point.
using SurfaceEdge = std::array<std::uint32_t, 2>;

/// Signed, of what is enclosed [m3]: positive if the triangles face outwards.
double volume(const TriangleSurface& surface);

/// As drawn [m2].
double area(const TriangleSurface& surface);

/// What is wrong with a surface that should be closed and face outwards, "" if nothing is: a corner that is not there,
/// a triangle without area, an edge that has no neighbour, two neighbours that face opposite ways, inside out.
/// Triangles are counted from 1.
std::string fault_of(const TriangleSurface& surface);

/// A closed surface that is asked for places and volumes. Each triangle is sorted into columns along x.
class SurfaceRegion {
 public:
  explicit SurfaceRegion(TriangleSurface surface);

  const TriangleSurface& surface() const { return surface_; }
  const Corner& lower() const { return lower_; }  ///< of the box around it [m]
  const Corner& upper() const { return upper_; }

  bool contains(const Corner& x) const;

  /// Whether a box may be cut by the surface; if it is not, it is inside or outside as a whole.
  bool may_cut(const Corner& lower, const Corner& upper) const;

  /// Volume of the part of a box that lies inside [m3], and its first moments [m4]: exact, by the divergence theorem
  /// over triangles that are clipped to the column of the box along x. No predicate decides anything.
  struct Moments {
    double volume = 0;
    Corner first{};
  };
  Moments moments_in(const Corner& lower, const Corner& upper) const;

 private:
  /// Columns that an interval across x meets.
  struct Columns {
    std::array<int, 2> first, last;
  };
  Columns columns_of(double y_low, double y_high, double z_low, double z_high) const;
  template <class Visit>
  void for_each_near(const Columns& columns, Visit&& visit) const;
  std::size_t column_at(int y, int z) const {
    return static_cast<std::size_t>(z) * static_cast<std::size_t>(count_[0]) + static_cast<std::size_t>(y);
  }
  Corner corner(std::uint32_t triangle, int k) const { return surface_.points[surface_.triangles[triangle][k]]; }

  TriangleSurface surface_;
  Corner lower_{}, upper_{};
  std::array<int, 2> count_{};     ///< of columns along y and z
  std::array<double, 2> width_{};  ///< [m]
  std::vector<std::vector<std::uint32_t>> columns_;
};

}  // namespace geodrop
