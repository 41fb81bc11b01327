// Pieces of the membrane's curve: the coefficients follow from those before them by the differential equations.
#include "membrane_path.hpp"

#include "find_root.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace geodrop {
namespace {

constexpr double pi = std::numbers::pi;

template <class Series>
double value(const Series& series, double ds) {
  double sum = 0;
  for (auto coefficient = series.rbegin(); coefficient != series.rend(); ++coefficient) sum = sum * ds + *coefficient;
  return sum;
}

}  // namespace

MembranePath::MembranePath(const MembraneLoad& load, double longest) : longest_(longest) {
  end_ = {0, 0, 0, 0, load.top_pressure, 0};
  if (load.change_level > 0) {
    // T (1 - cos theta) is the integral of p over y from the crown, T (1 + cos theta) that down to the ground.
    const double depth = load.height - load.change_level, change = load.top_pressure + load.upper_gradient * depth;
    const double above = (load.top_pressure + change) * depth;
    const double below = (change + load.bottom_pressure) * load.change_level;
    follow(load.upper_gradient, load.tension, 2 * std::atan2(std::sqrt(above), std::sqrt(below)));
  }
  follow(load.lower_gradient, load.tension, pi);
}

PathPoint MembranePath::at(double s) const {
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), s,
                                      [](double wanted, const Piece& piece) { return wanted < piece.s; });
  const Piece& piece = after == pieces_.begin() ? pieces_.front() : *std::prev(after);  // s may be a rounding below 0
  return piece.point((s - piece.s) / piece.length);
}

PathPoint MembranePath::where_upright() const {
  const auto piece = std::find_if(pieces_.begin(), pieces_.end(),
                                  [](const Piece& candidate) { return candidate.point(1).theta >= pi / 2; });
  return piece->point(piece->part_where_theta(pi / 2));
}

PathPoint MembranePath::Piece::point(double part) const {
  const double ds = part * length;
  return {s + ds, value(x, ds), value(y, ds), value(theta, ds), value(pressure, ds), value(area, ds)};
}

double MembranePath::Piece::part_where_theta(double wanted) const {
  return find_root([&](double part) { return value(theta, part * length) - wanted; }, 0, 1);
}

/// Cauchy products: sin and cos by their own differential equations, the area by dA = 2 x dy.
MembranePath::Piece MembranePath::start_piece(const PathPoint& at, double gradient, double tension) {
  Piece piece{at.s, 0, {}, {}, {}, {}, {}};
  Series sine{}, cosine{};
  piece.x[0] = at.x, piece.y[0] = at.y, piece.theta[0] = at.theta, piece.pressure[0] = at.pressure;
  piece.area[0] = at.area, sine[0] = std::sin(at.theta), cosine[0] = std::cos(at.theta);
  for (std::size_t n = 0; n < order; ++n) {
    const double next = static_cast<double>(n) + 1;
    piece.theta[n + 1] = piece.pressure[n] / (tension * next);
    piece.pressure[n + 1] = gradient * sine[n] / next;
    piece.x[n + 1] = cosine[n] / next;
    piece.y[n + 1] = sine[n] / next;
    double sine_rate = 0, cosine_rate = 0, area_rate = 0;
    for (std::size_t k = 0; k <= n; ++k) {
      const double turn = (static_cast<double>(k) + 1) * piece.theta[k + 1];
      sine_rate += turn * cosine[n - k];
      cosine_rate -= turn * sine[n - k];
      area_rate += 2 * piece.x[k] * sine[n - k];
    }
    sine[n + 1] = sine_rate / next;
    cosine[n + 1] = cosine_rate / next;
    piece.area[n + 1] = area_rate / next;
  }
  return piece;
}

void MembranePath::follow(double gradient, double tension, double theta) {
  // p is largest where the curve, gone on with as it began, would be steepest down (or up, if g < 0): p^2 differs by at
  // most 4 |g| T from here. The poles of theta(s) in the complex plane are pi T / p_max away or more; half of T / p_max
  // is a sixth of that, and 6.3^-20 = 1e-16. Such a piece turns by less than half a radian.
  const double highest = std::sqrt(end_.pressure * end_.pressure + 4 * std::abs(gradient) * tension);
  while (end_.theta < theta && end_.s <= longest_) {
    Piece piece = start_piece(end_, gradient, tension);
    piece.length = tension / (2 * highest);
    if (piece.point(1).theta >= theta) {
      piece.length *= piece.part_where_theta(theta);
      end_ = piece.point(1);
      end_.theta = theta;
    } else {
      end_ = piece.point(1);
    }
    if (piece.length > 0) pieces_.push_back(piece);
  }
}

}  // namespace geodrop
