// Another program, run to its end or to a time limit.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace geodrop {

/// What a program said, on both of its outputs, and how it ended.
struct Answer {
  std::string said;
  int code = -1;           ///< its exit code; -1: ended by a signal
  bool timed_out = false;  ///< it was ended because it took too long
};

/// The code of what could not be started, as a shell has it.
inline constexpr int exit_not_found = 127;

/// Runs `words`, the program first, looked up as a shell does; no shell is between. It reads nothing, and goes when
/// this process goes. Throws RunError if no process can be made.
Answer ask_program(const std::vector<std::string>& words, std::chrono::milliseconds limit);

}  // namespace geodrop
