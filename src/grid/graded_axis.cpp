#include <cmath>
#include <geodrop/grid/graded_axis.hpp>
#include <limits>

namespace geodrop {
namespace {

/// Of a cell: a spacing that divides the domain up to round-off gives the cells that one expects.
constexpr double rounding = 1e-6;

const RefineSpec* zone_along(const GridSpec& grid, int axis) {
  for (const RefineSpec& zone : grid.refine)
    if (zone.axis == axis) return &zone;
  return nullptr;
}

}  // namespace

AxisMap::AxisMap(const GridSpec& grid, int axis)
    : lower_(grid.lower[axis]), upper_(grid.upper[axis]), spacing_(grid.spacing) {
  const RefineSpec* zone = zone_along(grid, axis);
  graded_ = zone != nullptr;
  if (!graded_) {
    wanted_ = (upper_ - lower_) / spacing_;
    cells_ = static_cast<int>(std::lround(wanted_));
    return;
  }
  zone_ = *zone;
  zone_.spacing = std::min(zone_.spacing, spacing_);
  zone_cells_ = (zone_.to - zone_.from) / zone_.spacing;
  ramp_width_ = (spacing_ - zone_.spacing) / std::log(zone_.growth);
  begin_ = integral(lower_);
  wanted_ = integral(upper_) - begin_;
  constexpr double most = 1e9;
  cells_ = std::max(1, static_cast<int>(std::ceil(std::min(wanted_ - rounding, most))));
  scale_ = cells_ / wanted_;
}

/// Cells between the edge of the zone and a place at this distance from it.
double AxisMap::ramp(double distance) const {
  const double rate = std::log(zone_.growth), on_ramp = std::min(distance, ramp_width_);
  return std::log1p(rate * on_ramp / zone_.spacing) / rate + (distance - on_ramp) / spacing_;
}

double AxisMap::from_ramp(double cells) const {
  const double rate = std::log(zone_.growth), on_ramp = std::min(cells, ramp(ramp_width_));
  return std::expm1(rate * on_ramp) * zone_.spacing / rate + (cells - on_ramp) * spacing_;
}

/// int dx / s from the lower end of the zone.
double AxisMap::integral(double x) const {
  if (x < zone_.from) return -ramp(zone_.from - x);
  if (x > zone_.to) return zone_cells_ + ramp(x - zone_.to);
  return (x - zone_.from) / zone_.spacing;
}

double AxisMap::place_of(double integral) const {
  if (integral < 0) return zone_.from - from_ramp(-integral);
  if (integral > zone_cells_) return zone_.to + from_ramp(integral - zone_cells_);
  return zone_.from + integral * zone_.spacing;
}

double AxisMap::to_grid(double x) const { return graded_ ? (integral(x) - begin_) * scale_ : (x - lower_) / spacing_; }

double AxisMap::to_space(double xi) const { return graded_ ? place_of(xi / scale_ + begin_) : lower_ + xi * spacing_; }

double AxisMap::span_width(int node) const {
  if (!graded_) return spacing_;
  if (node == 0) return 2 * (to_space(0.5) - lower_);
  if (node == cells_) return 2 * (upper_ - to_space(cells_ - 0.5));
  return to_space(node + 0.5) - to_space(node - 0.5);
}

/// The finest spans are those at the middle of the zone, or beside it if none lies within.
double AxisMap::finest() const {
  if (!graded_) return spacing_;
  const int middle = static_cast<int>(std::lround(to_grid((zone_.from + zone_.to) / 2)));
  double width = spacing_;
  for (int node = std::max(0, middle - 2); node <= std::min(cells_, middle + 2); ++node)
    width = std::min(width, span_width(node));
  return width;
}

KnotTable::KnotTable(const GridSpec& grid, int axis, int pad) {
  const AxisMap map(grid, axis);
  const int cells = map.cells(), stored = cells + 1 + 2 * pad;
  const double lower = grid.lower[axis], upper = grid.upper[axis];
  const auto width_of = [&](int node) {
    const int period = 2 * cells, folded = ((node % period) + period) % period;  // at the walls
    return map.span_width(std::min(folded, period - folded));
  };
  const auto left_of = [&](int node) {
    if (!map.graded()) return lower + (node - 0.5) * grid.spacing;
    if (node <= 0) return 2 * lower - map.to_space(0.5 - node);
    if (node > cells) return 2 * upper - map.to_space(2 * cells - node + 0.5);
    return map.to_space(node - 0.5);
  };
  spans_.resize(stored + 1);
  for (int s = 0; s < stored; ++s) {
    const int node = s - pad;
    const double w = width_of(node), below = width_of(node - 1), above = width_of(node + 1);
    spans_[s] = {left_of(node), w, (below + w) / 2, (w + above) / 2};
  }
  spans_[stored] = spans_[stored - 1];
  spans_[stored].left = std::numeric_limits<double>::infinity();
  fill_bins();
}

void KnotTable::fill_bins() {
  const int count = static_cast<int>(spans_.size()) - 1;
  bin_origin_ = spans_[0].left;
  const double length = spans_[count - 1].left + spans_[count - 1].width - bin_origin_;
  const int bins = 1 + static_cast<int>(std::ceil(length / finest()));
  inv_bin_ = bins / length;
  last_bin_ = bins;
  first_.resize(bins + 1);  // the last one is for the end itself
  for (int b = 0, s = 0; b <= bins; ++b) {
    while (spans_[s + 1].left <= bin_origin_ + b / inv_bin_) ++s;
    first_[b] = s;
  }
}

double KnotTable::finest() const {
  double width = std::numeric_limits<double>::infinity();
  for (const KnotSpan& span : spans_) width = std::min(width, span.width);
  return width;
}

double finest_spacing(const GridSpec& grid) {
  double width = grid.spacing;
  for (const RefineSpec& zone : grid.refine) width = std::min(width, AxisMap(grid, zone.axis).finest());
  return width;
}

}  // namespace geodrop
