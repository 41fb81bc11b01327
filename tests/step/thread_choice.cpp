#include "step/thread_choice.hpp"

#include <doctest/doctest.h>

#include <functional>

using namespace geodrop;

namespace {

/// Duration of a step by number of threads and time [s].
using Machine = std::function<double(int, double)>;

/// The time for `seconds` of the best steps, over that time: what trials and wrong choices cost.
double cost(ThreadChoice& choice, const Machine& machine, double seconds, int most) {
  double clock = 0, best = 0;
  while (clock < seconds) {
    double fastest = machine(1, clock);
    for (int count = 2; count <= most; ++count) fastest = std::min(fastest, machine(count, clock));
    const double took = machine(choice.threads(), clock);
    choice.took(took);
    clock += took;
    best += fastest;
  }
  return clock / best;
}

}  // namespace

TEST_CASE("Of threads that share the work all are taken") {
  ThreadChoice choice(2);
  CHECK(choice.threads() == 2);
  CHECK(cost(
            choice, [](int n, double) { return 0.01 / n; }, 60, 2) < 1.01);
  CHECK(choice.threads() == 2);
}

TEST_CASE("Where a second thread makes steps slower one is taken") {
  ThreadChoice choice(2);
  CHECK(cost(
            choice, [](int n, double) { return n == 1 ? 2e-4 : 5e-4; }, 60, 2) < 1.01);
  CHECK(choice.threads() == 1);
}

TEST_CASE("Of many threads those are taken that are fastest") {
  ThreadChoice choice(16);
  const Machine machine = [](int n, double) { return 0.01 / n + 0.0006 * n; };  // best with 4
  CHECK(cost(choice, machine, 60, 16) < 1.02);
  CHECK(choice.threads() == 4);
}

TEST_CASE("Programs that come and go are noticed") {
  ThreadChoice choice(2);
  // Two threads wait for each other twenty times as long while the machine is busy, from 20 to 60 s.
  const Machine machine = [](int n, double t) {
    const bool busy = t > 20 && t < 60;
    return n == 1 ? (busy ? 0.015 : 0.01) : (busy ? 0.2 : 0.006);
  };
  CHECK(cost(choice, machine, 19, 2) < 1.02);
  CHECK(choice.threads() == 2);
  ThreadChoice whole(2);
  CHECK(cost(whole, machine, 180, 2) < 1.15);
  CHECK(whole.threads() == 2);
  CHECK(whole.text().starts_with("threads: 2 in "));
  CHECK(whole.text().find(" % of the steps, 1 in ") != std::string::npos);
}

TEST_CASE("A machine that gets busy after minutes of quiet is noticed within seconds") {
  ThreadChoice choice(2);
  const Machine quiet = [](int n, double) { return n == 1 ? 0.01 : 0.006; };
  const Machine busy = [](int n, double) { return n == 1 ? 0.015 : 0.2; };
  cost(choice, quiet, 200, 2);  // by now it would try one thread every 30 s only
  CHECK(choice.threads() == 2);
  cost(choice, busy, 5, 2);
  CHECK(choice.threads() == 1);
}

TEST_CASE("Of one thread there is nothing to choose") {
  ThreadChoice choice(1);
  for (int step = 0; step < 100; ++step) choice.took(step % 7 == 0 ? 1.0 : 0.01);
  CHECK(choice.threads() == 1);
  CHECK(choice.text() == "threads: 1 in 100 % of the steps");
}
