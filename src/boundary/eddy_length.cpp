#include "eddy_length.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cut/outline_pieces.hpp"
#include "cut/rough_wall.hpp"
#include "membrane/outline.hpp"

namespace geodrop {
namespace {

/// kappa times the distance to the nearest side where the flow sticks, if that is less than `most` [m].
template <int Dim>
double length_at_sides(const GridLayout<Dim>& layout, const Body<Dim>& body, std::size_t p, double most) {
  for (int a = 0; a < Dim; ++a) {
    if (layout.periodic(a)) continue;
    if (layout.lower_wall[a] == WallKind::no_slip) most = std::min(most, von_karman * (body.x[a][p] - layout.lower[a]));
    if (layout.upper_wall[a] == WallKind::no_slip) most = std::min(most, von_karman * (layout.upper[a] - body.x[a][p]));
  }
  return std::max(most, 0.0);
}

}  // namespace

void NearOutlines::add(const Segment& segment) {
  std::array<int, 2> first, last;
  const std::array<double, 2> at{segment.x, segment.y}, way{segment.dx, segment.dy};
  for (int a = 0; a < 2; ++a) {
    const double low = at[a] + std::min(way[a], 0.0) - lower_[a], high = at[a] + std::max(way[a], 0.0) - lower_[a];
    first[a] = std::max(0, static_cast<int>(low / size_) - 1);
    last[a] = std::min(count_[a] - 1, static_cast<int>(high / size_) + 1);
  }
  for (int j = first[1]; j <= last[1]; ++j)
    for (int i = first[0]; i <= last[0]; ++i) squares_[square_of(i, j)].push_back(segment);
}

void NearOutlines::update(const State<2>& state, double reach) {
  constexpr double most_squares = 256;  // along an axis
  count_ = {};
  std::array<double, 2> upper;
  lower_.fill(std::numeric_limits<double>::infinity());
  upper.fill(-lower_[0]);
  for (const Membrane<2>& membrane : state.membranes)
    for (int a = 0; a < 2 && acts_sharply(membrane); ++a) {
      const auto [low, high] = std::minmax_element(membrane.x[a].begin(), membrane.x[a].end());
      lower_[a] = std::min(lower_[a], *low - reach);
      upper[a] = std::max(upper[a], *high + reach);
    }
  if (!(upper[0] > lower_[0])) return;
  size_ = std::max(reach, std::max(upper[0] - lower_[0], upper[1] - lower_[1]) / most_squares);
  for (int a = 0; a < 2; ++a) count_[a] = static_cast<int>((upper[a] - lower_[a]) / size_) + 1;
  for (auto& square : squares_) square.clear();
  squares_.resize(std::max(squares_.size(), square_of(0, count_[1])));
  for (const Membrane<2>& membrane : state.membranes)
    for (std::size_t s = 0; s < membrane.segments() && acts_sharply(membrane); ++s) {
      const std::size_t end = end_of_edge(s, membrane.nodes());
      const double x = membrane.x[0][s], y = membrane.x[1][s];
      add({x, y, membrane.x[0][end] - x, membrane.x[1][end] - y, rough_wall_share * membrane.roughness});
    }
}

double NearOutlines::least_length(double x, double y, double most) const {
  const double u = (x - lower_[0]) / size_, v = (y - lower_[1]) / size_;
  if (!(u >= 0 && v >= 0 && u < count_[0] && v < count_[1])) return most;
  for (const Segment& segment : squares_[square_of(static_cast<int>(u), static_cast<int>(v))]) {
    const double rx = x - segment.x, ry = y - segment.y;
    const double square = segment.dx * segment.dx + segment.dy * segment.dy;
    const double along = square > 0 ? std::clamp((rx * segment.dx + ry * segment.dy) / square, 0.0, 1.0) : 0.0;
    const double ex = rx - along * segment.dx, ey = ry - along * segment.dy;
    most = std::min(most, von_karman * (std::sqrt(ex * ex + ey * ey) + segment.rough));
  }
  return most;
}

template <int Dim>
void limit_eddies(const GridLayout<Dim>& layout, NearOutlines& outlines, State<Dim>& state) {
  for (Body<Dim>& body : state.bodies) {
    const auto* fluid = std::get_if<Newtonian>(&body.material);
    if (!fluid || !(fluid->mixing_length > 0)) continue;
    const double free = fluid->mixing_length;
    if constexpr (Dim == 2) outlines.update(state, free / von_karman);
    const auto n = static_cast<std::ptrdiff_t>(body.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      const auto p = static_cast<std::size_t>(i);
      double length = length_at_sides(layout, body, p, free);
      if constexpr (Dim == 2) length = outlines.least_length(body.x[0][p], body.x[1][p], length);
      body.eddy_length[p] = length;
    }
  }
}

template void limit_eddies<2>(const GridLayout<2>&, NearOutlines&, State<2>&);
template void limit_eddies<3>(const GridLayout<3>&, NearOutlines&, State<3>&);

}  // namespace geodrop
