// geodrop fall: what it prints, writes and refuses.
#include <doctest/doctest.h>

#include <filesystem>

#include "plot/csv_table.hpp"
#include "support/calculator.hpp"

using namespace geodrop::test;

namespace {

/// The container of Kekerdom.
Outcome kekerdom(const Words& more) {
  const Words container{"fall", "--semi-axes", "3.326767", "0.507698", "--density", "1631", "--water-density", "1000"};
  return run_program(container + more);
}

/// The same by its perimeter and area.
Outcome by_perimeter(const Words& more) {
  const Words container{"fall", "--perimeter", "13.738705", "--density", "1631", "--water-density", "1000"};
  return run_program(container + more);
}

}  // namespace

TEST_CASE("Without a drag only what needs none: start, and the fall that nothing drags") {
  const Outcome start = kekerdom({});
  CHECK(start.code == 0);
  CHECK(start.err.empty());
  CHECK(line(start.out, "added mass coefficient") == "added mass coefficient 0.1526 -");
  CHECK(line(start.out, "initial acceleration") == "initial acceleration 3.471 m/s2");
  CHECK_FALSE(contains(start.out, "velocity"));
  CHECK_FALSE(contains(start.out, "speed"));
  CHECK_FALSE(contains(start.out, "air"));
  const Outcome fall = kekerdom({"--fall-height", "9.8"});
  CHECK(line(fall.out, "without drag: speed on landing") == "without drag: speed on landing 8.248 m/s");
  CHECK(line(fall.out, "without drag: time") == "without drag: time of the fall 2.376 s");
  CHECK_FALSE(contains(fall.out, "\nspeed on landing"));
  CHECK_FALSE(contains(fall.out, "way"));
}

TEST_CASE("A measured velocity: the coefficient it needs, the fall to the bed, its path") {
  const Outcome outcome = kekerdom({"--terminal-velocity", "3.3", "--fall-height", "9.8"});
  CHECK(outcome.code == 0);
  CHECK(line(outcome.out, "width for the drag") == "width for the drag 1.015 m");
  CHECK(line(outcome.out, "drag coefficient") == "drag coefficient 5.941 -");
  CHECK(line(outcome.out, "terminal velocity") == "terminal velocity 3.3 m/s");
  CHECK(line(outcome.out, "time scale") == "time scale 0.9509 s");
  CHECK(line(outcome.out, "speed on landing").starts_with("speed on landing 3.297"));
  CHECK(line(outcome.out, "time of the fall").starts_with("time of the fall 3.628"));
  CHECK(line(outcome.out, "0 ") == "0 0 0");
  CHECK(line(outcome.out, "1.814 ").starts_with("1.814 3.88"));  // the fifth of ten steps
  CHECK(line(outcome.out, "3.628 ") == "3.628 9.8 3.297");
  CHECK_FALSE(contains(outcome.out, "tension"));
}

TEST_CASE("A coefficient on a width, air, and a path that ends near the terminal velocity") {
  const Outcome outcome = kekerdom({"--drag-coefficient", "1.2", "--width", "6.653534", "--air", "0.17"});
  CHECK(outcome.code == 0);
  CHECK(line(outcome.out, "density with air") == "density with air 1354 kg/m3");
  CHECK(line(outcome.out, "initial acceleration") == "initial acceleration 2.304 m/s2");
  CHECK(line(outcome.out, "drag coefficient") == "drag coefficient 1.2 -");
  // sqrt(2 * 9.81 * 5.30612785 * 0.35373/(6.653534 * 1.2))
  CHECK(line(outcome.out, "terminal velocity").starts_with("terminal velocity 2.148"));
  CHECK(line(outcome.out, "2.797 ") == "2.797 4.624 2.137");  // three time scales, tanh 3 of the velocity
}

TEST_CASE("The stiffness bounds the tension on landing") {
  const Outcome outcome = kekerdom({"--terminal-velocity", "3.3", "--fall-height", "9.8", "--stiffness", "1e6"});
  CHECK(line(outcome.out, "kinetic energy").starts_with("kinetic energy 51432"));
  CHECK(line(outcome.out, "energy of settling").starts_with("energy of settling, at most 109269"));
  CHECK(line(outcome.out, "tension if the fall").starts_with("tension if the fall is stopped, r.m.s., bound 86528"));
  CHECK(line(outcome.out, "and if it settles").starts_with("and if it settles, r.m.s., bound 152951"));
}

TEST_CASE("The ellipse may be known by perimeter and area") {
  const Outcome outcome = by_perimeter({"--area", "5.306122"});
  CHECK(outcome.code == 0);
  CHECK(line(outcome.out, "semi-axis along the fall").starts_with("semi-axis along the fall 3.327"));
  CHECK(line(outcome.out, "semi-axis across it").starts_with("semi-axis across it 0.5077"));
}

TEST_CASE("Files have the digits that the lists leave out") {
  const geodrop::TemporaryDirectory directory;
  const auto table = [&](const Words& more) {
    CHECK(kekerdom(Words{"--output", directory / "fall"} + more).code == 0);
    return geodrop::read_csv(directory / "fall" / "fall.csv");
  };
  check_columns(table({"--terminal-velocity", "3.3", "--fall-height", "9.8", "--stiffness", "1e6"}),
                {{"added_mass_ratio", 0.1526100265},
                 {"initial_acceleration_m_s2", 3.470551246},
                 {"width_m", 1.015396},
                 {"drag_coefficient_ratio", 5.940770077},
                 {"time_scale_s", 0.9508575918},
                 {"speed_without_drag_m_s", 8.247593857},
                 {"time_without_drag_s", 2.376450676},
                 {"landing_speed_m_s", 3.296801569},
                 {"landing_time_s", 3.628320321},
                 {"kinetic_energy_J_m", 51431.97905},
                 {"settling_energy_J_m", 109269.3756},
                 {"stop_tension_bound_N_m", 86528.40161},
                 {"settling_tension_bound_N_m", 152950.828}});
  check_columns(table({"--drag-coefficient", "1.2", "--width", "6.653534", "--air", "0.17"}),
                {{"density_with_air_kg_m3", 1353.73},
                 {"initial_acceleration_m_s2", 2.303657368},
                 {"terminal_velocity_m_s", 2.14762025}});
  const geodrop::CsvTable path = geodrop::read_csv(directory / "fall" / "path.csv");
  CHECK(path.column("way_m").back() == near(4.62362722, 1e-9));
  CHECK(path.column("speed_m_s").back() == near(2.13699974, 1e-9));
}

TEST_CASE("--output leaves the numbers as CSV, and replaces only its own") {
  const geodrop::TemporaryDirectory directory;
  const std::string output = directory / "fall";
  CHECK(kekerdom({"--terminal-velocity", "3.3", "--fall-height", "9.8", "--output", output}).code == 0);
  const geodrop::CsvTable results = geodrop::read_csv(directory / "fall" / "fall.csv");
  CHECK(results.rows() == 1);
  CHECK(std::abs(results.column("initial_acceleration_m_s2")[0] - 3.470551246103) < 1e-11);
  CHECK(std::abs(results.column("landing_time_s")[0] - 3.62832) < 1e-5);
  const geodrop::CsvTable path = geodrop::read_csv(directory / "fall" / "path.csv");
  REQUIRE(path.rows() == 201);
  CHECK(path.column("way_m")[0] == 0);
  CHECK(std::abs(path.column("way_m")[200] - 9.8) < 1e-10);
  CHECK(std::abs(path.column("time_s")[100] - results.column("landing_time_s")[0] / 2) < 1e-10);
  CHECK(path.column("speed_m_s")[200] == results.column("landing_speed_m_s")[0]);

  CHECK(kekerdom({"--output", output}).code == 0);
  CHECK_FALSE(std::filesystem::exists(directory / "fall" / "path.csv"));  // there was no drag this time
  std::ofstream(directory / "letter.txt") << "dear reader";
  check_refused(kekerdom({"--output", directory / ""}),
                "--output: found a directory with other files in it; allowed: a new directory or one of an earlier "
                "geodrop fall");
  CHECK_FALSE(std::filesystem::exists(directory / "fall.csv"));
}

TEST_CASE("Mistakes of a fall name the option, what was found and what is allowed") {
  CHECK(
      contains(run_program({"fall", "--semi-axes", "3", "1", "--density", "1631"}).err, "--water-density is required"));
  check_refused(kekerdom({"--drag-coefficient", "0"}), "--drag-coefficient: found 0; allowed: a coefficient > 0");
  check_refused(kekerdom({"--air", "1"}), "--air: found 1; allowed: a share >= 0 and < 1");
  check_refused(kekerdom({"--fall-height", "deep"}), "--fall-height: found deep; allowed: a height > 0 [m]");
  check_refused(kekerdom({"--air", "0.4"}),
                "geodrop fall: --air: found 0.4; allowed: less than 0.386879215, with which the container floats");
  check_refused(kekerdom({"--width", "2"}),
                "--width: found no drag; allowed: with --drag-coefficient or --terminal-velocity");
  check_refused(kekerdom({"--drag-coefficient", "1", "--terminal-velocity", "3"}),
                "the drag: found --drag-coefficient and --terminal-velocity; allowed: one of them");
  check_refused(kekerdom({"--stiffness", "1e6", "--fall-height", "9.8"}), "--stiffness: found no drag; allowed: with");
  check_refused(kekerdom({"--stiffness", "1e6", "--drag-coefficient", "1"}), "--stiffness: found no --fall-height");
  check_refused(kekerdom({"--perimeter", "9", "--area", "1"}),
                "the ellipse: found --semi-axes, --perimeter and --area; allowed: either");
  check_refused(run_program({"fall", "--density", "1631", "--water-density", "1000"}), "the ellipse: found nothing");
  check_refused(by_perimeter({}), "--perimeter, --area: found only --perimeter; allowed: all or none");
  check_refused(by_perimeter({"--area", "20"}), "geodrop fall: --area: found 20; allowed: at most 15.02");
  check_refused(run_program({"fall", "--semi-axes", "3", "1", "--density", "990", "--water-density", "1000"}),
                "geodrop fall: --density: found 990; allowed: more than that of the water, 1000 kg/m3");
}
