// Values of tables between their entries.
#pragma once

#include <algorithm>
#include <cstddef>

namespace geodrop {

/// mix(value, next, share) between the two places around x, ascending; the first or last value beyond them.
auto value_at(double x, const auto& places, const auto& values, auto&& mix) {
  const auto above = static_cast<std::size_t>(std::upper_bound(places.begin(), places.end(), x) - places.begin());
  if (above == 0) return values.front();
  if (above == places.size()) return values.back();
  const double share = (x - places[above - 1]) / (places[above] - places[above - 1]);
  return mix(values[above - 1], values[above], share);
}

/// Linear between the places.
double value_at(double x, const auto& places, const auto& values) {
  return value_at(x, places, values, [](double a, double b, double s) { return a + s * (b - a); });
}

}  // namespace geodrop
