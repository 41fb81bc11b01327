// Bodies with skins that rest on each other, slide, stick and collide, against exact answers.
#include <doctest/doctest.h>
#include <geodrop/base/find_named.hpp>
#include <geodrop/step/pipeline.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double g = 9.81;

// Of the stacked blocks:
constexpr double density = 1800, width = 1;                ///< [kg/m3], [m]
constexpr double modulus = 5e6 * (1 - 0.3) / (1.3 * 0.4);  ///< of compression waves [Pa]
constexpr double pressure = density * g * 1.0;             ///< of the upper one, 1 m high [Pa]

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Gravity of a plane tilted by `degrees`, as an override.
std::string tilted(double degrees) {
  return "gravity=[" + std::to_string(g * std::sin(radians(degrees))) + "," +
         std::to_string(-g * std::cos(radians(degrees))) + "]";
}

/// Slope of the line through the rows of a run from a time on, by least squares.
double slope(const SceneRun& run, const std::string& column, double from) {
  const std::vector<double> t = run.column("time_s"), y = run.column(column);
  double n = 0, st = 0, sy = 0, stt = 0, sty = 0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    if (t[k] < from) continue;
    n += 1;
    st += t[k];
    sy += y[k];
    stt += t[k] * t[k];
    sty += t[k] * y[k];
  }
  return (n * sty - st * sy) / (n * stt - st * st);
}

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

State<2> state_at_end(const Scene& scene) {
  State<2> state = build_state<2>(scene);
  Grids<2> grids = make_grids<2>(scene);
  Pipeline<2> pipeline = build_pipeline<2>(scene);
  while (!is_over(scene, state)) advance(pipeline, state, grids);
  return state;
}

double mean_height(const Membrane<2>& m) {
  return std::accumulate(m.x[1].begin(), m.x[1].end(), 0.0) / static_cast<double>(m.nodes());
}

/// rms difference of the vertical stress from -rho g depth, over the particles of both bodies within a cell of
/// the interface, over the stress there.
double stress_error(const State<2>& state, double h) {
  const double interface = mean_height(find_named(state.membranes, "top"));
  double surface = 0;
  for (const Body<2>& body : state.bodies) {
    const double half = 0.25 * h;  // of a particle
    surface = std::max(surface, *std::max_element(body.x[1].begin(), body.x[1].end()) + half);
  }
  double sum = 0, count = 0;
  for (const Body<2>& body : state.bodies)
    for (std::size_t p = 0; p < body.size(); ++p) {
      if (std::abs(body.x[1][p] - interface) > h) continue;
      sum += std::pow(body.stress[1][p] + density * g * (surface - body.x[1][p]), 2);
      ++count;
    }
  REQUIRE(count > 0);
  return std::sqrt(sum / count) / (density * g * (surface - interface));
}

/// How deep the skins are in each other [h].
double depth(const State<2>& state, double h) {
  return (mean_height(find_named(state.membranes, "top")) - mean_height(find_named(state.membranes, "underside"))) / h;
}

}  // namespace

TEST_CASE("Stacked elastic blocks: the stress of their weight up to the interface, sunk in by p h / P") {
  const Scene scene = read_scene(source_path("tests/scenes/stack.toml"));
  const State<2> state = state_at_end(scene);
  CHECK(state.t < scene.time.end);  // at rest
  const double stress = stress_error(state, scene.grid.spacing), sunk = depth(state, scene.grid.spacing);
  MESSAGE("stress error ", stress, ", depth ", sunk, " h, exact ", pressure / modulus);
  CHECK(std::abs(sunk * modulus / pressure - 1) < 0.01);
  CHECK(state.membrane_contacts[0].normal_force == near(pressure * width, 6e-7));
  CHECK(stress < 0.05);
}

TEST_CASE("Soil on soil from K0: the stress of its weight up to the interface") {
  // Damped with a rate: kinetic damping lets soil with little cohesion hop on and on.
  std::vector<std::string> soil{
      "materials.stuff={model='mohr_coulomb',density=1800.0,youngs_modulus=5e6,poissons_ratio=0.3,cohesion=1e3,"
      "friction_angle_deg=30.0,dilatancy_angle_deg=0.0,tension_cutoff=0.0,drainage='drained'}",
      "relaxation={damping='none'}", "stages=[{name='settle',from=0.0,damping_rate=20.0}]", "time.end=1.0"};
  for (const char* body : {"lower", "upper"})
    soil.push_back("bodies." + std::string(body) + ".initial_stress={type='k0',surface=2.03,k0=0.5,under='air'}");
  const Scene scene = read_scene(source_path("tests/scenes/stack.toml"), soil);
  const State<2> state = state_at_end(scene);
  const double stress = stress_error(state, scene.grid.spacing), sunk = depth(state, scene.grid.spacing);
  MESSAGE("stress error ", stress, ", depth ", sunk, " h, exact ", pressure / modulus);
  CHECK(std::abs(sunk * modulus / pressure - 1) < 0.01);
  CHECK(stress < 0.05);
}

TEST_CASE("A block slides down 20 degrees with g (sin - mu cos), to 0.01 g") {
  for (const double mu : {0.15, 0.3}) {
    const SceneRun run("tests/scenes/block_on_slab.toml", {tilted(20), "contacts.0.friction=" + std::to_string(mu)});
    const double exact = g * (std::sin(radians(20)) - mu * std::cos(radians(20)));
    const double measured = slope(run, "block.velocity_x_m_s", 0.2);  // it has stopped bouncing then
    MESSAGE("mu = ", mu, ": ", measured, " m/s2, exact ", exact);
    CHECK(std::abs(measured - exact) < 0.01 * g);
  }
}

TEST_CASE("Damping of the contact drags on what slides, by less than 0.02 g") {
  // Skins that dent each other under way approach and part along their normals; without friction that is all there is.
  const SceneRun free("tests/scenes/block_on_slab.toml", {tilted(20), "contacts.0.friction=0.0"});
  const SceneRun damped("tests/scenes/block_on_slab.toml",
                        {tilted(20), "contacts.0.friction=0.0", "contacts.0.damping=1.0"});
  const double exact = g * std::sin(radians(20)), drag = exact - slope(damped, "block.velocity_x_m_s", 0.2);
  MESSAGE("drag ", drag, " m/s2");
  CHECK(std::abs(slope(free, "block.velocity_x_m_s", 0.2) - exact) < 0.002 * g);
  CHECK(drag > 0);
  CHECK(drag < 0.02 * g);
}

TEST_CASE("At 30 degrees a block with mu = 0.7 sticks") {
  // Settles with damping, without slipping; then left alone. 0.7 is 1.21 times tan 30.
  const SceneRun run("tests/scenes/block_on_slab.toml",
                     {tilted(30), "contacts.0.friction=0.7", "time.end=1.5",
                      "stages=[{name='settle',from=0.0,damping_rate=20.0},{name='rest',from=0.8}]"});
  const double creep = slope(run, "block.position_x_m", 1.0);
  MESSAGE("creep ", creep, " m/s");
  CHECK(std::abs(creep) < 1e-3);
  // And it does not with less than tan 30.
  const SceneRun slips("tests/scenes/block_on_slab.toml", {tilted(30), "contacts.0.friction=0.5"});
  CHECK(slope(slips, "block.velocity_x_m_s", 0.2) ==
        near(g * (std::sin(radians(30)) - 0.5 * std::cos(radians(30))), 0.08));
}

TEST_CASE("Discs that collide keep their momentum to round-off, and gain no energy") {
  const SceneRun run("tests/scenes/discs.toml");
  const double one = std::numbers::pi * 0.25 * 1000 * 2;  // momentum of a disc
  for (const char* axis : {"x", "y"}) {
    const std::vector<double> momentum = run.column(std::string("total.momentum_") + axis + "_kg_m_s");
    for (const double p : momentum) CHECK(std::abs(p - momentum.front()) < 1e-10 * one);
  }
  const std::vector<double> energy = run.column("energy.total_J"), left = run.column("left.velocity_x_m_s");
  const std::vector<double> right = run.column("right.velocity_x_m_s");
  CHECK(left.back() < -1);  // they did meet, and part
  CHECK(right.back() > 1);
  MESSAGE("energy: largest ", largest(energy) / energy.front(), ", last ", energy.back() / energy.front());
  CHECK(largest(energy) < 1.01 * energy.front());
}
