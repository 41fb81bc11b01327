// The table of instruction counts: planted changes, files, what callgrind writes. Nothing is counted here.
#include "bench/instructions.hpp"

#include <geodrop/base/error.hpp>

#include <fstream>

#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

const std::string build = "g++ 12.2.0 x86-64-v3";
const std::string head = "name,build,particles,steps,instructions\n";

InstructionCount water(double instructions) { return {"water_2d", build, 1936, 16, instructions}; }

InstructionVerdict compare(const InstructionCount& counted, const InstructionCount& committed) {
  return compare_instructions({counted}, {committed}).front();
}

std::filesystem::path write(const TemporaryDirectory& directory, const std::string& text) {
  std::ofstream(directory / "instructions.csv") << text;
  return directory / "instructions.csv";
}

}  // namespace

TEST_CASE("Two percent more instructions are more, 0.9 percent are not") {
  CHECK(compare(water(408), water(400)).more());
  CHECK(compare(water(408), water(400)).change() == near(0.02, 1e-12));
  CHECK_FALSE(compare(water(403.6), water(400)).more());
  CHECK_FALSE(compare(water(403.6), water(400)).fewer());
}

TEST_CASE("Two percent fewer instructions are said, and are no failure") {
  CHECK(compare(water(392), water(400)).fewer());
  CHECK_FALSE(compare(water(392), water(400)).more());
}

TEST_CASE("What is no number is more") { CHECK(compare(water(std::nan("")), water(400)).more()); }

TEST_CASE("Counts of another build, size or number of steps are not compared") {
  for (const InstructionCount& other : {InstructionCount{"water_2d", "g++ 13.1.0 x86-64-v3", 1936, 16, 400},
                                        {"water_3d", build, 1936, 16, 400},
                                        {"water_2d", build, 1937, 16, 400},
                                        {"water_2d", build, 1936, 17, 400}}) {
    const InstructionVerdict verdict = compare(water(800), other);
    CHECK_FALSE(verdict.committed);
    CHECK_FALSE(verdict.more());
  }
}

TEST_CASE("An update replaces its own rows and keeps those of other builds") {
  const InstructionCount other{"water_2d", "g++ 13.1.0 x86-64-v3", 1936, 16, 390},
      soil{"soil_2d", build, 1936, 16, 500};
  const std::vector<InstructionCount> merged = merge_instructions({water(400), other}, {water(420), soil});
  REQUIRE(merged.size() == 3);
  CHECK(merged[0].per_particle_step == 420);
  CHECK(merged[1].per_particle_step == 390);
  CHECK(merged[2].name == "soil_2d");
}

TEST_CASE("A table is read as it was written; none is empty") {
  const TemporaryDirectory directory;
  CHECK(read_instructions(directory / "absent.csv").empty());
  write_instructions(directory / "instructions.csv", {water(401.25)});
  const std::vector<InstructionCount> rows = read_instructions(directory / "instructions.csv");
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].same_work(water(1)));
  CHECK(rows[0].per_particle_step == 401.25);
}

TEST_CASE("A broken table is refused with file and line") {
  const TemporaryDirectory directory;
  CHECK_THROWS_WITH(read_instructions(write(directory, "name,count\n")),
                    doctest::Contains("instructions.csv:1:1: --instructions: found name,count"));
  for (const char* row : {"water,A,1000,1", "water,A,many,1,400", "water,A,1000,1,0", "water,A,1000,1,nan"})
    CHECK_THROWS_WITH(read_instructions(write(directory, head + "water,A,1,1,1\n" + row + "\n")),
                      doctest::Contains("instructions.csv:3:1: --instructions: found water"));
}

TEST_CASE("Instructions of a dump are those of its functions, calls once, the allocator's left out") {
  const std::string step = "fl=(1) step.cpp\nfn=(1) step\n7 100\n+1 20\n";
  const std::string call = "cfi=(2) ./malloc/malloc.c\ncfn=(2) malloc\ncalls=3 0\n* 40\n";
  const std::string allocator = "fl=(2)\nfn=(2)\n0 30\nfe=(3) arena.c\n0 10\n";
  CHECK(instructions_in("version: 1\nevents: Ir\nsummary: 120\n\n" + step) == 120);
  CHECK(instructions_in("events: Ir\n\n" + step + call + "-2 3\n\n" + allocator + "\ntotals: 163\n") == 123);
  CHECK(instructions_in("events: Ir\n\nfl=(5) malloc.c\nfn=(2) malloc\n0 30\n\nfl=(1) a.cpp\nfn=(1) a\n0 5\n") == 5);
  CHECK_THROWS_WITH(instructions_in("version: 1\n"), "callgrind wrote no counts");
}
