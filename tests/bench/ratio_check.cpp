// The judging of speed, on made-up numbers: nothing here is timed.
#include "bench/ratio_check.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <limits>

#include "support/scene_files.hpp"

using namespace geodrop;

namespace {

/// Judges ratios that come one after the other.
RatioVerdict judge(double committed, double loss, const std::vector<double>& measured) {
  std::size_t next = 0;
  return judge_ratio(committed, loss, [&] { return measured.at(next++); });
}

std::filesystem::path write(const TemporaryDirectory& directory, const std::string& name, const std::string& text) {
  std::ofstream(directory / name) << text;
  return directory / name;
}

}  // namespace

TEST_CASE("a ratio within 10 % of the committed one is good at the first try") {
  const RatioVerdict verdict = judge(0.5, 0.1, {0.451});
  CHECK_FALSE(verdict.lost);
  CHECK(verdict.tries == 1);
  CHECK(verdict.best == 0.451);
}

TEST_CASE("a ratio that seems lost is measured again, and one good try suffices") {
  const RatioVerdict verdict = judge(0.5, 0.1, {0.2, 0.44, 0.46});
  CHECK_FALSE(verdict.lost);
  CHECK(verdict.tries == 3);
  CHECK(verdict.best == 0.46);
}

TEST_CASE("three tries below the limit are a loss, and there is no fourth") {
  const RatioVerdict verdict = judge(0.5, 0.1, {0.449, 0.2, 0.44, 0.5});
  CHECK(verdict.lost);
  CHECK(verdict.tries == 3);
  CHECK(verdict.best == 0.449);
}

TEST_CASE("what is no number is a loss") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(judge(0.5, 0.1, {nan, nan, nan}).lost);
}

TEST_CASE("a wider tolerance takes a smaller ratio") {
  CHECK_FALSE(judge(0.5, 0.5, {0.26}).lost);
  CHECK(judge(0.5, 0.5, {0.24, 0.24, 0.24}).lost);
}

TEST_CASE("ratios are found by name, particles and threads, whatever the order of the columns") {
  const TemporaryDirectory directory;
  const auto file = write(directory, "ratios.csv",
                          "threads,name,ratio,extra,particles,processor\n"
                          "1,water,0.5,x,1000,A\n2,water,0.6,x,1000,A\n1,water,0.7,x,2000,A\n");
  const std::vector<CommittedRatio> ratios = read_ratios(file);
  REQUIRE(ratios.size() == 3);
  REQUIRE(find_ratio(ratios, {"water", "", 1000, 2, 0}));
  CHECK(find_ratio(ratios, {"water", "", 1000, 2, 0})->ratio == 0.6);
  CHECK(find_ratio(ratios, {"water", "", 2000, 1, 0})->ratio == 0.7);
  CHECK(find_ratio(ratios, {"soil", "", 1000, 1, 0}) == nullptr);
  CHECK(find_ratio(ratios, {"water", "", 2000, 2, 0}) == nullptr);
}

TEST_CASE("a broken table of ratios is refused with file and line") {
  const TemporaryDirectory directory;
  const std::string head = "name,processor,particles,threads,ratio\n";
  CHECK_THROWS_WITH(read_ratios(directory / "absent.csv"),
                    doctest::Contains("absent.csv: --check: found no such file"));
  CHECK_THROWS_WITH(read_ratios(write(directory, "a.csv", "name,particles,threads,ratio\n")),
                    doctest::Contains("a.csv:1:1: --check: found no column processor"));
  for (const char* row : {"water,A,1000,1", "water,A,many,1,0.5", "water,A,1000,1,0", "water,A,1000,1,nan"})
    CHECK_THROWS_WITH(read_ratios(write(directory, "b.csv", head + "water,A,1,1,1\n" + row + "\n")),
                      doctest::Contains("b.csv:3:1: --check: found water"));
}

TEST_CASE("the ratios of this processor are preferred, else the first file serves") {
  const TemporaryDirectory directory;
  const std::string head = "name,processor,particles,threads,ratio\nwater,";
  const auto a = write(directory, "a.csv", head + "A,1,1,1\n"), b = write(directory, "b.csv", head + "B,1,1,1\n");
  CHECK(choose_ratios({b, a}, "B") == b);
  CHECK(choose_ratios({b, a}, "A") == a);
  CHECK(choose_ratios({b, a}, "C") == a);
  CHECK(choose_ratios({}, "A").empty());
}
