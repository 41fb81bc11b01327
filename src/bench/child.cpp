#include "child.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace geodrop {
namespace {

[[noreturn]] void become(std::vector<char*>& words, int out, ChildErrors errors) {
  setpgid(0, 0);
  // Not SIGTERM: it comes once for each thread of the parent that ends, and a second SIGTERM is obeyed at once.
  signal(SIGHUP, SIG_DFL);
  prctl(PR_SET_PDEATHSIG, SIGHUP);
  setenv("OMP_WAIT_POLICY", "passive", 1);
  dup2(out, STDOUT_FILENO);
  if (errors == ChildErrors::drop) dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
  execvp(words.front(), words.data());
  _exit(no_such_program);
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ChildOutcome run_child(const std::vector<std::string>& words, ChildErrors errors, std::atomic<pid_t>* process) {
  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe to " + words.front());
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start " + words.front());
  if (child == 0) become(arguments, ends[1], errors);
  if (process) *process = child;
  close(ends[1]);
  ChildOutcome outcome;
  char text[4096];
  for (ssize_t count = read(ends[0], text, sizeof text); count > 0; count = read(ends[0], text, sizeof text))
    outcome.out.append(text, static_cast<std::size_t>(count));
  close(ends[0]);
  int status = 0;
  rusage used{};
  while (wait4(child, &status, 0, &used) < 0 && errno == EINTR) continue;
  if (process) *process = 0;
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.processor_seconds = seconds(used.ru_utime) + seconds(used.ru_stime);
  return outcome;
}

std::string own_program() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

}  // namespace geodrop
