// How far off a control has to be: beyond a target, not just off the reference.
#include <doctest/doctest.h>

#include "verify/judge.hpp"

using namespace geodrop;

namespace {

/// The verdict on a control whose height is `error` off 4 m, for a target of 0.1.
Verdict verdict_on(double error) {
  VerifySpec height;
  height.result = "height_m";
  height.expected = 4;
  height.target = 0.1;
  Scene scene;
  scene.file = "cases/tower.toml";
  scene.verify = {height};
  VariantRun run;
  run.spacing = 0.1;
  run.results = {{"height_m", 4, "m"}};
  VariantRun control = run;
  control.name = "too soft";
  control.control = true;
  control.results = {{"height_m", 4 * (1 + error), "m"}};
  return judge(scene, {run, control}, VerifyMode::full).at(1).verdict;
}

}  // namespace

TEST_CASE("A control that is off by less than the target shows nothing") {
  CHECK(verdict_on(0.09) == Verdict::missed);
  CHECK(verdict_on(-0.09) == Verdict::missed);
  CHECK(verdict_on(0.11) == Verdict::met);
  CHECK(verdict_on(-0.11) == Verdict::met);
}
