// Scenes of cases/validation, coarser than they are there, beside published numbers.
#include <doctest/doctest.h>

#include "support/near.hpp"
#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;

TEST_CASE("Water pushes a wedge that enters it as the similarity solution of Zhao and Faltinsen says") {
  const SceneRun run("cases/validation/wedge_entry.toml",
                     {"grid.refine.0.spacing=0.1", "grid.refine.1.spacing=0.1", "grid.lower=[-12.0, -12.0]",
                      "grid.upper=[12.0, 2.0]", "materials.water.sound_speed=50.0",
                      "bodies.water.shape={ type = 'box', lower = [-12.0, -12.0], upper = [12.0, 0.0] }"});
  REQUIRE(run.outcome().code == 0);
  CHECK(run.result("force_over_rho_v3_t_ratio") == near(14.139, 0.04));  // measured 13.86
}

TEST_CASE("Friction along a rough plate after half of its length, in cells four times as long as high") {
  const SceneRun run("cases/validation/flat_plate.toml",
                     {"grid.refine.0.spacing=0.25", "time.end=5.0", "results.friction_coefficient_ratio.from=4.0",
                      "results.friction_coefficient_ratio.scale=0.1"});
  REQUIRE(run.outcome().code == 0);
  CHECK(!contains(run.outcome().out + run.outcome().err, "were not found"));
  CHECK(run.result("friction_coefficient_ratio") == near(0.00629, 0.2));  // Prandtl and Schlichting, of the whole plate
}
