// Root mean square and maximum of errors.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace geodrop {

/// Sum of squares, and the largest.
struct Spread {
  double square = 0, largest = 0;
  void add(double square_of_one) {
    square += square_of_one;
    largest = std::max(largest, square_of_one);
  }
  Spread& operator+=(const Spread& other) {
    square += other.square;
    largest = std::max(largest, other.largest);
    return *this;
  }
  double rms(std::size_t n) const { return std::sqrt(square / static_cast<double>(n)); }
  double max() const { return std::sqrt(largest); }
};

}  // namespace geodrop
