// Where a cell that does not stand by itself looks for one to join.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

namespace geodrop {

/// Offsets to the cells around, up to three away along both axes, nearest first. The order is fixed: the largest of
/// several whole cells would be another one at each step, by round-off, and the changing hosts would keep a body in
/// motion.
inline std::vector<std::array<int, 2>> offsets_by_distance() {
  constexpr int farthest = 3;
  std::vector<std::array<int, 2>> offsets;
  for (int y = -farthest; y <= farthest; ++y)
    for (int x = -farthest; x <= farthest; ++x) offsets.push_back({x, y});
  const auto square = [](const std::array<int, 2>& o) { return o[0] * o[0] + o[1] * o[1]; };
  std::stable_sort(offsets.begin(), offsets.end(), [&](const auto& a, const auto& b) { return square(a) < square(b); });
  return offsets;
}

}  // namespace geodrop
