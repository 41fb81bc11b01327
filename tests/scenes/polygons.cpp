// Boxes, polygons and polylines as rigid bodies: a ramp, a weight on a box, water in a basin.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop::test;

namespace {

/// Of the rows from the time on.
double mean_from(const SceneRun& run, const std::string& column, double from) {
  const auto t = run.column("time_s"), values = run.column(column);
  double sum = 0, rows = 0;
  for (std::size_t k = 0; k < t.size(); ++k)
    if (t[k] >= from) sum += values[k], rows += 1;
  return sum / rows;
}

}  // namespace

TEST_CASE("A block slides on a ramp that is a polygon, or a polyline, as on a half-plane") {
  const SceneRun plane("cases/block_on_incline.toml",
                       {"time.end=0.4", "results=[]", "expect=[]", "verify=[]", "variants=[]"});
  REQUIRE(plane.outcome().code == 0);
  const double expected = plane.column("block.velocity_x_m_s").back();
  for (const std::string shape :
       {"{type='polygon',points=[[-1.7320508075688772,1.0],[3.4641016151377544,-2.0],[-1.7320508075688772,-2.0]]}",
        // The line lies its half thickness below the slope.
        "{type='polyline',points=[[-1.7820508075688772,0.9133974596215561],[3.4141016151377544,-2.0866025403784437]],"
        "radius=0.1}"}) {
    CAPTURE(shape);
    const SceneRun run("cases/block_on_incline.toml", {"time.end=0.4", "results=[]", "expect=[]", "verify=[]",
                                                       "variants=[]", "rigid.slope.shape=" + shape});
    REQUIRE(run.outcome().code == 0);
    CHECK(run.column("block.velocity_x_m_s").back() == near(expected, 1e-6));
  }
}

TEST_CASE("A block at rest on a box presses on it with its weight, m g") {
  const SceneRun run("tests/scenes/block.toml", {"rigid.ground.shape={type='box',lower=[-1.0,-0.4],upper=[1.0,0.0]}"});
  REQUIRE(run.outcome().code == 0);
  const double weight = 9.81 * run.column("total.mass_kg").back();
  CHECK(run.column("skin.ground.normal_force_y_N_m").back() ==
        near(weight, 0.02));  // the out-of-balance ratio asked for
  CHECK(std::abs(run.column("skin.ground.normal_force_x_N_m").back()) < 1e-3 * weight);
}

TEST_CASE("Water comes to rest in a basin that is a polygon, bears on it with its weight and stays inside") {
  const SceneRun run("cases/verification/polygon_basin.toml", {"grid.spacing=0.125", "time.end=4.0"});
  CAPTURE(run.outcome().err);
  REQUIRE(run.outcome().code == 0);
  const double weight = 9.81 * run.column("total.mass_kg").back();
  CHECK(mean_from(run, "water.basin.normal_force_y_N_m", 3) == near(weight, 0.01));
  CHECK(std::abs(mean_from(run, "water.basin.normal_force_x_N_m", 3)) < 0.01 * weight);
  CHECK(mean_from(run, "water.velocity_rms_m_s", 3) < 0.05);
  CHECK(run.column("water.lowest_m").back() > 0);
}
