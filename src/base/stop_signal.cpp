#include <unistd.h>

#include <atomic>
#include <csignal>
#include <geodrop/base/stop_signal.hpp>

namespace geodrop {
namespace {

// A signal handler reaches nothing but a global.
std::atomic<int> interrupts_seen{0};
std::atomic<bool> stop{false}, checkpoint{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free,
              "a signal handler must not lock");

extern "C" void interrupt(int) {
  constexpr int exit_interrupted = 130;  // as a shell reports an end by SIGINT
  if (interrupts_seen.fetch_add(1) > 0) _exit(exit_interrupted);
  stop = true;
}

// A terminal that closes sends it twice, by the shell and by the system: no second one may end the program.
extern "C" void hang_up(int) { stop = true; }

extern "C" void ask_for_checkpoint(int) { checkpoint = true; }

void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;  // a write that is under way goes on
  sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal) {
  struct sigaction present {};
  sigaction(signal, nullptr, &present);
  return present.sa_handler == SIG_IGN;
}

}  // namespace

void catch_signals() {
  handle(SIGINT, interrupt);
  handle(SIGTERM, interrupt);
  if (!is_ignored(SIGHUP)) handle(SIGHUP, hang_up);
  handle(SIGUSR1, ask_for_checkpoint);
  handle(SIGPIPE, SIG_IGN);
  handle(SIGXFSZ, SIG_IGN);
}

bool stop_requested() { return stop.load(std::memory_order_relaxed); }

bool take_checkpoint_request() { return checkpoint.load(std::memory_order_relaxed) && checkpoint.exchange(false); }

}  // namespace geodrop
