// Columns of history.csv on a state whose numbers are worked by hand.
#include <geodrop/base/error.hpp>
#include <geodrop/measure/history.hpp>

#include "base/growing_file.hpp"
#include "files/history_file.hpp"
#include "support/near.hpp"
#include "support/scene_files.hpp"
#include "support/small_state.hpp"

#include <doctest/doctest.h>

#include <omp.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <map>
#include <numbers>

using namespace geodrop;
using namespace geodrop::test;

namespace {

std::map<std::string, double> row_of(const Scene& scene, const State<2>& state, HistoryTable earlier = {}) {
  earlier.columns = history_columns(scene);
  const std::vector<double> values = history_row(scene, state, earlier);
  REQUIRE(values.size() == earlier.columns.size());
  std::map<std::string, double> row;
  for (std::size_t c = 0; c < values.size(); ++c) row[earlier.columns[c]] = values[c];
  return row;
}

/// Turns the bag about its centre (4, 4) and moves it by (1, -2).
void turn_bag(Body<2>& bag, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  for (std::size_t p = 0; p < bag.size(); ++p) {
    const double X = bag.initial_x[0][bag.id[p]] - 4, Y = bag.initial_x[1][bag.id[p]] - 4;
    bag.x[0][p] = 5 + std::cos(angle) * X - std::sin(angle) * Y;
    bag.x[1][p] = 2 + std::sin(angle) * X + std::cos(angle) * Y;
  }
}

}  // namespace

TEST_CASE("a body's centre, velocity and extremes") {
  State<2> state = small_state();
  Body<2>& pool = state.bodies[0];
  pool.mass = {1000, 1000, 1000, 3000};
  pool.v[0] = {6, 0, 0, 0};
  pool.v[1] = {0, 0, 0, -2};
  const auto row = row_of(small_scene(), state);
  CHECK(row.at("pool.position_x_m") == near((0.5 + 1.5 + 2.5 + 3 * 3.5) / 6, 1e-12));
  CHECK(row.at("pool.position_y_m") == near(0.5, 1e-12));
  CHECK(row.at("pool.velocity_x_m_s") == near(1, 1e-12));
  CHECK(row.at("pool.velocity_y_m_s") == near(-1, 1e-12));
  CHECK(row.at("pool.velocity_rms_m_s") == near(std::sqrt((36 + 3 * 4) / 6.0), 1e-12));
  CHECK(row.at("pool.leftmost_m") == 0.5);
  CHECK(row.at("pool.rightmost_m") == 3.5);
  CHECK(row.at("pool.width_m") == 3);
  CHECK(row.at("bag.lowest_m") == 3.5);
  CHECK(row.at("bag.highest_m") == 4.5);
}

TEST_CASE("rotation is the best fit about the centres, in any order of particles") {
  State<2> state = small_state();
  Body<2>& bag = state.bodies[1];
  bag.id = {2, 0, 3, 1};
  turn_bag(bag, 30);
  CHECK(row_of(small_scene(), state).at("bag.rotation_deg") == near(30, 1e-12));
  turn_bag(bag, -100);
  CHECK(row_of(small_scene(), state).at("bag.rotation_deg") == near(-100, 1e-12));
}

TEST_CASE("rotation goes on beyond half a turn") {
  const Scene scene = small_scene();
  State<2> state = small_state();
  HistoryTable history{history_columns(scene), {}};
  for (double degrees = 0; degrees <= 720; degrees += 60) {
    turn_bag(state.bodies[1], degrees);
    history.rows.push_back(history_row(scene, state, history));
  }
  CHECK(history.rows.back()[history.find("bag.rotation_deg")] == near(720, 1e-12));
}

TEST_CASE("rotation in three dimensions is axis times angle") {
  Body<3> body;
  body.material = LinearElastic{1, 1, 1};
  const std::array<std::array<double, 3>, 4> places{{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}};
  for (std::size_t p = 0; p < 4; ++p) {
    for (int a = 0; a < 3; ++a) {
      body.initial_x[a].push_back(places[p][a]);
      body.v[a].push_back(0);
    }
    // A third of a turn about (1, 1, 1): x -> y -> z -> x.
    for (int a = 0; a < 3; ++a) body.x[(a + 1) % 3].push_back(places[p][a]);
    body.mass.push_back(1);
    body.J.push_back(1);
    body.id.push_back(static_cast<std::uint32_t>(p));
  }
  for (auto& component : body.stress) component.assign(4, 0.0);
  const Vec<3> rotation = measure(body, 1.0).rotation;
  for (int a = 0; a < 3; ++a) CHECK(rotation[a] == near(2 * std::numbers::pi / 3 / std::sqrt(3.0), 1e-12));
}

TEST_CASE("stress at the centre counts volume within one spacing, pore pressure included") {
  State<2> state = small_state();
  Body<2>& bag = state.bodies[1];
  bag.x[0] = {4, 4.5, 4, 9};  // centre (5.375, 4): only particle 1 is within one spacing of it
  bag.x[1] = {4, 4, 4, 4};
  bag.stress[0] = {0, -100, 0, 0};
  bag.stress[1] = {0, -400, 0, 0};
  bag.stress[2] = {0, -100, 0, 0};
  bag.pore_pressure = {0, 50, 0, 0};
  auto row = row_of(small_scene(), state);
  CHECK(row.at("bag.mean_pressure_centre_Pa") == near(200 + 50, 1e-12));
  CHECK(row.at("bag.vertical_stress_centre_Pa") == near(-450, 1e-12));
  CHECK(row.at("bag.horizontal_stress_centre_Pa") == near(-150, 1e-12));

  bag.x[0] = {4.25, 4.5, 3, 9};  // centre 5.1875: particle 0, of volume 1, and particle 1, now of volume 3
  bag.J[1] = 3;
  row = row_of(small_scene(), state);
  CHECK(row.at("bag.mean_pressure_centre_Pa") == near(250 * 3 / 4.0, 1e-12));

  bag.x[0] = {0, 0, 9, 9};
  CHECK(std::isnan(row_of(small_scene(), state).at("bag.mean_pressure_centre_Pa")));
}

TEST_CASE("pressure of water comes from its density, of soil from its stress") {
  State<2> state = small_state();
  state.bodies[0].J[1] = 0.8;
  CHECK(mean_pressure(state.bodies[0], 1) == near(2e6 * 0.25, 1e-12));
  CHECK(total_stress(state.bodies[0], 1)[2] == near(-5e5, 1e-12));
  CHECK(total_stress(state.bodies[0], 1)[3] == 0);
}

TEST_CASE("membrane: tension and where, length, area, utilisation") {
  State<2> state = small_state();
  state.membranes[0].gauge.peak = 350;
  state.membranes[0].gauge.peak_at = {4, 3.5};
  state.membranes[0].gauge.peak_time = 0.75;
  auto row = row_of(small_scene(), state);
  CHECK(row.at("skin.tension_max_N_m") == 300);
  CHECK(row.at("skin.tension_max_x_m") == 4);
  CHECK(row.at("skin.tension_max_y_m") == 5);
  CHECK(row.at("skin.tension_mean_N_m") == near(2 * 600 / 10.0, 1e-12));
  CHECK(row.at("skin.tension_p95_N_m") == near(200 + 0.85 * 100, 1e-12));  // rank 0.95 * 3 of 0 100 200 300
  CHECK(row.at("skin.tension_gauge_N_m") == 350);
  CHECK(row.at("skin.tension_gauge_y_m") == 3.5);
  CHECK(row.at("skin.tension_gauge_time_s") == 0.75);
  CHECK(row.at("skin.length_m") == 8);
  CHECK(row.at("skin.area_m2") == 4);
  CHECK(row.at("skin.utilisation_max") == near(0.7, 1e-12));
  state.membranes[0].strength = 0;
  row = row_of(small_scene(), state);
  CHECK(std::isnan(row.at("skin.utilisation_max")));
}

TEST_CASE("an open membrane has no area") {
  Scene scene = small_scene();
  scene.membranes[0].closed = false;
  State<2> state = small_state();
  Membrane<2>& skin = state.membranes[0];
  skin.closed = false;
  skin.rest_length.pop_back();
  skin.strain.pop_back();
  skin.tension.pop_back();
  const auto row = row_of(scene, state);
  CHECK(row.count("skin.area_m2") == 0);
  CHECK(row.at("skin.length_m") == 6);
}

TEST_CASE("contacts: sums of their forces, work; rigid bodies that move: their pose") {
  Scene scene = small_scene();
  scene.bodies.push_back(scene.bodies[0]);
  scene.bodies[2].name = "log";
  scene.rigid = {{"floor", HalfPlaneShape{{0, 0}, {0, 1}}, {}, {}},
                 {"gate", CapsuleShape{{0, 0}, {0, 1}, 0.1}, HingeMotionSpec{{0, 1}, 1, 40}, {}}};
  scene.contacts = {{{"gate", "skin"}, 0.3, 1, 1, {}}, {{"log", "floor"}, 0.3, 1, 1, {}}};
  State<2> state = small_state();
  state.bodies.push_back(state.bodies[0]);
  state.rigid.resize(2);
  state.rigid[0].name = "floor";
  state.rigid[1].name = "gate";
  state.rigid[1].angle = 0.5;
  state.rigid[1].displacement = {1, 2};
  state.rigid_contacts.resize(2);
  RigidContact<2>& skin = state.rigid_contacts[0];
  skin.normal_force = {3, 4};
  skin.friction_force = {-0.8, 0.6};
  skin.normal_sum = 5;
  skin.friction_sum = -1;
  skin.friction_work = 7;
  skin.damping_work = 8;
  state.rigid_contacts[1].normal_sum = 11;
  const auto row = row_of(scene, state);
  CHECK(row.at("skin.gate.normal_force_N_m") == 5);
  CHECK(row.at("skin.gate.friction_force_N_m") == -1);
  CHECK(row.at("skin.gate.normal_force_y_N_m") == 4);
  CHECK(row.at("skin.gate.friction_force_x_N_m") == -0.8);
  CHECK(row.at("skin.gate.friction_work_J") == 7);
  CHECK(row.at("skin.gate.damping_work_J") == 8);
  CHECK(row.at("log.floor.normal_force_N_m") == 11);
  CHECK(row.at("gate.rotation_deg") == near(0.5 * 180 / std::acos(-1.0), 1e-12));
  CHECK(row.at("gate.displacement_y_m") == 2);
  CHECK(row.count("floor.rotation_deg") == 0);
}

TEST_CASE("contacts of membranes: their force on the first one; own folds: how hard they press") {
  Scene scene = small_scene();
  scene.membranes.push_back(scene.membranes[0]);
  scene.membranes[1].name = "cover";
  scene.rigid = {{"floor", HalfPlaneShape{{0, 0}, {0, 1}}, {}, {}}};
  scene.contacts = {
      {{"cover", "skin"}, 0.3, 1, 1, {}}, {{"skin", "floor"}, 0.3, 1, 1, {}}, {{"skin", "skin"}, 0.3, 1, 1, {}}};
  State<2> state = small_state();
  state.membranes.push_back(state.membranes[0]);
  state.membranes[1].name = "cover";
  state.rigid_contacts.resize(1);
  state.rigid_contacts[0].normal_sum = 2;
  state.membrane_contacts.resize(2);
  state.membrane_contacts[0].force = {3, 4};
  state.membrane_contacts[0].normal_force = 5;
  state.membrane_contacts[1].normal_force = 6;
  const auto row = row_of(scene, state);
  CHECK(row.at("cover.skin.normal_force_N_m") == 5);
  CHECK(row.at("cover.skin.force_x_N_m") == 3);
  CHECK(row.at("cover.skin.force_y_N_m") == 4);
  CHECK(row.at("skin.floor.normal_force_N_m") == 2);
  CHECK(row.at("skin.skin.normal_force_N_m") == 6);
  CHECK(row.count("skin.skin.force_x_N_m") == 0);
}

TEST_CASE("energies, mass and momentum") {
  State<2> state = small_state();
  Body<2>& pool = state.bodies[0];
  Body<2>& bag = state.bodies[1];
  pool.v[0] = {3, 0, 0, 0};
  state.membranes[0].v[1] = {0, 2, 0, 0};
  state.membranes[0].caught = {Array<double>{1, 4, 0, 0}, Array<double>{0, 0, 0, -7}};
  auto row = row_of(small_scene(), state);
  CHECK(row.at("total.mass_kg") == near(4 * 1000 + 4 * 1600 + 2, 1e-12));
  CHECK(row.at("energy.kinetic_J") == near(0.5 * 1000 * 9 + 0.5 * 0.5 * 4, 1e-12));
  CHECK(row.at("energy.potential_J") == near(10 * (4000 * 0.5 + 6400 * 4 + 2 * 4), 1e-12));
  CHECK(row.at("total.momentum_x_kg_m_s") == near(3000 + 5, 1e-12));
  CHECK(row.at("total.momentum_y_kg_m_s") == near(1 - 7, 1e-12));
  // J e^2 / 2 L0 of the stretched segments only
  CHECK(row.at("energy.membrane_J") == near(0.5 * 1000 * 2 * (0.01 + 0.04 + 0.09), 1e-12));
  CHECK(row.at("energy.strain_J") == 0);

  // Water: K (J - 1 - ln J) per reference volume of 1 m2.
  pool.J[2] = 0.5;
  row = row_of(small_scene(), state);
  CHECK(row.at("energy.strain_J") == near(2e6 * (-0.5 + std::log(2.0)), 1e-12));
  pool.J[2] = 1;

  // Sand: K = 3e6 / (3 * 0.5) = 2e6, G = 3e6 / 2.5 = 1.2e6, K_f / n = 2e7, volume 1 m2 * J. One particle carries
  // p' = 2000, s = (1000, -1000, 0, xy 500): s:s = 2e6 + 2 * 0.25e6, and u = 4000.
  bag.stress[0][3] = -1000;
  bag.stress[1][3] = -3000;
  bag.stress[2][3] = -2000;
  bag.stress[3][3] = 500;
  bag.pore_pressure[3] = 4000;
  bag.J[3] = 0.9;
  row = row_of(small_scene(), state);
  CHECK(row.at("energy.strain_J") == near(0.9 * (4e6 / 4e6 + 2.5e6 / 4.8e6 + 16e6 / 4e7), 1e-12));
  CHECK(row.at("energy.total_J") == near(row.at("energy.kinetic_J") + row.at("energy.potential_J") +
                                             row.at("energy.strain_J") + row.at("energy.membrane_J"),
                                         1e-12));
}

TEST_CASE("Open voids bear no stress and store no energy, where the soil between them bears") {
  State<2> state = small_state();
  Body<2>& bag = state.bodies[1];
  bag.stress[0][3] = -1000;
  bag.stress[1][3] = -3000;
  bag.stress[2][3] = -2000;
  bag.pore_pressure[3] = 4000;
  const double closed = measure(state, {0, 0}).strain;
  MohrCoulombWithVoids soil{std::get<MohrCoulomb>(bag.material)};
  soil.cohesion = 20e3;
  soil.tension_cutoff = 0;
  bag.material = soil;
  bag.gap.assign(4, 0.0);
  bag.gap[3] = std::log(2.0);
  bag.J[3] = 2;
  // The soil is all there, in half of the volume; the water fills it, too: u^2 / 2 (K_f / n) = 0.4 J/m3 once more.
  CHECK(measure(state, {0, 0}).strain == near(closed + 0.4, 1e-12));
  CHECK(total_stress(bag, 3)[1] == near(-3000 / 2.0 - 4000, 1e-13));
  CHECK(mean_pressure(bag, 3) == near(2000 / 2.0 + 4000, 1e-13));
}

TEST_CASE("the slope of the water's energy over volume is minus its pressure") {
  State<2> state = small_state();
  const Point no_gravity{0, 0};
  state.bodies[1].mass.assign(4, 0.0);
  const double step = 1e-5;
  state.bodies[0].J[0] = 0.9 + step;
  const double above = measure(state, no_gravity).strain;
  state.bodies[0].J[0] = 0.9 - step;
  const double below = measure(state, no_gravity).strain;
  state.bodies[0].J[0] = 0.9;
  CHECK((above - below) / (2 * step) == near(-mean_pressure(state.bodies[0], 0), 1e-8));
}

TEST_CASE("dissipated energy counts from the first row") {
  const Scene scene = small_scene();
  State<2> state = small_state();
  state.bodies[0].v[0] = {3, 0, 0, 0};
  HistoryTable history{history_columns(scene), {}};
  history.rows.push_back(history_row(scene, state, history));
  CHECK(history.rows[0][history.find("energy.dissipated_J")] == 0);
  state.bodies[0].v[0] = {0, 0, 0, 0};
  CHECK(row_of(scene, state, history).at("energy.dissipated_J") == near(4500, 1e-12));
}

TEST_CASE("tracers, and the pressure beside still water") {
  State<2> state = small_state();
  state.t = 0.125;
  state.step = 7;
  const double p = 2e6 * (std::exp(1000 * 10 * 3.5 / 2e6) - 1);  // 3.5 m below the surface at 4 m
  for (double& J : state.bodies[0].J) J = 1 / (1 + p / 2e6);
  auto row = row_of(small_scene(), state);
  CHECK(row.at("time_s") == 0.125);
  CHECK(row.at("step") == 7);
  CHECK(row.at("cork.position_x_m") == 0.75);
  CHECK(row.at("cork.displacement_x_m") == 0.25);
  CHECK(row.at("cork.displacement_y_m") == -0.25);
  CHECK(row.at("cork.velocity_y_m_s") == -0.2);
  CHECK(row.at("still.pressure_error_rms_Pa") < 1e-6 * p);
  state.bodies[0].J[0] = 1 / (1 + (p + 100) / 2e6);
  row = row_of(small_scene(), state);
  CHECK(row.at("still.pressure_error_rms_Pa") == near(50, 1e-12));
  CHECK(row.at("still.pressure_error_max_Pa") == near(100, 1e-12));
  CHECK(still_pressure(Newtonian{1000, 2e6, 0}, 10, -1) == 0);
}

TEST_CASE("rows have the same bits for any number of threads") {
  const Scene scene = small_scene();
  State<2> state = small_state();
  std::vector<std::array<double, 2>> places;
  for (int p = 0; p < 20000; ++p) places.push_back({std::sin(p), std::cos(3.0 * p)});
  state.bodies[0] = body_at(scene.materials[0], places, 0.1);
  state.bodies[0].name = "pool";
  const HistoryTable none{history_columns(scene), {}};
  omp_set_num_threads(1);
  const std::vector<double> one = history_row(scene, state, none);
  for (const int threads : {2, 3, 5}) {
    omp_set_num_threads(threads);
    CHECK(history_row(scene, state, none) == one);
  }
}

TEST_CASE("history.csv: header, nine digits, nan") {
  const TemporaryDirectory directory;
  HistoryFile file(directory / "history.csv", {{"time_s", "a.b_m"}, {{0, -std::nan("")}}});
  file.append({0.1, 123.456789012});
  CHECK(read_file(directory / "history.csv") == "time_s,a.b_m\n0,nan\n0.1,123.456789\n");
}

TEST_CASE("a full disk is an error of history.csv, too") {
  CHECK_THROWS_AS(HistoryFile("/dev/null/history.csv", {{"time_s"}, {}}), WriteError);
}

TEST_CASE("a text that the disk does not take is kept for later, whole") {
  const TemporaryDirectory directory;
  GrowingFile full("/dev/full", GrowingFile::Begin::behind);
  full.append("row\n");
  CHECK(full.failure() == "cannot write /dev/full: No space left on device");
  // A limit on the size of files, lifted later. Room for half a row only.
  std::signal(SIGXFSZ, SIG_IGN);
  const std::filesystem::path path = directory / "rows";
  GrowingFile file(path, GrowingFile::Begin::anew);
  file.append("123\n");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit tight{6, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &tight);
  file.append("456\n");
  setrlimit(RLIMIT_FSIZE, &before);
  CHECK(read_file(path) == "123\n");
  CHECK(file.failure().ends_with("File too large"));
  file.append("789\n");
  CHECK(read_file(path) == "123\n456\n789\n");
}
