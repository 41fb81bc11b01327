// Another program: what it says, how it ends, and that a wait for it ends.
#include "plot/ask_program.hpp"

#include <doctest/doctest.h>

#include <chrono>

using namespace geodrop;
using namespace std::chrono_literals;

TEST_CASE("What a program says on both outputs, and its code") {
  const Answer answer = ask_program({"sh", "-c", "echo one; echo two >&2; cat; exit 3"}, 20s);
  CHECK(answer.said == "one\ntwo\n");
  CHECK(answer.code == 3);
  CHECK_FALSE(answer.timed_out);
}

TEST_CASE("Words are words: no shell reads them") {
  CHECK(ask_program({"echo", "$(id); 'a b'"}, 20s).said == "$(id); 'a b'\n");
  CHECK(ask_program({"no_such_program_anywhere"}, 20s).code == exit_not_found);
}

TEST_CASE("A program that does not end is ended, with what it started") {
  const auto start = std::chrono::steady_clock::now();
  const Answer answer = ask_program({"sh", "-c", "echo begun; sleep 100"}, 300ms);
  CHECK(answer.timed_out);
  CHECK(answer.said == "begun\n");
  CHECK(answer.code == -1);
  CHECK(std::chrono::steady_clock::now() - start < 10s);  // of 100 that it would sleep; the machine may be busy
}
