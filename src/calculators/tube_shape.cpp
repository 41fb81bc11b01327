// Even loads in closed form, others along the membrane; then one root over the pressure at the crown.
#include "tube_shape.hpp"

#include "find_root.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace geodrop {
namespace {

constexpr double pi = std::numbers::pi;

/// The same gradient g > 0 from crown to ground: complete elliptic integrals with k' = p_top / p_bottom by the
/// arithmetic-geometric mean. All terms are positive, so that no digits are lost near the circle or near a flat tube.
TubeSection even_section(const MembraneLoad& load) {
  const double p_bottom = load.bottom_pressure, g = load.upper_gradient;
  double a = 1, b = load.top_pressure / p_bottom, sum = 0;
  const double k_squared = (1 + b) * g * load.height / p_bottom;  // 1 - k'^2
  double c_squared = k_squared;
  for (double weight = 1; c_squared > std::numeric_limits<double>::epsilon() * a * a; weight *= 2) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
    const double c = c_squared / (4 * a);
    c_squared = c * c;
    sum += weight * c_squared;
  }
  const double K = pi / (2 * a), radius = 2 * load.tension / p_bottom;
  const double half_base = radius * 2 * K / k_squared * sum;
  return {radius * K, half_base, 2 * half_base * p_bottom / g};
}

/// `longest`: of the half arc; of a longer one only the beginning is computed.
TubeSection find_section(const MembraneLoad& load, double longest = std::numeric_limits<double>::infinity()) {
  if (load.change_level == 0) return even_section(load);
  const PathPoint end = MembranePath(load, longest).end();
  return {end.s, end.x, end.area};
}

bool is_all_under_heavier_water(const MembraneLoad& load) { return load.lower_gradient <= 0 && load.change_level == 0; }

/// Positive if a tube of this crown pressure needs more membrane than there is. Where the fill is not heavier than the
/// water there are pressures without any tube: high ones, whose small tube is all below the water, and low ones, which
/// the water outside exceeds at the ground.
double excess_length(const MembraneLoad& load, double length) {
  constexpr double least = 1e-5;  // of that at the water level; near zero the way along the ground has no end
  if (is_all_under_heavier_water(load)) return -1;
  if (load.bottom_pressure < least * (load.top_pressure + load.upper_gradient * (load.height - load.change_level)))
    return 1;
  const TubeSection section = find_section(load, length);
  if (section.half_arc > length) return 1;
  return 2 * (section.half_arc + section.half_base) / length - 1;
}

}  // namespace

/// Horizontal equilibrium of half the tube gives the height: 2T = p0 H + gamma H^2/2 - gamma_w hw^2/2.
MembraneLoad find_load(const TubeFluids& fluids, double top_pressure, double tension) {
  const double fill = fluids.unit_weight, level = fluids.water.level, water = fluids.water.unit_weight;
  const auto height_of = [&](double gradient, double twice_tension) {
    return 2 * twice_tension / (top_pressure + std::sqrt(top_pressure * top_pressure + 2 * gradient * twice_tension));
  };
  const auto even = [&](double gradient, double height) {
    return MembraneLoad{top_pressure, top_pressure + gradient * height, tension, height, gradient, gradient, 0};
  };
  if (level == 0) return even(fill, height_of(fill, 2 * tension));
  const double height = height_of(fill, 2 * tension + water * level * level / 2), under_water = fill - water;
  if (height > level)
    return {top_pressure, top_pressure + fill * height - water * level, tension, height, fill, under_water, level};
  return even(under_water, under_water > 0 ? height_of(under_water, 2 * tension) : level);
}

std::optional<TubeShape> find_shape(const TubeFluids& fluids, double length, double tension) {
  if (is_all_under_heavier_water(find_load(fluids, 0, tension))) return std::nullopt;  // even the flattest
  const auto load_of = [&](double log_pressure) { return find_load(fluids, std::exp(log_pressure), tension); };
  const auto excess = [&](double log_pressure) { return excess_length(load_of(log_pressure), length); };

  double high = std::log(2 * pi * tension / length);  // the circle's
  while (excess(high) > 0) high += 1;
  constexpr double longest_step = 64;
  double low = high - 1;
  for (double step = 1; excess(low) < 0; step = std::min(2 * step, longest_step)) low -= step;

  const double root = find_root(excess, low, high);
  constexpr double closed = 1e-9;  // else the root is a jump beside which there is no tube
  if (std::abs(excess(root)) > closed) return std::nullopt;
  const MembraneLoad load = load_of(root);
  const TubeSection section = find_section(load);
  if (section.half_base <= 0) return std::nullopt;
  return TubeShape{load, section};
}

}  // namespace geodrop
