// Sloshing water against linear wave theory, and what the paper's element makes of it with and without its cure.
#include <doctest/doctest.h>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop::test;

namespace {

/// Swing of the centre of mass over its exact value.
struct Swing {
  double right, one_period, two_periods;
};

Swing swing(const std::vector<std::string>& settings) {
  std::vector<std::string> all{"grid.spacing=0.0625"};
  all.insert(all.end(), settings.begin(), settings.end());
  const SceneRun run("cases/sloshing.toml", all);
  return {(run.result("centre_right_m") - 0.5) / 0.006501, (0.5 - run.result("centre_after_one_period_m")) / 0.006596,
          (0.5 - run.result("centre_after_two_periods_m")) / 0.006504};
}

Swing papers_element(const std::string& pressure) {
  return swing({"grid.basis=tri3", "solver.transfer=musl", "solver.blend_rate=100", "bodies.water.shift=false",
                "bodies.water.shift_speed=", "bodies.water.pressure=" + pressure});
}

}  // namespace

TEST_CASE("Water keeps 9 tenths of its swing over two periods on 16 cells") {
  const Swing water = swing({});  // 0.99, 0.95, 0.92 measured
  CHECK(water.right == near(1, 0.02));
  CHECK(water.one_period == near(1, 0.07));
  CHECK(water.two_periods == near(1, 0.1));
}

TEST_CASE("The paper's element locks without its cure, and does not with it") {
  const Swing locked = papers_element("particle"), cured = papers_element("nodal");
  CHECK(locked.right < 0.3);  // 0.16 measured
  CHECK(locked.one_period < 0.4);
  CHECK(cured.right > 0.8);  // 0.90 measured
}

TEST_CASE("Hats and GIMP slosh with MUSL as splines do") {
  for (const std::string basis : {"gimp", "linear"}) {
    CAPTURE(basis);
    const Swing water = swing({"grid.basis=" + basis, "solver.transfer=musl"});
    CHECK(water.right == near(1, 0.1));  // 0.93 measured with hats
    CHECK(water.one_period > 0.7);
  }
}
