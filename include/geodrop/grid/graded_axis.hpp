// Axes with cells of unlike width: where their grid lines are, and the quadratic splines on their knots.
//
//   s(x)  = min(spacing, fine + ln(growth) distance of x to the zone)          wanted width of a cell
//   xi(x) = c int dx / s(x)                                                    grid coordinate, c >= 1: whole cells
//
//   node     0         1        2      3     4    5    walls at xi = 0 and xi = cells
//   wall     |----+----|---+----|--+---|--+--|-+--|    knots + at xi = i + 1/2, mirrored beyond the walls
//
// A node is the middle of its knot span (the Greville abscissa of its spline), so that positions as coefficients give
// the position itself; the wall node thus lies on the wall.
#pragma once

#include <algorithm>
#include <cstdint>
#include <geodrop/base/types.hpp>
#include <geodrop/scene/numerics.hpp>

namespace geodrop {

/// The grid coordinate along one axis, in closed form.
class AxisMap {
 public:
  AxisMap(const GridSpec& grid, int axis);

  bool graded() const { return graded_; }
  int cells() const { return cells_; }
  double wanted_cells() const { return wanted_; }  ///< before rounding; cells() holds if it is no more than an int can
  double to_grid(double x) const;                  ///< xi of a place x [m] of the domain
  double to_space(double xi) const;                ///< x [m]
  double span_width(int node) const;               ///< of the knot span of a node 0..cells, mirrored at walls [m]
  double finest() const;                           ///< least of them [m]

 private:
  double ramp(double distance) const;
  double from_ramp(double cells) const;
  double integral(double x) const;
  double place_of(double integral) const;

  double lower_, upper_, spacing_;
  bool graded_;
  RefineSpec zone_{};
  double zone_cells_ = 0;  ///< of the zone itself
  double ramp_width_ = 0;  ///< over which cells grow from fine to coarse [m]
  double begin_ = 0;       ///< integral at the lower wall
  double scale_ = 1;       ///< c
  double wanted_;          ///< cells that s asks for
  int cells_;
};

/// A knot span of width w, and the distances g of its node to the neighbours: with t = x - left the splines on it are
/// N_below = (w - t)^2 / (2 w g_below), N_above = t^2 / (2 w g_above), N_own = 1 - both. The divisions are left to the
/// kernels: they do many at once, and four numbers are quicker to fetch than eight (a step in 2D: 42 ns instead of 45).
struct alignas(32) KnotSpan {
  double left, width;           ///< [m]
  double gap_below, gap_above;  ///< [m]
};

/// The knot spans of one axis by stored node, and which of them a place lies in: bins no wider than the finest span
/// know the first span that meets them, and one comparison decides.
class KnotTable {
 public:
  KnotTable() = default;
  KnotTable(const GridSpec& grid, int axis, int pad);

  bool empty() const { return spans_.empty(); }
  const KnotSpan& operator[](int stored) const { return spans_[stored]; }
  const KnotSpan* spans() const { return spans_.data(); }
  double finest() const;  ///< width of the finest span [m]
  double node(int stored) const { return spans_[stored].left + 0.5 * spans_[stored].width; }

  /// Stored node of the span that holds x; of the first or last one beyond the table.
  int find(double x) const {
    const double bin = (x - bin_origin_) * inv_bin_;
    return find_in(static_cast<int>(bin > 0 ? std::min(bin, last_bin_) : 0.0), x);
  }
  /// The same for an x that is known to lie in the table.
  int find_inside(double x) const { return find_in(static_cast<int>((x - bin_origin_) * inv_bin_), x); }

 private:
  int find_in(int bin, double x) const {
    const int first = first_[bin];
    return first + (x >= spans_[first + 1].left ? 1 : 0);
  }
  void fill_bins();

  Array<KnotSpan> spans_;  ///< and a last one that only ends the one before
  Array<std::int32_t> first_;
  double bin_origin_ = 0, inv_bin_ = 0, last_bin_ = 0;
};

/// Width of the finest cell of a grid [m].
double finest_spacing(const GridSpec& grid);

}  // namespace geodrop
