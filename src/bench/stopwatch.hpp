// Wall time, and the time that ratios are made of.
#pragma once

#include <chrono>
#include <ctime>

namespace geodrop {

/// On one thread the judged time is the processor's, which does not run while another process has the core: on a busy
/// machine wall times of one benchmark differ by 50 %. On more threads it is the wall time, because processor time does
/// not see threads wait for each other.
class Stopwatch {
 public:
  explicit Stopwatch(int threads) : threads_(threads), wall_(Clock::now()), processor_(std::clock()) {}

  double wall_seconds() const { return std::chrono::duration<double>(Clock::now() - wall_).count(); }
  double judged_seconds() const {
    return threads_ == 1 ? static_cast<double>(std::clock() - processor_) / CLOCKS_PER_SEC : wall_seconds();
  }

 private:
  using Clock = std::chrono::steady_clock;
  int threads_;
  Clock::time_point wall_;
  std::clock_t processor_;
};

}  // namespace geodrop
