// `check` and `info`: mistakes that need the whole scene, and notes.
#include "support/program.hpp"
#include "support/text.hpp"

#include <doctest/doctest.h>

using namespace geodrop::test;

TEST_CASE("check finds the mistyped column of a result, which a run would refuse") {
  const std::string scene = geodrop::source_path("cases/elastic_bar.toml");
  const Outcome right = run_program({"check", scene});
  CHECK(right.code == 0);
  CHECK(contains(right.out, "no mistakes found"));
  CHECK_FALSE(contains(right.out, "note:"));
  const Outcome wrong = run_program({"check", scene, "--set", "results.0.column=middle.displacemnt_x_m"});
  CHECK(wrong.code == 2);
  CHECK(contains(wrong.err, "nearest: \"middle.displacement_x_m\""));
}

TEST_CASE("check, info and run tell of drained soil under water") {
  const std::string scene = geodrop::source_path("cases/ellipse_release.toml");
  const std::string note = "note: body \"ellipse\" is drained: without pore water";
  const Outcome check = run_program({"check", scene});
  CHECK(check.code == 0);
  CHECK(contains(check.out, note));
  const std::vector<std::string> coarse{"grid.spacing=0.5", "time.end=0.001"};
  const Outcome info = run_program({"info", scene, "--set", coarse[0]});
  CHECK(contains(info.out, note));
  CHECK(contains(SceneRun("cases/ellipse_release.toml", coarse).outcome().out, note));
}
