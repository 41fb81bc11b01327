// Where a cell that does not stand by itself looks for one to join.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

namespace geodrop {

/// Offsets to the cells around, up to three away along each axis (two in space), nearest first. The order is fixed: the
/// largest of several whole cells would be another one at each step, by round-off, and the changing hosts would keep a
/// body in motion.
template <int Dim>
std::vector<std::array<int, Dim>> offsets_by_distance() {
  constexpr int farthest = Dim == 2 ? 3 : 2, width = 2 * farthest + 1,
                all = Dim == 2 ? width * width : width * width * width;
  std::vector<std::array<int, Dim>> offsets;
  for (int n = 0; n < all; ++n) {
    std::array<int, Dim> offset;
    for (int a = 0, rest = n; a < Dim; ++a, rest /= width) offset[a] = rest % width - farthest;
    offsets.push_back(offset);
  }
  const auto square = [](const std::array<int, Dim>& o) {
    int sum = 0;
    for (const int step : o) sum += step * step;
    return sum;
  };
  std::stable_sort(offsets.begin(), offsets.end(), [&](const auto& a, const auto& b) { return square(a) < square(b); });
  return offsets;
}

}  // namespace geodrop
