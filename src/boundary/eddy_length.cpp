#include "eddy_length.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cut/outline_pieces.hpp"
#include "cut/rough_wall.hpp"
#include "geometry/triangle.hpp"
#include "membrane/outline.hpp"
#include "membrane/triangles.hpp"

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

/// The box around a segment or triangle.
std::pair<std::array<double, 2>, std::array<double, 2>> box_of(const WallPart<2>& part) {
  return {{part.x + std::min(part.dx, 0.0), part.y + std::min(part.dy, 0.0)},
          {part.x + std::max(part.dx, 0.0), part.y + std::max(part.dy, 0.0)}};
}
std::pair<std::array<double, 3>, std::array<double, 3>> box_of(const WallPart<3>& part) {
  const auto& [p, q, r] = part.corner;
  const Vec<3> low = p.cwiseMin(q).cwiseMin(r), high = p.cwiseMax(q).cwiseMax(r);
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

double distance_to(const WallPart<2>& part, const std::array<double, 2>& x) {
  const double rx = x[0] - part.x, ry = x[1] - part.y;
  const double square = part.dx * part.dx + part.dy * part.dy;
  const double along = square > 0 ? std::clamp((rx * part.dx + ry * part.dy) / square, 0.0, 1.0) : 0.0;
  const double ex = rx - along * part.dx, ey = ry - along * part.dy;
  return std::sqrt(ex * ex + ey * ey);
}
double distance_to(const WallPart<3>& part, const std::array<double, 3>& x) {
  const Vec<3> at(x.data());
  return (at - nearest_point(part.corner, at)).norm();
}

/// f(part) for the segments or triangles of a membrane.
template <class F>
void for_each_part(const Membrane<2>& membrane, F&& f) {
  for (std::size_t s = 0; s < membrane.segments(); ++s) {
    const std::size_t end = end_of_edge(s, membrane.nodes());
    const double x = membrane.x[0][s], y = membrane.x[1][s];
    f(WallPart<2>{x, y, membrane.x[0][end] - x, membrane.x[1][end] - y, rough_wall_share * membrane.roughness});
  }
}
template <class F>
void for_each_part(const Membrane<3>& membrane, F&& f) {
  for (std::size_t t = 0; t < membrane.triangles.size(); ++t)
    f(WallPart<3>{corners_of(membrane, t), rough_wall_share * membrane.roughness});
}

}  // namespace

template <int Dim>
void NearOutlines<Dim>::add(const WallPart<Dim>& part, double reach) {
  const auto [low, high] = box_of(part);
  std::array<int, Dim> first, last;
  for (int a = 0; a < Dim; ++a) {
    first[a] = std::max(0, static_cast<int>(std::floor((low[a] - reach - lower_[a]) / size_)));
    last[a] = std::min(count_[a] - 1, static_cast<int>(std::floor((high[a] + reach - lower_[a]) / size_)));
    if (first[a] > last[a]) return;
  }
  const auto number = static_cast<std::uint32_t>(parts_.size());
  parts_.push_back(part);
  std::array<int, Dim> at = first;
  for (;;) {
    squares_[square_of(at)].push_back(number);
    int a = 0;
    while (a < Dim && at[a] == last[a]) {
      at[a] = first[a];
      ++a;
    }
    if (a == Dim) return;
    ++at[a];
  }
}

template <int Dim>
void NearOutlines<Dim>::update(const State<Dim>& state, double reach) {
  constexpr double most_squares = Dim == 2 ? 256 : 64;  // along an axis
  count_ = {};
  std::array<double, Dim> upper;
  lower_.fill(std::numeric_limits<double>::infinity());
  upper.fill(-lower_[0]);
  for (const Membrane<Dim>& membrane : state.membranes)
    for (int a = 0; a < Dim && acts_sharply(membrane); ++a) {
      const auto [low, high] = std::minmax_element(membrane.x[a].begin(), membrane.x[a].end());
      lower_[a] = std::min(lower_[a], *low - reach);
      upper[a] = std::max(upper[a], *high + reach);
    }
  if (!(upper[0] > lower_[0])) return;
  double longest = 0;
  for (int a = 0; a < Dim; ++a) longest = std::max(longest, upper[a] - lower_[a]);
  size_ = std::max(reach, longest / most_squares);
  std::size_t squares = 1;
  for (int a = 0; a < Dim; ++a) {
    count_[a] = static_cast<int>((upper[a] - lower_[a]) / size_) + 1;
    squares *= static_cast<std::size_t>(count_[a]);
  }
  parts_.clear();
  for (auto& square : squares_) square.clear();
  squares_.resize(std::max(squares_.size(), squares));
  for (const Membrane<Dim>& membrane : state.membranes)
    if (acts_sharply(membrane)) for_each_part(membrane, [&](const WallPart<Dim>& part) { add(part, reach); });
}

template <int Dim>
double NearOutlines<Dim>::least_length(const std::array<double, Dim>& x, double most) const {
  std::array<int, Dim> at;
  for (int a = 0; a < Dim; ++a) {
    const double u = (x[a] - lower_[a]) / size_;
    if (!(u >= 0 && u < count_[a])) return most;
    at[a] = static_cast<int>(u);
  }
  for (const std::uint32_t number : squares_[square_of(at)]) {
    const WallPart<Dim>& part = parts_[number];
    most = std::min(most, von_karman * (distance_to(part, x) + part.rough));
  }
  return most;
}

template <int Dim>
void limit_eddies(const GridLayout<Dim>& layout, NearOutlines<Dim>& outlines, State<Dim>& state) {
  for (Body<Dim>& body : state.bodies) {
    const auto* fluid = std::get_if<Newtonian>(&body.material);
    if (!fluid || !(fluid->mixing_length > 0)) continue;
    const double free = fluid->mixing_length;
    outlines.update(state, free / von_karman);
    const auto n = static_cast<std::ptrdiff_t>(body.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      const auto p = static_cast<std::size_t>(i);
      std::array<double, Dim> x;
      for (int a = 0; a < Dim; ++a) x[a] = body.x[a][p];
      body.eddy_length[p] = outlines.least_length(x, length_at_sides(layout, body, p, free));
    }
  }
}

template class NearOutlines<2>;
template class NearOutlines<3>;
template void limit_eddies<2>(const GridLayout<2>&, NearOutlines<2>&, State<2>&);
template void limit_eddies<3>(const GridLayout<3>&, NearOutlines<3>&, State<3>&);

}  // namespace geodrop
