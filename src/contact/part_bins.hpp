// Segments or triangles of a membrane in square or cubic bins, to find those near a point.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "membrane/bounds.hpp"

namespace geodrop {

/// The middles of parts, of which each is in one of the 3 x 3 (x 3) bins around any point within reach of the part.
template <int Dim>
class PartBins {
 public:
  using Middles = std::vector<std::pair<std::size_t, Vec<Dim>>>;

  /// `middles`: parts with their middles, all in `region`; `width`: of a bin, the reach and what a part is away from
  /// its middle at most [m].
  PartBins(const Middles& middles, const Box<Dim>& region, double width) : lower_(region.lower), width_(width) {
    for (int a = 0; a < Dim - 1; ++a)
      count_[a] = static_cast<std::ptrdiff_t>((region.upper[a] - region.lower[a]) / width_) + 3;
    for (const auto& [part, middle] : middles) entries_.emplace_back(key(middle), part);
    std::sort(entries_.begin(), entries_.end());
  }

  bool empty() const { return entries_.empty(); }

  /// f(part) for those that may be within reach of x.
  template <class F>
  void for_each_near(const Vec<Dim>& x, F&& f) const {
    constexpr int rows = Dim == 2 ? 3 : 9;
    for (int n = 0; n < rows; ++n) {
      std::ptrdiff_t middle = key(x) + count_[0] * (n % 3 - 1);
      if constexpr (Dim == 3) middle += count_[0] * count_[1] * (n / 3 - 1);
      auto entry = std::lower_bound(entries_.begin(), entries_.end(), Entry{middle - 1, 0});
      for (; entry != entries_.end() && entry->first <= middle + 1; ++entry) f(entry->second);
    }
  }

 private:
  using Entry = std::pair<std::ptrdiff_t, std::size_t>;

  std::ptrdiff_t key(const Vec<Dim>& x) const {
    const auto at = [&](int a) { return static_cast<std::ptrdiff_t>(std::floor((x[a] - lower_[a]) / width_)); };
    std::ptrdiff_t key = at(Dim - 1);
    for (int a = Dim - 2; a >= 0; --a) key = key * count_[a] + at(a) + 1;
    return key;
  }

  Vec<Dim> lower_;
  double width_;
  std::array<std::ptrdiff_t, Dim - 1> count_{};
  std::vector<Entry> entries_;
};

}  // namespace geodrop
