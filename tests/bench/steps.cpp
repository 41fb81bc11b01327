// What versions of the program tell each other about their steps, and programs that are run for it.
#include "bench/steps.hpp"

#include "bench/child.hpp"

#include "support/near.hpp"
#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop;
using namespace geodrop::test;

TEST_CASE("The lines of bench --steps are read back") {
  const StepReport report = parse_steps("build g++ 12.2.0 x86-64-v3\nsteps water_2d 1936 16 0.00125\n");
  CHECK(report.build == "g++ 12.2.0 x86-64-v3");
  REQUIRE(report.times.size() == 1);
  CHECK(report.times[0].name == "water_2d");
  CHECK(report.times[0].particles == 1936);
  CHECK(report.times[0].steps == 16);
  CHECK(report.times[0].seconds == 0.00125);
  CHECK_THROWS_WITH(parse_steps("steps water_2d many 16 1\n"), doctest::Contains("steps water_2d many"));
  CHECK_THROWS_WITH(parse_steps("hello\n"), doctest::Contains("hello"));
}

TEST_CASE("A benchmark is asked for by a part of its name, or by = and all of it") {
  BenchOptions options;
  CHECK(selected(options, "water_2d_linear"));
  options.only = "water_2d";
  CHECK(selected(options, "water_2d_linear"));
  CHECK_FALSE(selected(options, "soil_2d_linear"));
  options.only = "=water_2d_linear";
  CHECK(selected(options, "water_2d_linear"));
  CHECK_FALSE(selected(options, "water_2d_linear_cell"));
}

TEST_CASE("bench --steps makes the steps of one block and of one scene") {
  for (const std::string name : {"water_2d_linear", "bed_3d"}) {
    const Outcome outcome = run_program({"bench", "--steps", "3", "--particles", "1000", "--only", "=" + name});
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    const StepReport report = parse_steps(outcome.out);
    CHECK(report.build == build_name());
    REQUIRE(report.times.size() == 1);
    CHECK(report.times[0].name == name);
    CHECK(report.times[0].steps == 3);
    CHECK(report.times[0].particles > 900);
    CHECK(report.times[0].seconds > 0);
  }
}

TEST_CASE("A child's words, exit code and processor time come back") {
  const ChildOutcome outcome = run_child(
      {"sh", "-c", "echo $OMP_WAIT_POLICY; echo lost >&2; n=0; while [ $n -lt 20000 ]; do n=$((n+1)); done; exit 3"},
      ChildErrors::drop);
  CHECK(outcome.code == 3);
  CHECK(outcome.out == "passive\n");
  CHECK(outcome.processor_seconds > 0.001);
  CHECK(outcome.processor_seconds < 10);
  CHECK(run_child({"no_such_program_of_geodrop"}).code == no_such_program);
}

TEST_CASE("A version that is no program and no commit or a benchmark that is not there ends with 2") {
  const Outcome nothing = run_program({"bench", "--against", "no_such_commit"});
  CHECK(nothing.code == 2);
  CHECK(contains(nothing.err, "no_such_commit: --against: found no such program, and no commit that can be built"));
  const Outcome unknown = run_program({"bench", "--against", program_path, "--only", "honey"});
  CHECK(unknown.code == 2);
  CHECK(contains(unknown.err, "no benchmark is called 'honey'"));
}
