// How many threads a run takes, of those that it may. The bits of a step do not depend on it, its duration does: a
// second thread makes a small scene slower, and where other programs want the cores, threads wait for each other at
// every loop.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace geodrop {

/// Tries half and twice as many threads for some steps now and then, and keeps what was faster.
class ThreadChoice {
 public:
  explicit ThreadChoice(int most);

  /// For the next step.
  int threads() const { return counts_[trying_ ? tried_ : level_]; }

  /// Of the step with that many [s].
  void took(double seconds);

  /// "threads: 2 in 93 % of the steps, 1 in 7 %".
  std::string text() const;

 private:
  enum Direction { fewer, more };

  void begin_trial(Direction direction);
  void end_trial(bool adopt);
  bool due(Direction direction) const;
  bool possible(Direction direction) const { return direction == fewer ? level_ > 0 : level_ + 1 < counts_.size(); }

  std::vector<int> counts_;                 ///< ascending
  std::size_t level_;                       ///< of the number in use
  std::vector<double> last_;                ///< durations of the last steps with it [s]
  double settled_ = 0;                      ///< what a step took after the last trial [s]
  double clock_ = 0;                        ///< [s]
  std::array<double, 2> next_{}, pause_{};  ///< when each direction is tried again, and the time between [s]
  bool trying_ = false;
  Direction direction_ = fewer;
  std::size_t tried_ = 0;
  std::vector<double> trial_;       ///< durations of its steps [s]
  std::vector<std::size_t> steps_;  ///< with each number
};

}  // namespace geodrop
