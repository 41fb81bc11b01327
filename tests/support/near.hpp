// Comparisons that say by name whether they are relative or absolute. doctest's Approx adds a scale of 1, so that its
// epsilon is absolute for small values: 0.66 mm "to 1 %" passes with 10 mm.
#pragma once

#include <doctest/doctest.h>

#include <cassert>
#include <cmath>
#include <cstdio>

namespace geodrop::test {

/// An expected value and the largest difference from it that passes. NaN never does.
struct Near {
  double expected, tolerance;

  bool holds(double value) const { return std::abs(value - expected) <= tolerance; }
  friend bool operator==(double value, const Near& near) { return near.holds(value); }
  friend bool operator!=(double value, const Near& near) { return !near.holds(value); }
  friend doctest::String toString(const Near& near) {
    char text[64];
    std::snprintf(text, sizeof text, "%.10g +- %.3g", near.expected, near.tolerance);
    return text;
  }
};

/// |value - expected| <= relative |expected|; expected is not 0.
inline Near near(double expected, double relative) {
  assert(expected != 0);
  return {expected, relative * std::abs(expected)};
}

/// |value - expected| <= absolute, in the unit of the value.
inline Near within(double expected, double absolute) { return {expected, absolute}; }

/// |value| <= absolute, in the unit of the value.
inline Near near_zero(double absolute) { return {0, absolute}; }

}  // namespace geodrop::test
