#include "figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"

namespace geodrop {
namespace {

constexpr std::array prefixed = {"N", "Pa", "J"};

/// "N/m" and "N" begin with a unit that takes k and M, "kg" does not.
bool takes_prefix(const std::string& unit) {
  const std::string first = unit.substr(0, unit.find_first_of("/ 2"));
  return std::ranges::find(prefixed, first) != prefixed.end();
}

std::string decimals(double value, int count) { return fmt::format("{:.{}f}", value, count); }

}  // namespace

Scaled scaled_unit(const std::string& unit, double largest) {
  constexpr double kilo = 1e3, mega = 1e6;
  if (unit == "1") return {1, ""};
  if (!takes_prefix(unit) || !std::isfinite(largest)) return {1, unit};
  if (std::abs(largest) >= mega) return {1 / mega, "M" + unit};
  return std::abs(largest) >= kilo ? Scaled{1 / kilo, "k" + unit} : Scaled{1, unit};
}

std::string figure(double value, const Scaled& scaled, double size_beside) {
  constexpr double smallest = 1e-6, smallest_angle = 1e-3, fixed_below = 1e6, fixed_above = 1e-3, round_off = 1e-5;
  constexpr int digits = 3;
  const double shown = value * scaled.factor, size = std::abs(shown);
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  if (size < (scaled.unit == "degree" ? smallest_angle : smallest)) return "0";
  if (std::abs(value) < round_off * size_beside) return "0";
  if (size >= fixed_below || size < fixed_above) return format_number(shown, digits);
  const int before = static_cast<int>(std::floor(std::log10(size))) + 1;  // digits before the point
  return decimals(shown, std::max(0, digits - before));
}

std::string figure(double value, const std::string& unit, double size) {
  const Scaled scaled = scaled_unit(unit, value);
  const std::string number = figure(value, scaled, size);
  return number == "-" || scaled.unit.empty() ? number : number + " " + scaled.unit;
}

}  // namespace geodrop
