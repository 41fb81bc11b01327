// Coupled soil beside undrained soil, and a bed that an upward flow lifts.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/near.hpp"
#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;

namespace {

/// Of a history, at a time between its first and its last row.
double at(const std::vector<double>& times, const std::vector<double>& values, double t) {
  const auto after = std::upper_bound(times.begin(), times.end(), t);
  const std::size_t i = std::clamp<std::ptrdiff_t>(after - times.begin(), 1, times.size() - 1);
  const double share = (t - times[i - 1]) / (times[i] - times[i - 1]);
  return values[i - 1] + share * (values[i] - values[i - 1]);
}

/// The middle of the soil of a run over time.
struct Heights {
  std::vector<double> times, values;

  explicit Heights(const SceneRun& run) : times(run.column("time_s")), values(run.column("soil.position_y_m")) {}
  double lowest() const { return *std::min_element(values.begin(), values.end()); }
  double operator()(double t) const { return at(times, values, t); }
};

}  // namespace

TEST_CASE("Coupled soil of k = 1 nm/s swings as undrained soil does") {
  const std::vector<std::string> dense{"time.end=0.05", "output.history_interval=0.0002"};
  std::vector<std::string> without_damping = dense;
  without_damping.push_back("stages=");
  const Heights one(SceneRun("tests/scenes/undrained_column.toml", dense)),
      two(SceneRun("cases/verification/undrained_limit.toml", without_damping));
  const double swing = 0.5 - one.lowest();
  REQUIRE(swing > 1e-4);  // 0.12 mm, three times to and fro
  double square = 0, count = 0;
  for (std::size_t i = 1; i + 1 < one.times.size(); ++i, ++count)
    square += std::pow(two(one.times[i]) - one.values[i], 2);
  CHECK(std::sqrt(square / count) < 0.01 * swing);
}

TEST_CASE("With gas in its water, at the pressure of the end of the step, it sinks as undrained soil with gas does") {
  // That one is explicit, with another law. Short steps: implicit Euler takes 13 % of the swing in a second at C = 0.5.
  const std::vector<std::string> swings{"time.end=0.7", "output.history_interval=0.01", "solver.damping_rate=0",
                                        "grid.spacing=0.25"};
  std::vector<std::string> short_steps = swings;
  short_steps.push_back("solver.courant=0.05");
  const Heights one(SceneRun("cases/verification/gas_in_pores.toml", swings)),
      two(SceneRun("cases/verification/gas_in_implicit_pores.toml", short_steps));
  const double swing = 5 - one.lowest();
  REQUIRE(swing > 0.2);
  for (std::size_t i = 1; i + 1 < one.times.size(); ++i)
    CHECK(two(one.times[i]) == within(one.values[i], 0.02 * swing));
}

TEST_CASE("A bag of coupled sand that lets no water through falls as a bag of undrained sand, torn or not") {
  // From 1.3 s on its sand opens and flows. With the pressure of particles its effective stress grew: at h = 0.25 m it
  // fell 19 % too fast.
  const std::vector<std::string> both{"grid.spacing=0.5", "time.end=2.0", "output.frame_interval=2.0",
                                      "contacts.0.stiffness=1.5"};
  std::vector<std::string> as_undrained = both, as_coupled = both;
  as_undrained.insert(as_undrained.end(), {"solver.blend_rate=3.0", "bodies.container.implicit_pore_pressure=true"});
  as_coupled.insert(as_coupled.end(),
                    {"grid.refine=[]", "materials.sand.void_memory=false", "materials.sand.hydraulic_conductivity=1e-9",
                     "membranes.geotextile.permittivity=0", "materials.pore_water.bulk_modulus=22.5e6"});
  const SceneRun undrained("cases/dump_kekerdom_undrained.toml", as_undrained);
  const SceneRun coupled("cases/dump_kekerdom.toml", as_coupled);
  REQUIRE(undrained.outcome().code == 0);
  REQUIRE(coupled.outcome().code == 0);
  const std::vector<double> times = undrained.column("time_s"), others = coupled.column("time_s");
  const auto one = [&](const char* column, double t) { return at(times, undrained.column(column), t); };
  const auto other = [&](const char* column, double t) { return at(others, coupled.column(column), t); };
  for (const double t : {0.5, 1.0, 1.5, 1.99}) {
    CAPTURE(t);
    const char* speed = "container.velocity_y_m_s";
    CHECK(other(speed, t) == near(one(speed, t), 0.02));
    // Undrained soil has the pressure of its pores and its effective stress in one.
    const char* pressure = "container.mean_pressure_centre_Pa";
    CHECK(other("pore_water.mean_pressure_centre_Pa", t) + other(pressure, t) == near(one(pressure, t), 0.05));
    CHECK(other(pressure, t) < 9e3);  // 5 kPa at the start, 7.3 at the end, 10.7 of particles
  }
}

TEST_CASE("The time step of coupled soil does not depend on its conductivity") {
  const auto time_step = [](const std::string& k) {
    return line(run_program({"info", geodrop::source_path("cases/verification/terzaghi.toml"), "--set",
                             "materials.soil.hydraulic_conductivity=" + k})
                    .out,
                "time_step_s");
  };
  const std::string of_gravel = time_step("1e-2");
  REQUIRE(contains(of_gravel, "time_step_s"));
  for (const char* k : {"1e-3", "1e-4", "1e-5", "1e-6"}) CHECK(time_step(k) == of_gravel);
}

TEST_CASE("Water in the pores cavitates at its suction limit, and nowhere below") {
  // A column thrown upwards off its wall: the suction that would hold it is some 100 kPa.
  const auto least_pressure = [](const std::string& cutoff) {
    const SceneRun run("cases/verification/terzaghi.toml",
                       {"materials.water.tension_cutoff=" + cutoff, "time.end=0.02", "output.history_interval=0.0005",
                        "bodies.soil.initial_stress={type='zero'}", "bodies.pore_water.initial_stress={type='zero'}",
                        "bodies.soil.initial_velocity={type='uniform',value=[0.0,1.0]}",
                        "bodies.pore_water.initial_velocity={type='uniform',value=[0.0,1.0]}",
                        "bodies.free_water.initial_velocity={type='uniform',value=[0.0,1.0]}",
                        "probes=[{name='worst',type='extremes',body='pore_water'}]"});
    const std::vector<double> least = run.column("worst.pressure_min_Pa");
    return *std::min_element(least.begin(), least.end());
  };
  CHECK(least_pressure("inf") < -1e5);
  CHECK(least_pressure("5e3") == -5e3);
}

TEST_CASE("A dense column under oil sucks and stays, a loose one raises the pressure and runs out") {
  const std::string scene = "cases/verification/submerged_column_";
  const SceneRun dense(scene + "dense.toml", {"time.end=0.5"}), loose(scene + "loose.toml", {"time.end=0.5"});
  const std::vector<double> times = dense.column("time_s"), others = loose.column("time_s");
  const std::vector<double> sucked = dense.column("base.pressure_mean_Pa"),
                            raised = loose.column("base.pressure_mean_Pa");
  const double still = sucked[0];
  CHECK(raised[0] == near(still, 1e-12));
  CHECK(at(times, sucked, 0.4) < still - 20);
  CHECK(at(others, raised, 0.1) > still + 100);
  CHECK(dense.column("heap.right_m").back() < 0.065);
  CHECK(loose.column("heap.right_m").back() > 0.095);
}

TEST_CASE("Sand without cohesion rests below the critical gradient; above it rises with the rest of the flow") {
  const auto rise = [](const std::string& pump) {
    const SceneRun run(
        "cases/verification/quick_condition.toml",
        {"grid.spacing=0.1", "time.end=3.0", "materials.soil.cohesion=0.0", "materials.soil.tension_cutoff=0.0",
         "materials.soil.poissons_ratio=0.3333", "bodies.base.initial_stress.k0=0.5",
         "bodies.soil.initial_stress.k0=0.5", "pumps.feed.rate=" + pump});
    const std::vector<double> heights = run.column("soil.position_y_m"), times = run.column("time_s");
    return (at(times, heights, 2.9) - at(times, heights, 2.0)) / 0.9;
  };
  // 0.2 m k i, i = 0.9 and 1.1 of i_c = 0.99. Beyond it q - k i_c = 0.099 mm/s is more than the weight lets through.
  CHECK(std::abs(rise("0.0001782")) < 5e-6);
  CHECK(rise("0.0002178") == near(9.9e-5, 0.3));
}

TEST_CASE("A bag of saturated sand has the same shape under 10 m and under 100 m of water") {
  const auto under = [](const std::string& depth) {
    std::vector<std::string> settings{"grid.spacing=0.2", "grid.upper=[3.0,4.0]",
                                      "time.end=1.0",     "materials.water.sound_speed=200.0",
                                      "results=",         "verify=",
                                      "variants="};
    for (const char* body : {"water", "pore_water"})
      settings.push_back("bodies." + std::string(body) + ".initial_stress.surface=" + depth);
    settings.push_back("bodies.ground.initial_stress.fluid_surface=" + depth);
    return SceneRun("cases/verification/saturated_bag_rests.toml", settings);
  };
  const SceneRun shallow = under("10.0"), deep = under("100.0");
  REQUIRE(shallow.outcome().code == 0);
  REQUIRE(deep.outcome().code == 0);
  const auto end = [](const SceneRun& run, const char* column) { return run.column(column).back(); };
  CHECK(end(shallow, "sand.height_m") < 0.85);
  CHECK(end(shallow, "sand.width_m") > shallow.column("sand.width_m").front() + 1e-3);  // it has settled
  for (const char* column : {"sand.height_m", "sand.width_m", "geotextile.area_m2"})
    CHECK(end(deep, column) == near(end(shallow, column), 0.002));
  const char* pores = "pore_water.mean_pressure_centre_Pa";
  CHECK(end(deep, pores) - end(shallow, pores) == near(90 * 1000 * 9.81, 0.03));  // 2 % of it: water is compressed
}

TEST_CASE("A bag lies down on a coupled bed within a second: the film of water below it leaves") {
  const SceneRun run("cases/verification/bag_on_coupled_bed.toml",
                     {"grid.spacing=0.2", "time.end=1.0", "results=", "verify=", "variants="});
  REQUIRE(run.outcome().code == 0);
  CHECK(run.column("sand.lowest_m").front() > 0.02);
  CHECK(run.column("sand.lowest_m").back() < 0.01);  // 0.055 m with the film dragged as water in the pores is
  CHECK(run.column("geotextile.bed_force_y_N_m").back() > 4e3);
}

TEST_CASE(
    "A quarter of a bag in space, between planes of symmetry, lies down on a coupled bed, and the water comes to "
    "rest") {
  const SceneRun run("cases/verification/bag_on_coupled_bed_3d.toml",
                     {"grid.spacing=0.2", "time.end=0.7", "results=", "verify=", "variants="});
  REQUIRE(run.outcome().code == 0);
  CHECK(run.column("sand.lowest_m").front() > 0.02);
  CHECK(run.column("sand.lowest_m").back() < 0.01);
  CHECK(run.column("geotextile.bed_force_z_N").back() == near(8766, 0.25));  // it still bounces a little
  // 0.18 m/s where rows at the planes of symmetry were left out.
  CHECK(run.column("water.velocity_rms_m_s").back() < 0.08);
}

TEST_CASE(
    "A bag sinks onto a coupled bed through water of its real stiffness, whose pressure is implicit, as through softer "
    "water") {
  const auto landing = [](std::vector<std::string> settings) {
    settings.insert(settings.end(), {"grid.spacing=0.2", "time.end=0.4", "results=", "verify=", "variants="});
    const SceneRun run("cases/verification/bag_on_coupled_bed.toml", settings);
    REQUIRE(run.outcome().code == 0);  // nodes of small mass that keep their impulses break it in 7 steps
    return run.column("sand.position_y_m").back();
  };
  const double stiff =
      landing({"bodies.water.implicit_pore_pressure=true", "bodies.pore_water.implicit_pore_pressure=true",
               "materials.water.sound_speed=", "materials.water.bulk_modulus=2.13e9"});
  CHECK(stiff == near(landing({}), 5e-3));
}

TEST_CASE("Stretched cloth twice as open lets through what the closed form of that permittivity says") {
  const auto inflow = [](std::vector<std::string> settings) {
    settings.insert(settings.end(), {"grid.spacing=0.2", "membranes.fabric.slack=-0.1",
                                     "membranes.fabric.axial_stiffness=10.0", "membranes.fabric.mass_per_area=0.1",
                                     "membranes.fabric.strength=1e3", "membranes.fabric.permittivity=2e-3"});
    const SceneRun run("cases/verification/seepage_through_fabric.toml", settings);
    REQUIRE(run.outcome().code == 0);
    return run.result("late_inflow_m2_s");
  };
  constexpr double exact = 1.566888e-3;  // Carslaw & Jaeger 1959, section 7.7, with psi = 4e-3 1/s
  CHECK(inflow({"membranes.fabric.permittivity_strains=[0.0, 0.05]",
                "membranes.fabric.permittivity_factors=[1.0, 2.0]"}) == near(exact, 0.03));
  CHECK(inflow({}) < 0.95 * exact);
}

TEST_CASE("The largest tension of a round container that opens hangs on neither segments nor history") {
  const auto tension = [](std::vector<std::string> settings) {
    settings.insert(settings.end(), {"grid.spacing=0.5", "time.end=2.2"});
    const SceneRun run("cases/dump_round_container.toml", settings);
    REQUIRE(run.outcome().code == 0);
    return run.result("peak_tension_fall_N_m");
  };
  const double usual = tension({});
  CHECK(usual > 20e3);
  CHECK(tension({"membranes.geotextile.segments_per_cell=2"}) == near(usual, 0.04));
  CHECK(tension({"membranes.geotextile.segments_per_cell=8"}) == near(usual, 0.04));
  CHECK(tension({"output.history_interval=0.05"}) == near(usual, 0.01));
}
