#include "console.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "base/text.hpp"

namespace geodrop {
namespace {

/// Wall-clock time in `seconds` from now; with the day if that is not today.
std::string clock_time(double seconds) {
  const std::time_t now = std::time(nullptr), then = now + static_cast<std::time_t>(seconds);
  std::tm today{}, day{};
  localtime_r(&now, &today);
  localtime_r(&then, &day);
  std::array<char, 32> text;
  const bool same_day = today.tm_yday == day.tm_yday && today.tm_year == day.tm_year;
  std::strftime(text.data(), text.size(), same_day ? "%H:%M:%S" : "%Y-%m-%d %H:%M", &day);
  return text.data();
}

}  // namespace

Console::Console(const std::filesystem::path& log, LogMode mode, Telling telling)
    : log_(log, mode == LogMode::begin ? GrowingFile::Begin::anew : GrowingFile::Begin::behind),
      telling_(telling),
      is_terminal_(telling == Telling::terminal && isatty(STDOUT_FILENO) == 1) {}

void Console::print(const std::string& text) {
  clear_progress();
  const std::string line = text.ends_with('\n') ? text : text + "\n";
  if (telling_ == Telling::terminal) {
    std::fputs(line.c_str(), stdout);
    std::fflush(stdout);
  }
  log_.append(line);
}

void Console::show(const std::string& progress) {
  if (!is_terminal_) return;
  clear_progress();
  winsize window{};
  // A line that wraps could not be taken back.
  const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0;
  std::fputs(progress.substr(0, known ? window.ws_col - 1 : progress.size()).c_str(), stdout);
  std::fflush(stdout);
  progress_shown_ = true;
}

void Console::clear_progress() {
  if (progress_shown_) std::fputs("\r\033[K", stdout);
  progress_shown_ = false;
}

double seconds_left(double elapsed, double part) {
  return part > 0 ? std::max(0.0, elapsed * (1 - part) / part) : std::nan("");
}

void Progress::begin(double t, std::uint64_t step) {
  t_begin_ = t;
  step_begin_ = step;
  begin_ = shown_ = Clock::now();
}

bool Progress::due() {
  constexpr std::chrono::milliseconds interval{250};
  const Clock::time_point now = Clock::now();
  if (now - shown_ < interval) return false;
  shown_ = now;
  return true;
}

std::string Progress::line(double t, std::uint64_t step) const {
  const double elapsed = std::chrono::duration<double>(Clock::now() - begin_).count();
  const double part = (t - t_begin_) / (t_end_ - t_begin_);
  const double left = seconds_left(elapsed, part);
  const double particle_steps = static_cast<double>(step - step_begin_) * static_cast<double>(particles_);
  const std::string eta = format_duration(left);
  return fmt::format("{:5.1f} %  t {:.4g}/{:.4g} s  step {}  {:.1f} M particle-steps/s  ETA {}{}",
                     std::min(100.0, 100 * t / t_end_), t, t_end_, step,
                     elapsed > 0 ? 1e-6 * particle_steps / elapsed : 0.0, eta,
                     eta == "-" ? "" : " at " + clock_time(left));
}

}  // namespace geodrop
