#include "ask_program.hpp"

#include <geodrop/base/error.hpp>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace geodrop {
namespace {

using Clock = std::chrono::steady_clock;

/// In the new process, where only what a signal handler may do is safe.
[[noreturn]] void become(char* const* words, int output) {
  setpgid(0, 0);  // with what it starts, so that all of it can be ended
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execvp(words[0], words);
  _exit(exit_not_found);
}

/// Until the other end closes; false if that took longer than `until`.
bool read_until(Clock::time_point until, int from, std::string& said) {
  std::array<char, 4096> block;
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
    if (left <= 0) return false;
    pollfd ready{from, POLLIN, 0};
    if (poll(&ready, 1, static_cast<int>(left)) <= 0) continue;  // in vain, or a signal came
    const ssize_t count = read(from, block.data(), block.size());
    if (count == 0) return true;
    if (count > 0) said.append(block.data(), static_cast<std::size_t>(count));
    if (count < 0 && errno != EINTR) return true;
  }
}

int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

Answer ask_program(const std::vector<std::string>& words, std::chrono::milliseconds limit) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  std::array<int, 2> ends{-1, -1};
  const bool piped = pipe2(ends.data(), O_CLOEXEC) == 0;
  const pid_t process = piped ? fork() : -1;
  if (process < 0) {
    const std::string why = std::strerror(errno);
    for (const int end : ends)
      if (end >= 0) close(end);
    throw RunError("cannot start " + words.front() + ": " + why);
  }
  if (process == 0) become(pointers.data(), ends[1]);
  close(ends[1]);
  Answer answer;
  answer.timed_out = !read_until(Clock::now() + limit, ends[0], answer.said);
  close(ends[0]);
  if (answer.timed_out) {
    kill(-process, SIGKILL);
    kill(process, SIGKILL);  // if it had no time to make a group of its own
  }
  answer.code = wait_for(process);
  return answer;
}

}  // namespace geodrop
