// Wall time, and processor time, which does not run while another process has the core.
#pragma once

#include <chrono>
#include <ctime>

namespace geodrop {

class Stopwatch {
 public:
  Stopwatch() : wall_(Clock::now()), processor_(std::clock()) {}

  double wall_seconds() const { return std::chrono::duration<double>(Clock::now() - wall_).count(); }
  /// Of all threads together.
  double processor_seconds() const { return static_cast<double>(std::clock() - processor_) / CLOCKS_PER_SEC; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point wall_;
  std::clock_t processor_;
};

}  // namespace geodrop
