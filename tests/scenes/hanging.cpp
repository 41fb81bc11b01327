// Anchors: loads on nails and ropes by statics, in the plane and in space.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop::test;

namespace {

/// The hanging block alone, damped; `more` settings after these.
std::vector<std::string> block_alone(const std::vector<std::string>& more) {
  std::vector<std::string> settings{"solver.transfer=tpic", "solver.blend_rate=", "solver.damping_rate=6.0",
                                    "contacts=[]",          "rigid=[]",           "time.end=2.5"};
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

}  // namespace

TEST_CASE("A block on a rope: the rope bears its weight and is W / K longer; an inextensible one keeps its length") {
  // At the middle of its upper edge, straight below the end of the rope.
  const std::string at = "anchors=[{name='rope',membrane='net',at=[-1.0,0.5],type='line',to=[-1.0,1.5],length=1.0,";
  for (const double stiffness : {1e5, std::numeric_limits<double>::infinity()}) {
    CAPTURE(stiffness);
    const std::string K = std::isfinite(stiffness) ? "1e5" : "inf";
    const SceneRun run("tests/scenes/hanging.toml", block_alone({at + "stiffness=" + K + "}]"}));
    CAPTURE(run.outcome().err);
    REQUIRE(run.outcome().code == 0);
    const double stone = 1600 * 0.5, weight = 9.81 * (run.column("total.mass_kg").back() - stone);
    CHECK(run.column("rope.force_y_N_m").back() == near(weight, 0.002));
    CHECK(std::abs(run.column("rope.force_x_N_m").back()) < 0.002 * weight);
    CHECK(run.column("rope.pull_N_m").back() == near(weight, 0.002));
    CHECK(run.column("rope.length_m").back() == near(1 + weight / stiffness, 0.0005));
  }
}

TEST_CASE("With MUSL a rope bears the weight of its block and is W / K longer") {
  const SceneRun run("tests/scenes/hanging.toml",
                     block_alone({"solver.transfer=musl", "solver.blend_rate=50.0",
                                  "anchors=[{name='rope',membrane='net',at=[-1.0,0.5],type='line',to=[-1.0,1.5],"
                                  "length=1.0,stiffness=1e5}]"}));
  CAPTURE(run.outcome().err);
  REQUIRE(run.outcome().code == 0);
  const double stone = 1600 * 0.5, weight = 9.81 * (run.column("total.mass_kg").back() - stone);
  CHECK(run.column("rope.force_y_N_m").back() == near(weight, 0.002));
  CHECK(run.column("rope.length_m").back() == near(1 + weight / 1e5, 0.0005));
}

TEST_CASE("Cloth that slides over water hangs as a pendant bag does") {
  const SceneRun run("cases/verification/hanging_bag.toml",
                     {"membranes.bag.contents_friction=0.0", "grid.spacing=0.25"});
  CAPTURE(run.outcome().err);
  REQUIRE(run.outcome().code == 0);
  // See the scene; found 30877 N/m, 20729 N/m, -0.6006 m.
  CHECK(run.column("rope.force_y_N_m").back() == near(30851.384, 0.003));
  CHECK(run.column("bag.tension_mean_N_m").back() == near(20635.189, 0.014));
  CHECK(std::abs(run.column("water.position_y_m").back() + 0.61221834) < 0.03);
}

TEST_CASE("A slack rope bears nothing: the block falls freely; one that is held stays where it is drawn") {
  const std::string rope =
      "anchors=[{name='rope',membrane='net',at=[-1.0,0.5],type='line',to=[-1.0,1.5],length=3.0,"
      "stiffness=1e5}]";
  const std::vector<std::string> freely{"contacts=[]", "rigid=[]", "time.end=0.3", rope};
  const SceneRun falls("tests/scenes/hanging.toml", freely);
  REQUIRE(falls.outcome().code == 0);
  CHECK(falls.column("rope.pull_N_m").back() == 0);
  CHECK(falls.column("load.velocity_y_m_s").back() == near(-9.81 * falls.column("time_s").back(), 1e-6));
  CHECK(falls.column("rope.length_m").back() == near(1 + 0.5 * 9.81 * 0.09, 0.02));  // of the node, which is at 0.5 m
}

TEST_CASE("Two nails share the weight of a block between them, and pull it apart as much") {
  const SceneRun run("tests/scenes/hanging.toml",
                     block_alone({"anchors=[{name='nail',membrane='net',at=[-1.5,0.5],type='held'},"
                                  "{name='pin',membrane='net',at=[-0.5,0.5],type='held'}]"}));
  REQUIRE(run.outcome().code == 0);
  const double stone = 1600 * 0.5, weight = 9.81 * (run.column("total.mass_kg").back() - stone);
  const double left = run.column("nail.force_y_N_m").back(), right = run.column("pin.force_y_N_m").back();
  CHECK(left + right == near(weight, 0.002));
  CHECK(left == near(right, 0.002));
  CHECK(run.column("nail.force_x_N_m").back() == near(-run.column("pin.force_x_N_m").back(), 0.002));
}

TEST_CASE("A run with anchors and polygons that is resumed ends as one that was not interrupted") {
  struct Case {
    std::string scene;
    std::vector<std::string> settings;
  };
  const std::vector<std::string> soon{"grid.spacing=0.25", "time.end=0.2"};
  for (const Case& run :
       {Case{"tests/scenes/hanging.toml", {}}, Case{"tests/scenes/hanging.toml", {"solver.transfer=musl"}},
        Case{"cases/verification/hanging_bag_sharp.toml", soon}}) {
    CAPTURE(run.scene);
    SceneRun whole(run.scene, run.settings);
    SceneRun parts(run.scene, run.settings, {"--until", "0.1"});
    CHECK(parts.outcome().code == 75);
    CHECK(parts.again({"--resume"}).code == 0);
    CHECK(parts.hash() == whole.hash());
  }
}
