#include <unistd.h>

#include <atomic>
#include <csignal>
#include <geodrop/stop_signal.hpp>

namespace geodrop {
namespace {

// A signal handler reaches nothing but a global.
std::atomic<int> signals_seen{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler must not lock");

extern "C" void count_signal(int) {
  constexpr int exit_interrupted = 130;  // as a shell reports an end by SIGINT
  if (signals_seen.fetch_add(1) > 0) _exit(exit_interrupted);
}

}  // namespace

void catch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = count_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;  // a write that is under way goes on
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool stop_requested() { return signals_seen.load(std::memory_order_relaxed) > 0; }

}  // namespace geodrop
