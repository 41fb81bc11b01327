// Lines for the user and run.log, and the progress line below them on a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <geodrop/files/output.hpp>
#include <string>

#include "base/growing_file.hpp"

namespace geodrop {

enum class LogMode { begin, append };

class Console {
 public:
  /// Throws WriteError if run.log cannot be opened.
  Console(const std::filesystem::path& log, LogMode mode, Telling telling);
  /// To run.log and, unless it is all for the log, the terminal (or wherever the output goes). A terminal or a pipe
  /// that is gone is no concern of a run.
  void print(const std::string& text);
  /// Why run.log was not written; empty if it was.
  const std::string& failure() const { return log_.failure(); }
  /// Replaces the progress line; does nothing where the output is no terminal.
  void show(const std::string& progress);
  bool is_terminal() const { return is_terminal_; }

 private:
  void clear_progress();

  GrowingFile log_;
  Telling telling_;
  bool is_terminal_;
  bool progress_shown_ = false;
};

/// Wall time that is left [s] if `part` of the run took `elapsed`; NaN if nothing is done yet.
double seconds_left(double elapsed, double part);

/// How far a run is, how fast, and when it will end.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  Progress(double t_end, std::size_t particles) : t_end_(t_end), particles_(particles) {}
  /// The run starts (or goes on) here.
  void begin(double t, std::uint64_t step);
  /// True a few times a second.
  bool due();
  /// Particles times steps per second, ETA in hours:minutes:seconds, and the wall-clock time of the end, in 80 columns:
  /// "42.3 %  t 2.961/7 s  step 12345  23.4 M particle-steps/s  ETA 0:34 at 14:32:10"
  std::string line(double t, std::uint64_t step) const;

 private:
  double t_end_;
  std::size_t particles_;
  double t_begin_ = 0;
  std::uint64_t step_begin_ = 0;
  Clock::time_point begin_ = Clock::now(), shown_ = begin_;
};

}  // namespace geodrop
