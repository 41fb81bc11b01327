// geodrop release: what it prints, writes and refuses.
#include <doctest/doctest.h>

#include <filesystem>

#include "plot/csv_table.hpp"
#include "support/calculator.hpp"

using namespace geodrop::test;

namespace {

/// The worked example of CUR 217, in water.
Outcome example(const Words& more) {
  const Words arguments{"release", "--perimeter",     "18.3", "--area", "10.8", "--density",
                        "1990",    "--water-density", "1000"};
  return run_program(arguments + more);
}

/// 9 m2 at 18 kN/m3 in air.
Outcome in_air(const Words& more) {
  const Words arguments{"release",   "--perimeter",     "15.77",           "--area", "9",
                        "--density", "1834.8623853211", "--water-density", "0"};
  return run_program(arguments + more);
}

const Words barge{"--hinge-radius", "2.8", "--wall-slope", "35", "--friction", "0.3"};

}  // namespace

TEST_CASE("The worked example in water: rule, tension, terminal velocity, each with its unit") {
  const Outcome outcome = example({"--opening-width", "3", "--volume", "320", "--frontal-area", "100",
                                   "--drag-coefficient", "1", "--strength", "94399.668"});
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(line(outcome.out, "opening rule") == "opening rule met perimeter >= 2.5 (A/b0 + b0)");
  CHECK(line(outcome.out, "smallest perimeter") == "smallest perimeter 16.5 m");
  CHECK(line(outcome.out, "best opening width") == "best opening width 3.286 m");
  CHECK(line(outcome.out, "tension at opening") == "tension at opening 47200 N/m");
  CHECK(line(outcome.out, "utilisation") == "utilisation 0.5 -");
  CHECK(line(outcome.out, "factor of safety") == "factor of safety 2 -");
  CHECK(line(outcome.out, "terminal velocity") == "terminal velocity 7.884 m/s");
  CHECK_FALSE(contains(outcome.out, "force of a wall"));  // no barge
  CHECK_FALSE(contains(outcome.out, "fall"));
}

TEST_CASE("A barge in air: forces against the angle from closed to open, neutral height, fall") {
  const Outcome outcome = in_air(barge + Words{"--opening-angle", "35", "--fall-height", "8"});
  CHECK(outcome.code == 0);
  CHECK(line(outcome.out, "opening width") == "opening width 3.212 m");  // 5.6 sin 35
  CHECK(line(outcome.out, "weight less buoyancy") == "weight less buoyancy 162000 N/m");
  CHECK(line(outcome.out, "neutral height") == "neutral height 0.9212 m");
  CHECK(line(outcome.out, "speed after the fall") == "speed after the fall 12.53 m/s");
  CHECK(line(outcome.out, "time of the fall") == "time of the fall 1.277 s");
  CHECK(line(outcome.out, "0 0 ") == "0 0 35 26789");
  CHECK(line(outcome.out, "14 ") == "14 1.355 49 51208");  // 81 kN/m tan(49 - 16.6992 degrees)
  CHECK(line(outcome.out, "35 ").starts_with("35 3.212 70 "));
}

TEST_CASE("The opening may be a width, too, and is the best one if none is known") {
  CHECK(line(in_air(barge + Words{"--opening-width", "2.8"}).out, "opening angle") == "opening angle 30 deg");
  const Outcome best = in_air({});
  CHECK(line(best.out, "opening width") == "opening width 3 m");
  CHECK(contains(best.out, "for the best opening, none was given"));
  CHECK_FALSE(contains(in_air({"--opening-width", "3"}).out, "none was given"));
}

TEST_CASE("The opening rule is met or not, and friction may hold a container") {
  CHECK(line(in_air({"--opening-width", "2.4"}).out, "opening rule").starts_with("opening rule met"));      // 15.375 m
  CHECK(line(in_air({"--opening-width", "2.1"}).out, "opening rule").starts_with("opening rule NOT MET"));  // 15.964
  const Outcome rough =
      in_air({"--hinge-radius", "2.8", "--wall-slope", "35", "--friction", "1", "--opening-angle", "25"});
  CHECK(line(rough.out, "5 ").ends_with("40 friction holds"));
  CHECK_FALSE(line(rough.out, "15 ").ends_with("friction holds"));
}

TEST_CASE("Files have the digits that the lists leave out") {
  const geodrop::TemporaryDirectory directory;
  const Words output{"--output", directory / "barge"};
  CHECK(example(output +
                Words{"--opening-width", "3", "--volume", "320", "--frontal-area", "100", "--drag-coefficient", "1"})
            .code == 0);
  check_columns(geodrop::read_csv(directory / "barge" / "release.csv"), {{"best_opening_width_m", 3.286335345},
                                                                         {"opening_tension_N_m", 47199.834},
                                                                         {"terminal_velocity_m_s", 7.883917808}});
  CHECK(in_air(barge + output + Words{"--opening-angle", "35", "--fall-height", "8"}).code == 0);
  check_columns(geodrop::read_csv(directory / "barge" / "release.csv"), {{"opening_width_m", 3.212028044},
                                                                         {"neutral_height_m", 0.9211717993},
                                                                         {"fall_speed_m_s", 12.52836781},
                                                                         {"fall_time_s", 1.277101714}});
  const geodrop::CsvTable forces = geodrop::read_csv(directory / "barge" / "wall_force.csv");
  CHECK(forces.column("wall_force_N_m").at(2) == near(51207.6, 1e-6));  // 81 kN/m tan(49 - 16.6992 degrees)
  CHECK(forces.column("opening_width_m").at(2) == near(1.35476, 5e-6));
}

TEST_CASE("--output leaves the numbers as CSV, and replaces only its own") {
  const geodrop::TemporaryDirectory directory;
  const std::string output = directory / "barge";
  CHECK(in_air(barge + Words{"--opening-angle", "20", "--output", output}).code == 0);
  const geodrop::CsvTable results = geodrop::read_csv(directory / "barge" / "release.csv");
  CHECK(results.rows() == 1);
  CHECK(results.column("opening_rule_met")[0] == 0);  // 16.5 m are needed at 1.9 m
  CHECK(std::abs(results.column("opening_tension_N_m")[0] - 72900) < 1e-3);
  CHECK(std::abs(results.column("wall_slope_deg")[0] - 35) < 1e-9);
  const geodrop::CsvTable forces = geodrop::read_csv(directory / "barge" / "wall_force.csv");
  REQUIRE(forces.rows() == 6);
  CHECK(std::abs(forces.column("angle_deg")[1] - 4) < 1e-9);
  CHECK(std::abs(forces.column("wall_force_N_m")[0] - 26789.4) < 0.05);
  CHECK(std::abs(forces.column("opening_width_m")[5] - results.column("opening_width_m")[0]) < 1e-11);

  CHECK(in_air({"--output", output}).code == 0);
  CHECK_FALSE(std::filesystem::exists(directory / "barge" / "wall_force.csv"));  // there was no barge this time
  std::ofstream(directory / "letter.txt") << "dear reader";
  check_refused(in_air({"--output", directory / ""}),
                "--output: found a directory with other files in it; allowed: a new directory or one of an earlier "
                "geodrop release");
  CHECK_FALSE(std::filesystem::exists(directory / "release.csv"));
}

TEST_CASE("Mistakes name the option, what was found and what is allowed") {
  CHECK(contains(run_program({"release", "--perimeter", "15"}).err, "--area is required"));
  check_refused(in_air({"--fall-height", "0"}), "--fall-height: found 0; allowed: a height > 0 [m]");
  check_refused(in_air({"--strength", "strong"}), "--strength: found strong; allowed: a strength > 0 [N/m]");
  check_refused(in_air({"--wall-slope", "90"}), "--wall-slope: found 90; allowed: an angle > 0 and < 90 [deg]");
  check_refused(in_air({"--friction", "-1"}), "--friction: found -1; allowed: a coefficient >= 0");
  check_refused(
      in_air({"--hinge-radius", "2.8", "--friction", "0.3"}),
      "--hinge-radius, --wall-slope, --friction: found only --hinge-radius and --friction; allowed: all or none");
  check_refused(in_air(barge), "found nothing; allowed: --opening-angle or --opening-width");
  check_refused(in_air(barge + Words{"--opening-angle", "30", "--opening-width", "3"}), "allowed: one of them");
  check_refused(in_air({"--opening-angle", "30"}), "--opening-angle: found no barge; allowed: with --hinge-radius");
  check_refused(in_air(barge + Words{"--opening-angle", "60"}),
                "--opening-angle: found 60; allowed: less than 55 deg, where the walls stand upright");
  check_refused(in_air(barge + Words{"--opening-width", "5"}),
                "--opening-width: found 5 (each half at 63.2344994 deg); allowed: less than 55 deg");
  check_refused(in_air(barge + Words{"--opening-width", "6"}), "--opening-width: found 6; allowed: from 0 to 5.6 m");
  check_refused(example({"--fall-height", "8"}), "--fall-height: found --water-density 1000; allowed: a fall in air");
  check_refused(example({"--volume", "320"}), "found only --volume; allowed: all or none");
  check_refused(in_air({"--volume", "320", "--frontal-area", "100", "--drag-coefficient", "1"}),
                "--water-density: found 0 with --volume; allowed: a density > 0 [kg/m3]");
  check_refused(
      run_program({"release", "--perimeter", "10", "--area", "9", "--density", "1990", "--water-density", "0"}),
      "--area: found 9; allowed: at most 7.95774715 m2");
  check_refused(
      run_program({"release", "--perimeter", "18", "--area", "9", "--density", "990", "--water-density", "1000"}),
      "--density: found 990; allowed: more than the density around the container, 1000 kg/m3");
}
