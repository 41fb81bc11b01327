#include "thread_choice.hpp"

#include <algorithm>
#include <cmath>

namespace geodrop {
namespace {

constexpr std::size_t remembered = 9;   // steps of which the median is what a step takes
constexpr std::size_t trial_steps = 6;  // the first, in which threads start, does not count
constexpr double gain = 0.95;           // of the duration: what is kept has to be this much faster
constexpr double too_slow = 2;  // times the duration of a step: a trial ends at once, the use of a number is tried
constexpr double start_too_slow = 10;                    // the same for a trial's first step
constexpr double first_pause = 0.5, longest_pause = 30;  // between trials of a direction [s]

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

ThreadChoice::ThreadChoice(int most) {
  for (int count = std::max(1, most); count > 0; count /= 2) counts_.insert(counts_.begin(), count);
  level_ = counts_.size() - 1;
  steps_.assign(counts_.size(), 0);
  pause_.fill(first_pause);
  next_.fill(first_pause);  // the first frame is on its way to the disk
}

void ThreadChoice::took(double seconds) {
  clock_ += seconds;
  ++steps_[trying_ ? tried_ : level_];
  if (counts_.size() == 1) return;
  if (trying_) {
    trial_.push_back(seconds);
    const double usual = median(last_);
    if (seconds > (trial_.size() == 1 ? start_too_slow : too_slow) * usual) return end_trial(false);
    if (trial_.size() < trial_steps) return;
    return end_trial(median({trial_.begin() + 1, trial_.end()}) < gain * usual);
  }
  if (last_.size() == remembered) last_.erase(last_.begin());
  last_.push_back(seconds);
  if (last_.size() < trial_steps) return;
  const double usual = median(last_);
  if (settled_ == 0) settled_ = usual;
  if (usual > too_slow * settled_) {  // other programs have come, or the scene has changed
    settled_ = usual;
    next_.fill(clock_);
  }
  if (due(fewer))
    begin_trial(fewer);
  else if (due(more))
    begin_trial(more);
}

bool ThreadChoice::due(Direction direction) const { return possible(direction) && clock_ >= next_[direction]; }

void ThreadChoice::begin_trial(Direction direction) {
  trying_ = true;
  direction_ = direction;
  tried_ = direction == fewer ? level_ - 1 : level_ + 1;
  trial_.clear();
}

void ThreadChoice::end_trial(bool adopt) {
  trying_ = false;
  if (adopt) {
    level_ = tried_;
    last_.clear();
    settled_ = 0;
    pause_.fill(first_pause);
  } else {
    pause_[direction_] = std::min(2 * pause_[direction_], longest_pause);
    settled_ = median(last_);
  }
  next_[direction_] = clock_ + pause_[direction_];
  // The way back from what was adopted was slower; a frame on its way to the disk may have been the reason.
  if (adopt) next_[direction_ == fewer ? more : fewer] = clock_ + 2 * first_pause;
}

std::string ThreadChoice::text() const {
  std::size_t all = 0;
  for (const std::size_t steps : steps_) all += steps;
  std::string text;
  for (std::size_t level = counts_.size(); level-- > 0;) {
    if (steps_[level] == 0) continue;
    const auto percent =
        static_cast<int>(std::lround(100.0 * static_cast<double>(steps_[level]) / static_cast<double>(all)));
    text +=
        (text.empty() ? "threads: " : ", ") + std::to_string(counts_[level]) + " in " + std::to_string(percent) + " %";
    if (text.find("steps") == std::string::npos) text += " of the steps";
  }
  return text;
}

}  // namespace geodrop
