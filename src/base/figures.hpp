// Numbers as they are handed in: three digits and a unit of fitting size.
#pragma once

#include <string>

namespace geodrop {

/// 1 kN = 1e3 N: what a value is multiplied by for its unit.
struct Scaled {
  double factor = 1;
  std::string unit;
};

/// Thousands or millions of N, Pa, J and what is made of them, where the largest value is that large; the unit itself
/// of all others. "1" is no unit.
Scaled scaled_unit(const std::string& unit, double largest);

/// "1.81 m", "14.1 kN/m", "26.5 kPa", "12" without unit; "-" for what is no number. Three digits; what is nothing
/// beside the precision of the unit (1e-3 degree, 1e-6 else) is 0, and what is round-off beside a `size` in SI units,
/// for instance the domain's for a place in it.
std::string figure(double value, const std::string& unit, double size = 0);

/// The number alone, in the unit of `scaled`.
std::string figure(double value, const Scaled& scaled, double size = 0);

}  // namespace geodrop
