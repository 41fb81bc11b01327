// When output is due that comes at an interval of simulated time.
#pragma once

#include <algorithm>
#include <cmath>

namespace geodrop {

/// The multiples of an interval, each of which is due once: at the first time at or after it.
class Schedule {
 public:
  explicit Schedule(double interval) : interval_(interval) {}
  bool due(double t) const { return interval_ > 0 && t >= (next_ - rounding) * interval_; }
  /// No loop, which would not end where t / interval is so large that adding 1 changes nothing.
  void pass(double t) {
    if (interval_ <= 0) return;
    next_ = std::max(next_, std::floor(t / interval_ + rounding) + 1);
    if (due(t)) ++next_;  // by the last bit of the quotient
  }

 private:
  static constexpr double rounding = 1e-9;  ///< 6 times 0.1 is more than 0.6
  double interval_;
  double next_ = 0;  ///< a whole number
};

}  // namespace geodrop
