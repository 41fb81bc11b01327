// Scenes of cases/validation, coarser than they are there, beside published numbers.
#include <doctest/doctest.h>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop::test;

TEST_CASE("Water pushes a wedge that enters it as the similarity solution of Zhao and Faltinsen says") {
  const SceneRun run("cases/validation/wedge_entry.toml",
                     {"grid.refine.0.spacing=0.1", "grid.refine.1.spacing=0.1", "grid.lower=[-12.0, -12.0]",
                      "grid.upper=[12.0, 2.0]", "materials.water.sound_speed=50.0",
                      "bodies.water.shape={ type = 'box', lower = [-12.0, -12.0], upper = [12.0, 0.0] }"});
  REQUIRE(run.outcome().code == 0);
  CHECK(run.result("force_over_rho_v3_t_ratio") == near(14.139, 0.04));  // measured 13.86
}
