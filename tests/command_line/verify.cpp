// geodrop verify: rows, files, exit codes, on a bar that takes a fraction of a second.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "support/calculator.hpp"

using namespace geodrop::test;
using geodrop::read_file;
using geodrop::source_path;

namespace {

/// A scene of two resolutions and a control; `target` and `more` go to its [[verify]].
std::string bar(const geodrop::TemporaryDirectory& directory, const std::string& target, const std::string& more = "") {
  std::string scene = read_file(source_path("cases/elastic_bar.toml"));
  scene.resize(scene.find("[[verify]]"));
  scene += "[[verify]]\nresult = \"period_s\"\nwhat = \"period, first\"\nexpected = 10.0\ntarget = " + target +
           "\nsource = \"4 L \\\"c\\\"\"\n" + more +
           "\n[[variants]]\nname = \"coarse\"\nset = [\"grid.spacing=1.25\"]\n"
           "\n[[variants]]\nname = \"fine\"\nset = [\"grid.spacing=0.625\"]\n"
           "\n[[variants]]\nname = \"finer\"\nset = [\"grid.spacing=0.3125\"]\nin = \"full\"\n"
           "\n[[variants]]\nname = \"softer\"\nset = [\"materials.elastic.youngs_modulus=90\"]\ncontrol = true\n";
  const std::string file = directory / "bar.toml";
  std::ofstream(file) << scene;
  return file;
}

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("Two resolutions and a control: rows, files, pictures, exit code 0") {
  const geodrop::TemporaryDirectory directory;
  const std::string output = directory / "results", scene = bar(directory, "0.0005");
  const Outcome outcome = run_program({"verify", scene, "--full", "--threads", "1", "--output", output});
  CAPTURE(outcome.out);
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(contains(outcome.out,
                 "1 of 1 targets met, 0 coarse: within their quick target, 0 known to be missed, guarded, 0 missed; "
                 "0 of 0 regressions hold; 1 of 1 controls miss the target of their row"));
  const std::string csv = read_file(directory / "results" / "verification.csv");
  CHECK(lines(csv) == 3);
  CHECK(contains(csv, "\"bar\",\"period, first\",\"period_s\",\"s\",10,"));
  CHECK(contains(csv, "\"1.25 0.625 0.312\""));
  CHECK(contains(csv, ",0,\"\",\"yes\",\"4 L 'c'\",\"\",\"\"\n"));
  CHECK(contains(csv, "\"control: softer\""));
  const std::string runs = read_file(directory / "results" / "verification_runs.csv");
  CHECK(lines(runs) == 5);
  CHECK(contains(runs, "\"bar\",\"period_s\",\"fine\",0,0.625,"));
  CHECK(contains(read_file(directory / "results" / "verification.md"), "| bar | period, first | 10 s: 4 L "));
  CHECK(std::filesystem::exists(directory / "results" / "work_precision_others_1.svg"));
  CHECK(std::filesystem::exists(directory / "results" / "bar" / "3" / "summary.json"));
}

TEST_CASE("Quick leaves the runs of full out, and gives the same state on two threads") {
  const geodrop::TemporaryDirectory directory;
  const std::string scene = bar(directory, "0.0005");
  const auto runs = [&](const std::string& threads) {
    const std::string output = directory / threads;
    CHECK(run_program({"verify", scene, "--threads", threads, "--output", output}).code == 0);
    return read_file(directory / threads / "verification_runs.csv");
  };
  const std::string one = runs("1"), two = runs("2");
  CHECK(lines(one) == 4);
  CHECK_FALSE(contains(one, "finer"));
  const auto last_hash = [](const std::string& csv) { return csv.substr(csv.rfind(',')); };
  CHECK(last_hash(one) == last_hash(two));
}

TEST_CASE("A graded grid counts as that of its finest cells") {
  const geodrop::TemporaryDirectory directory;
  const std::string scene = bar(directory, "0.0005"), output = directory / "results";
  std::ofstream(scene, std::ios::app)
      << "\n[[variants]]\nname = \"graded\"\nset = [\"grid.spacing=1.25\", \"grid.refine=[{axis='x', from=5.0, "
         "to=10.0, spacing=0.625}]\"]\n";
  run_program({"verify", scene, "--threads", "1", "--output", output});
  CHECK(contains(read_file(directory / "results" / "verification_runs.csv"),
                 "\"graded\",0,0.624"));  // 0.625 scaled a little
}

TEST_CASE("A target that is missed is exit code 1, unless the scene says why") {
  const geodrop::TemporaryDirectory directory;
  const std::string output = directory / "results";
  const Outcome missed = run_program({"verify", bar(directory, "1e-6"), "--output", output});
  CHECK(missed.code == 1);
  CHECK(contains(missed.out,
                 "0 of 1 targets met, 0 coarse: within their quick target, 0 known to be missed, guarded, 1 missed"));
  const Outcome order =
      run_program({"verify", bar(directory, "0.0005", "least_order = 3.0\n"), "--full", "--output", output});
  CHECK(order.code == 1);
  const Outcome known = run_program(
      {"verify", bar(directory, "1e-6", "shortfall = \"lumped mass\"\nguard = 0.0005\n"), "--output", output});
  CHECK(known.code == 0);
  CHECK(contains(known.out, "known, guarded"));
  CHECK(contains(known.out, "0 of 1 targets met, 0 coarse: within their quick target, 1 known to be missed, guarded"));
  CHECK(contains(read_file(directory / "results" / "verification.md"), "- **bar**, period, first: lumped mass"));
}

TEST_CASE("A guard that is missed is exit code 1, and so is a quick target; a quick target alone makes a row coarse") {
  const geodrop::TemporaryDirectory directory;
  const std::string output = directory / "results";
  const auto verify = [&](const std::string& target, const std::string& more) {
    return run_program({"verify", bar(directory, target, more), "--output", output});
  };
  CHECK(verify("1e-6", "shortfall = \"lumped mass\"\nguard = 1e-5\n").code == 1);
  CHECK(verify("1e-6", "quick_target = 1e-5\n").code == 1);
  const Outcome coarse = verify("1e-6", "quick_target = 0.0005\n");
  CHECK(coarse.code == 0);
  CHECK(contains(coarse.out, "0 of 1 targets met, 1 coarse: within their quick target"));
}

TEST_CASE("A control that breaks is exit code 1, unless the scene foretells its message") {
  const geodrop::TemporaryDirectory directory;
  const auto verify =
      [&](const std::string& breaks) {
        const std::string scene = bar(directory, "0.0005");
        std::ofstream(scene, std::ios::app)
            << "\n[[variants]]\nname = \"turned inside out\"\nset = [\"bodies.bar.initial_velocity.amplitude=50\"]\n"
            << "control = true\n"
            << breaks;
        return run_program({"verify", scene, "--output", directory / "results"});
      };
  const Outcome unforetold = verify("");
  CHECK(unforetold.code == 1);
  CHECK(contains(unforetold.out, "1 of 2 controls"));
  CHECK(verify("breaks = \"has no volume left\"\n").code == 0);
  CHECK(verify("breaks = \"energy grows without cause\"\n").code == 1);
}

TEST_CASE("A control that meets all targets is exit code 1") {
  const geodrop::TemporaryDirectory directory;
  const Outcome outcome = run_program({"verify", bar(directory, "0.2"), "--output", directory / "results"});
  CHECK(outcome.code == 1);
  CHECK(contains(outcome.out, "0 of 1 controls"));
}

TEST_CASE("The generated part of a page is replaced, the rest of it stays") {
  const geodrop::TemporaryDirectory directory;
  const std::string page = directory / "page.md";
  std::ofstream(page) << "before\n<!-- geodrop verify -->\nan earlier table\n<!-- end of geodrop verify -->\nafter\n";
  const std::string scene = bar(directory, "0.0005");
  CHECK(run_program({"verify", scene, "--output", directory / "results", "--page", page}).code == 0);
  const std::string text = read_file(page);
  CHECK(text.starts_with("before\n<!-- geodrop verify -->\n1 of 1 targets met"));
  CHECK(text.ends_with("\n<!-- end of geodrop verify -->\nafter\n"));
  CHECK_FALSE(contains(text, "an earlier table"));
  CHECK(contains(read_file(directory / "page/rows.md"), "| bar | period, first | 10 s: 4 L "));
  std::ofstream(page) << "no marks\n";
  const Outcome refused = run_program({"verify", scene, "--output", directory / "results", "--page", page});
  CHECK(refused.code == 1);
  CHECK(contains(refused.err, "the page has no lines \"<!-- geodrop verify -->\""));
}

TEST_CASE("What cannot be verified is refused before anything runs") {
  const geodrop::TemporaryDirectory directory;
  const std::string scene = bar(directory, "0.0005");
  const Outcome none = run_program({"verify", scene, "--only", "beam", "--output", directory / "results"});
  CHECK(none.code == 2);
  CHECK(none.out.empty());
  CHECK(contains(none.err,
                 "geodrop verify: --only: found \"beam\", which is in the name of none of 1 cases; allowed: a part "));
  check_refused(run_program({"verify", scene, "--output", directory / ""}),
                "--output: found a directory with other files in it; allowed: a new directory or one of an earlier "
                "geodrop verify");
  CHECK(run_program({"verify", scene, "--quick", "--full"}).code == 2);
  CHECK(run_program({"verify", directory / "none.toml", "--output", directory / "results"}).code == 2);
}
