// Scenes with membranes of triangles, coarse: closed forms, balance of forces, threads, resume, what ParaView gets.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop::test;

namespace {

const std::string sphere = "cases/verification/pressurised_sphere_3d.toml", tube = "cases/geotube_3d.toml";
const std::string filled = "cases/verification/filled_sphere_3d.toml", bag = "tests/scenes/bag_3d.toml";
const std::string trough = "tests/scenes/trough_3d.toml";
const std::vector<std::string> no_verdict{"verify=[]", "variants=[]", "expect=[]"};

std::vector<std::string> with(std::vector<std::string> settings, const std::vector<std::string>& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

}  // namespace

TEST_CASE("A balloon of four cells' radius bears p R / 2 in both directions") {
  // Chords of edges of 0.16 R: the errors are of second order in the spacing (cases/verification).
  const SceneRun run(sphere, with(no_verdict, {"grid.spacing=0.25"}));
  CHECK(run.outcome().code == 0);
  CHECK(run.result("tension_mean_N_m") == near(2857.142857, 0.006));
  CHECK(run.result("cross_tension_mean_N_m") == near(2857.142857, 0.02));
  CHECK(run.result("volume_m3") == near(4.445196694, 0.03));
  CHECK(run.column("balloon.pressure_jump_Pa").back() == near(5492.393, 1e-4));
  CHECK(run.column("balloon.balance_error_ratio").back() < 0.004);  // 0.0036, 0.0014, 0.0001 at h = R/2, R/4, R/8
}

TEST_CASE("A fluid and the cloth around it find the balance of p R / 2") {
  // Closed form in the case: 1897.78 N/m, 3696.68 Pa; 0.66, 0.08 and 0.8 % are measured, and 0.5 % of scatter.
  const SceneRun run(filled, with(no_verdict, {"grid.spacing=0.25"}));
  CHECK(run.outcome().code == 0);
  CHECK(run.result("tension_mean_N_m") == near(1897.7759, 0.015));
  CHECK(run.result("cross_tension_mean_N_m") == near(1897.7759, 0.0024));
  CHECK(run.result("pressure_Pa") == near(3696.6827, 0.02));
  CHECK(run.result("cross_tension_std_N_m") < 0.015 * 1897.7759);
}

TEST_CASE("A geotube in space stands on its ground with the weight of its contents") {
  const SceneRun run(tube, with(no_verdict, {"grid.spacing=0.4"}));
  CHECK(run.outcome().code == 0);
  const double weight = 12e3 * run.result("volume_m3"), cloth = 0.6 * 9.81 * 2 * 14 * 4.6;
  CHECK(run.result("ground_N") == near(weight + cloth, 5e-4));
  // Across each upright section the cloth bears what the fluid presses on it: the ground, without friction, takes none.
  // 1.4 to 4.3 % are measured here, 0 to 0.8 % at h = 0.2 m (docs/geotube.md).
  for (const std::string section : {"at_0_m", "at_2_m", "at_4_m", "at_5_5_m"}) {
    CAPTURE(section);
    const double pressure = 12e3 * (2.2 - run.column(section + ".middle_z_m").back());
    CHECK(run.column(section + ".force_x_N").back() == near(pressure * run.column(section + ".area_m2").back(), 0.05));
    CHECK(std::abs(run.column(section + ".force_y_N").back()) < 1.0);
  }
}

TEST_CASE("A point of a cloth without bodies is followed") {
  // The strip hangs by 13 mm between its rails in the end.
  const SceneRun run("cases/verification/wrinkled_strip_3d.toml",
                     with(no_verdict, {"grid.spacing=0.25", "time.end=0.1"}));
  CHECK(run.outcome().code == 0);
  CHECK(run.column("halfway.displacement_x_m").back() > 0.005);
}

TEST_CASE("Cloth in space: one hash for 1, 2 and 3 threads") {
  const std::vector<std::string> settings = with(no_verdict, {"grid.spacing=0.4", "time.end=0.01"});
  const std::string one = SceneRun(tube, settings, {"--threads", "1"}).hash();
  for (const std::string threads : {"2", "3"}) CHECK(SceneRun(tube, settings, {"--threads", threads}).hash() == one);
  // With a fluid inside: particles of cells that triangles clip, and of cells of particles.
  const std::vector<std::string> coarse = with(no_verdict, {"grid.spacing=0.25", "time.end=0.05"});
  for (const std::string& scene : {filled, bag}) {
    const std::string alone = SceneRun(scene, coarse, {"--threads", "1"}).hash();
    for (const std::string threads : {"2", "3"}) CHECK(SceneRun(scene, coarse, {"--threads", threads}).hash() == alone);
  }
}

TEST_CASE("Cloth in space: a run that is prolonged from its checkpoint has the bits of one without a break") {
  const std::vector<std::string> settings = with(no_verdict, {"grid.spacing=0.4", "contacts.0.friction=0.3"});
  const SceneRun whole(tube, with(settings, {"time.end=0.02"}), {"--threads", "1"});
  SceneRun parts(tube, with(settings, {"time.end=0.02"}), {"--threads", "1", "--until", "0.01"});
  parts.again({"--threads", "1", "--resume"});
  CHECK(parts.hash() == whole.hash());
  const std::vector<std::string> fluid = with(no_verdict, {"grid.spacing=0.5", "time.end=0.1"});
  SceneRun halves(filled, fluid, {"--threads", "1", "--until", "0.05"});
  halves.again({"--threads", "1", "--resume"});
  CHECK(halves.hash() == SceneRun(filled, fluid, {"--threads", "1"}).hash());
}

TEST_CASE("Frames of cloth in space have triangles with both tensions") {
  const SceneRun run(sphere, with(no_verdict, {"time.end=0.01"}));
  const std::string frame = geodrop::read_file(run.file("membranes_000000.vtp"));
  CHECK(frame.find("NumberOfPolys=\"0\"") == std::string::npos);
  for (const char* name :
       {"\"tension\"", "\"cross_tension\"", "\"utilisation\"", "\"strain\"", "\"curvature_load\"", "\"pressure_jump\""})
    CHECK(frame.find(name) != std::string::npos);
}

TEST_CASE("The walls of a trough bear W / (2 cos beta) each, and drive the bag as they turn away") {
  constexpr double least = 0.8, gravity = 9.81, slope = 35 * std::numbers::pi / 180;
  const SceneRun run(trough, {"output.history_interval=0.1"});
  CHECK(run.outcome().code == 0);
  const std::vector<double> time = run.column("time_s"), volume = run.column("bag.volume_m3");
  const std::vector<double> port = run.column("bag.port.normal_force_N"), mass = run.column("total.mass_kg");
  const std::vector<double> starboard = run.column("bag.starboard.normal_force_N");
  std::size_t rows = 0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    if (time[k] < least || time[k] > 1) continue;
    const double wall = (1000 * volume[k] + mass[k]) * gravity / (2 * std::cos(slope));
    CHECK(port[k] == near(wall, 0.002));
    CHECK(starboard[k] == near(wall, 0.002));
    ++rows;
  }
  CHECK(rows >= 2);
  // One wall is taken away, the other one turns by 0.1 rad in 0.2 s: the bag falls past it.
  CHECK(run.column("port.rotation_deg").back() == near(-0.1 * 180 / std::numbers::pi, 0.01));
  CHECK(starboard.back() == near_zero(1e-12));
  CHECK(run.column("bag.lower_z_m").back() < -0.5);
}

TEST_CASE("A trough that opens: one hash for 1 and 2 threads, and for a run in two parts; frames have its edges") {
  const std::vector<std::string> settings{"stages.open.from=0.02", "time.end=0.04"};
  const SceneRun one(trough, settings, {"--threads", "1"});
  CHECK(SceneRun(trough, settings, {"--threads", "2"}).hash() == one.hash());
  SceneRun parts(trough, settings, {"--threads", "1", "--until", "0.03"});
  parts.again({"--threads", "1", "--resume"});
  CHECK(parts.hash() == one.hash());
  // Four corners on each of two faces, twelve edges; the other prism is gone in the last frame.
  const std::string first = geodrop::read_file(one.file("rigid_000000.vtp"));
  CHECK(first.find("NumberOfPoints=\"16\"") != std::string::npos);
  CHECK(first.find("NumberOfLines=\"24\"") != std::string::npos);
}

TEST_CASE("A bag falls through water, dents its bed and lies still; pressure and friction around it carry its weight") {
  const SceneRun run("tests/scenes/bag_lands_3d.toml", {});
  REQUIRE(run.outcome().code == 0);
  CHECK(run.result("fastest_m_s") < -0.8);
  CHECK(run.result("last_velocity_m_s") < 0.03);  // 0.009
  CHECK(run.result("lowest_m") == within(-0.3, 0.15));
  const std::vector<double> time = run.column("time_s"), pressure = run.column("geotextile.pressure_force_z_N"),
                            friction = run.column("geotextile.friction_force_z_N");
  double force = 0, count = 0;
  for (std::size_t k = 0; k < time.size(); ++k)
    if (time[k] > 1.6) force += pressure[k] + friction[k], ++count;
  const double weight = run.column("geotextile.volume_m3").front() * 1700 * 9.81;
  CHECK(force / count == near(weight, 0.02));  // measured 0.6 %
}
