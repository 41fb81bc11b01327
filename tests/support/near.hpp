// Comparisons that say by name whether they are relative or absolute. doctest's Approx adds a scale of 1, so that its
// epsilon is absolute for small values: 0.66 mm "to 1 %" passes with 10 mm. Tests name these instead, which
// checks/comparisons watches.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace geodrop::test {

/// An expected value and the largest difference from it that passes. NaN never does.
struct Near {
  double expected, tolerance;

  bool holds(double value) const { return std::abs(value - expected) <= tolerance; }
  /// C++20 makes != and the other order of operands of it.
  friend bool operator==(double value, const Near& near) { return near.holds(value); }
  friend doctest::String toString(const Near& near) {
    char text[64];
    std::snprintf(text, sizeof text, "%.17g +- %.3g", near.expected, near.tolerance);
    return text;
  }
};

/// |value - expected| <= relative |expected|. Throws where that says nothing: nothing is near 0 in proportion, and a
/// share of 1 or more lets 0 pass. The exception fails the test case in every build, where an assert would be silent.
inline Near near(double expected, double relative) {
  const double tolerance = relative * std::abs(expected);
  if (!(tolerance > 0)) throw std::invalid_argument("near: 0, NaN or no tolerance; near_zero or within is absolute");
  if (!(relative < 1)) throw std::invalid_argument("near: a relative tolerance of 1 or more");
  return {expected, tolerance};
}

/// |value - expected| <= absolute, in the unit of the value.
inline Near within(double expected, double absolute) { return {expected, absolute}; }

/// |value| <= absolute, in the unit of the value.
inline Near near_zero(double absolute) { return {0, absolute}; }

}  // namespace geodrop::test
