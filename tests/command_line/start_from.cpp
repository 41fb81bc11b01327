// Runs that start from the end of another, through the program.
#include <doctest/doctest.h>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop::test;

namespace {

const std::string tube = "cases/verification/pressurised_tube.toml";
const std::vector<std::string> one_thread{"--threads", "1"};

/// The tube on coarse cells; later settings win.
std::vector<std::string> coarse(const std::vector<std::string>& settings) {
  std::vector<std::string> all{"grid.spacing=0.3"};
  all.insert(all.end(), settings.begin(), settings.end());
  return all;
}

std::string from(const SceneRun& first) { return "start_from=\"" + first.file("").string() + '"'; }

}  // namespace

TEST_CASE("A tube that one run has pumped up keeps its tension in the next, on other cells too") {
  const SceneRun first(tube, coarse({}), one_thread);
  REQUIRE(first.outcome().code == 0);
  const double tension = first.column("skin.tension_mean_N_m").back();
  CHECK(tension == near(4880.88, 0.003));  // J (sqrt(1.1) - 1)
  for (const char* spacing : {"grid.spacing=0.3", "grid.spacing=0.2"}) {
    CAPTURE(spacing);
    const SceneRun next(tube, coarse({from(first), spacing, "pumps=", "time.end=0.3"}), one_thread);
    CAPTURE(next.outcome().err);
    REQUIRE(next.outcome().code == 0);
    CHECK(next.column("time_s").front() == 0);
    CHECK(next.column("skin.tension_mean_N_m").back() == near(tension, 2e-3));
    CHECK(next.column("skin.area_m2").front() == near(first.column("skin.area_m2").back(), 1e-9));
    CHECK(next.column("total.mass_kg").back() == near(first.column("total.mass_kg").back(), 1e-12));
  }
}

TEST_CASE(
    "A tube that falls in one run falls on in the next, with its geotextile, and a run that was stopped goes on") {
  std::vector<std::string> falls = coarse({"gravity=[0.0, -1.0]", "pumps=", "solver.damping_rate=0.0", "time.end=0.2"});
  const SceneRun first(tube, falls, one_thread);
  REQUIRE(first.outcome().code == 0);
  const double reached = first.column("fluid.velocity_y_m_s").back();
  // The polygon of the geotextile, which carries the weight of the water, is 0.06 % smaller than the disc of water.
  CHECK(reached == near(-first.column("time_s").back(), 1e-3));
  falls.push_back(from(first));
  const SceneRun next(tube, falls, one_thread);
  REQUIRE(next.outcome().code == 0);
  CHECK(next.column("fluid.velocity_y_m_s").front() == near(reached, 1e-12));
  CHECK(next.column("fluid.velocity_y_m_s").back() == near(reached - next.column("time_s").back(), 1e-3));

  SceneRun again(tube, falls, {"--threads", "1", "--until", "0.1"});
  REQUIRE(again.outcome().code == 75);
  REQUIRE(again.again({"--threads", "1", "--resume"}).code == 0);
  CHECK(again.column("fluid.velocity_y_m_s") == next.column("fluid.velocity_y_m_s"));
}

TEST_CASE("Water in pores is there once") {
  const std::string bag = "cases/verification/saturated_bag_rests.toml";
  std::vector<std::string> settings{"grid.spacing=0.2", "time.end=0.01"};
  const SceneRun first(bag, settings, one_thread);
  REQUIRE(first.outcome().code == 0);
  settings.push_back(from(first));
  const SceneRun next(bag, settings, one_thread);
  REQUIRE(next.outcome().code == 0);
  CHECK(next.column("total.mass_kg").front() == near(first.column("total.mass_kg").back(), 1e-12));
}

TEST_CASE("What cannot be started from is refused in words") {
  const geodrop::TemporaryDirectory directory;
  const std::string nowhere = directory / "nowhere";
  const SceneRun none(tube, coarse({"start_from=\"" + nowhere + '"'}), one_thread);
  CHECK(none.outcome().code == 2);
  CHECK(none.outcome().err.find("start_from: found \"" + nowhere + "\", which is no run directory") !=
        std::string::npos);
  CHECK_FALSE(std::filesystem::exists(none.file("")));
  const SceneRun first(tube, coarse({"time.end=0.01"}), one_thread);
  REQUIRE(first.outcome().code == 0);
  const SceneRun stranger("cases/gravity_column.toml", {from(first)}, one_thread);
  CHECK(stranger.outcome().code == 2);
  CHECK(stranger.outcome().err.find("no body and no membrane of this scene") != std::string::npos);
  const SceneRun other(
      tube,
      coarse({from(first), "membranes.skin.closed=false", "membranes.skin.points=[[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]]",
              "bodies.fluid.pressure=cell", "pumps="}),
      one_thread);
  CHECK(other.outcome().code == 2);
  CHECK(other.outcome().err.find("closed in one of the scenes only") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(other.file("")));
}

TEST_CASE("A damaged newest checkpoint is refused, not replaced by the one before, which is another state") {
  const SceneRun first(tube, coarse({"time.end=0.04"}), one_thread);
  REQUIRE(first.outcome().code == 0);
  const auto newest = first.file("checkpoint.bin"), before = first.file("checkpoint.previous.bin");
  std::filesystem::copy_file(newest, before, std::filesystem::copy_options::overwrite_existing);
  std::filesystem::resize_file(newest, std::filesystem::file_size(newest) / 2);
  const SceneRun next(tube, coarse({from(first)}), one_thread);
  CAPTURE(next.outcome().err);
  CHECK(next.outcome().code == 2);
  CHECK(next.outcome().err.find("the checkpoint before it, at t = 0.04") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(next.file("")));
  std::filesystem::remove(newest);
  const SceneRun after(tube, coarse({from(first), "time.end=0.01"}), one_thread);
  CHECK(after.outcome().code == 0);
}
