// Another program, run to its end.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <string>
#include <vector>

namespace geodrop {

inline constexpr int no_such_program = 127;

/// What a program said and took. Code `no_such_program`: there is none.
struct ChildOutcome {
  int code = 0;  ///< exit code; 128 + signal if a signal ended it
  double processor_seconds = 0;
  std::string out;
};

enum class ChildErrors { show, drop };

/// Runs a program of the search path, or at a path, and waits. Its threads wait passively, which spares geodrop a
/// restart. A terminal's Ctrl-C does not reach it; it is asked to stop (SIGHUP) when this process ends. `process` holds
/// its number while it runs, else 0.
ChildOutcome run_child(const std::vector<std::string>& words, ChildErrors errors = ChildErrors::show,
                       std::atomic<pid_t>* process = nullptr);

/// The file of this program.
std::string own_program();

}  // namespace geodrop
