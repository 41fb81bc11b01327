// Jobs side by side: all run, and the error of the first of them is told, on any number of threads.
#include "base/side_by_side.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <stdexcept>

using geodrop::run_side_by_side;

TEST_CASE("Every job runs once, together or one after the other") {
  for (const bool apart : {true, false}) {
    std::vector<int> runs(7, 0);
    std::vector<std::function<void()>> jobs;
    for (int& count : runs) jobs.emplace_back([&count] { ++count; });
    run_side_by_side(jobs, apart);
    CHECK(runs == std::vector<int>(7, 1));
  }
  run_side_by_side({}, true);
}

TEST_CASE("The error of the first job that fails is thrown when all have ended") {
  for (const bool apart : {true, false}) {
    std::atomic<int> ended = 0;
    const auto fails = [](const char* why) { return [why] { throw std::runtime_error(why); }; };
    const auto ends = [&] { ++ended; };
    CHECK_THROWS_WITH_AS(run_side_by_side({ends, fails("second"), fails("third"), ends}, apart), "second",
                         std::runtime_error);
    CHECK(ended == 2);
  }
}
