// geodrop geotube: what it prints, writes and refuses.
#include <doctest/doctest.h>

#include <filesystem>

#include "plot/csv_table.hpp"
#include "support/calculator.hpp"

using namespace geodrop::test;

namespace {

Outcome geotube(const Words& more) {
  return run_program(Words{"geotube", "--perimeter", "9.2", "--unit-weight", "12e3"} + more);
}

}  // namespace

TEST_CASE("A tube from its area: every result with its unit, and what was assumed") {
  const Outcome outcome = geotube({"--area", "5.56"});
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(line(outcome.out, "axial stiffness") == "axial stiffness not given inextensible");
  CHECK(line(outcome.out, "water level") == "water level none dry");
  CHECK(line(outcome.out, "area") == "area 5.56 m2");
  CHECK(line(outcome.out, "height ") == "height 1.812 m");
  CHECK(line(outcome.out, "width") == "width 3.657 m");
  CHECK(line(outcome.out, "height / width") == "height / width 0.4954 -");
  CHECK(line(outcome.out, "base width") == "base width 2.522 m");
  CHECK(line(outcome.out, "top pressure") == "top pressure 4712 Pa");
  CHECK(line(outcome.out, "bottom pressure") == "bottom pressure 26452 Pa");
  CHECK(line(outcome.out, "tension") == "tension 14115 N/m");
  CHECK_FALSE(contains(outcome.out, "safety"));  // no strength, no safety
}

TEST_CASE("Every known quantity, stiffness and water are taken") {
  CHECK(line(geotube({"--height", "1.811713473008"}).out, "area") == "area 5.56 m2");
  CHECK(line(geotube({"--pressure", "4711.8942414095"}).out, "area") == "area 5.56 m2");
  CHECK(line(geotube({"--tension", "14115.218265111"}).out, "area") == "area 5.56 m2");
  const Outcome soft = geotube({"--area", "5.56", "--stiffness", "1e6"});
  CHECK(line(soft.out, "axial stiffness") == "axial stiffness 1000000 N/m");
  CHECK(line(soft.out, "height / width") == "height / width 0.47 -");
  const Outcome wet = geotube({"--area", "5.56", "--water-level", "0.905856736504", "--water-unit-weight", "9810"});
  CHECK(line(wet.out, "height ").starts_with("height 1.785"));
  CHECK(line(wet.out, "fill pressure bottom").starts_with("fill pressure bottom 24230"));
}

TEST_CASE("Safety: strength, seam and reduction factors, each that is not given said to be 1") {
  const Outcome outcome =
      geotube({"--area", "5.56", "--strength", "120e3", "--seam-efficiency", "0.7", "--reduction-installation", "1.3",
               "--reduction-creep", "1.5", "--reduction-durability", "1.1"});
  CHECK(line(outcome.out, "reduction, installation") == "reduction, installation 1.3 -");
  CHECK(line(outcome.out, "reduction, seam") == "reduction, seam not given: 1 -");
  CHECK(line(outcome.out, "allowable tension") == "allowable tension 39161 N/m");  // 84000 / 2.145
  CHECK(line(outcome.out, "factor of safety") == "factor of safety 2.774 -");
  CHECK(line(outcome.out, "utilisation") == "utilisation 0.3604 -");
  const Outcome seam = geotube({"--area", "5.56", "--strength", "120e3", "--reduction-seam", "2"});
  CHECK(line(seam.out, "allowable tension") == "allowable tension 60000 N/m");
}

TEST_CASE("A table has a row for each value, both ends included") {
  const geodrop::TemporaryDirectory directory;
  const Outcome outcome =
      geotube({"--table", "height=0.5:2.5:0.1", "--strength", "120e3", "--output", directory / "tubes"});
  CHECK(outcome.code == 0);
  const geodrop::CsvTable table = geodrop::read_csv(directory / "tubes" / "geotube.csv");
  REQUIRE(table.rows() == 21);
  CHECK(std::abs(table.column("height_m").front() - 0.5) < 1e-9);
  CHECK(std::abs(table.column("height_m").back() - 2.5) < 1e-9);
  for (std::size_t i = 1; i < 21; ++i) CHECK(table.column("tension_N_m")[i] > table.column("tension_N_m")[i - 1]);
  for (std::size_t i = 0; i < 21; ++i)
    CHECK(std::abs(table.column("factor_of_safety_ratio")[i] * table.column("tension_N_m")[i] - 120e3) < 1e-3);
  CHECK(contains(line(outcome.out, "area"), "height width"));
  CHECK(contains(outcome.out, "[N/m]"));
  CHECK(std::filesystem::exists(directory / "tubes" / "outline.svg"));
  CHECK_FALSE(std::filesystem::exists(directory / "tubes" / "outline.csv"));  // which of the 21?
}

TEST_CASE("Files have the digits that the lists leave out") {
  const geodrop::TemporaryDirectory directory;
  const auto table = [&](const Words& more) {
    CHECK(geotube(Words{"--area", "5.56", "--output", directory / "tube"} + more).code == 0);
    return geodrop::read_csv(directory / "tube" / "geotube.csv");
  };
  check_columns(table({"--strength", "120e3", "--seam-efficiency", "0.7", "--reduction-installation", "1.3",
                       "--reduction-creep", "1.5", "--reduction-durability", "1.1"}),
                {{"height_m", 1.811713473},
                 {"width_m", 3.656813639},
                 {"height_to_width_ratio", 0.4954350021},
                 {"base_width_m", 2.522261079},
                 {"pressure_top_Pa", 4711.894241},
                 {"pressure_bottom_Pa", 26452.45592},
                 {"tension_N_m", 14115.21827},
                 {"allowable_tension_N_m", 39160.83916},
                 {"factor_of_safety_ratio", 2.774370075},
                 {"utilisation_ratio", 0.3604421807}});
  check_columns(table({"--stiffness", "1e6"}), {{"height_to_width_ratio", 0.46997898}});
  check_columns(table({"--water-level", "0.905856736504", "--water-unit-weight", "9810"}),
                {{"height_m", 1.7853567625}, {"fill_pressure_bottom_Pa", 24229.53834}});
}

TEST_CASE("--output leaves results, outline and picture, and replaces only its own") {
  const geodrop::TemporaryDirectory directory;
  const std::string output = directory / "tube";
  CHECK(geotube({"--area", "5.56", "--output", output, "--segments", "100"}).code == 0);
  const geodrop::CsvTable results = geodrop::read_csv(directory / "tube" / "geotube.csv");
  CHECK(results.rows() == 1);
  CHECK(std::abs(results.column("width_m")[0] - 3.6568136390458) < 1e-11);
  const geodrop::CsvTable outline = geodrop::read_csv(directory / "tube" / "outline.csv");
  CHECK(outline.names == std::vector<std::string>{"s_m", "x_m", "z_m", "theta_rad", "pressure_Pa"});
  REQUIRE(outline.rows() == 101);
  CHECK(std::abs(outline.column("s_m")[25] - 2.3) < 1e-9);
  CHECK(std::abs(outline.column("z_m")[0] - 1.811713473008) < 1e-11);
  CHECK(contains(geodrop::read_file(directory / "tube" / "outline.svg"), "A = 5.56 m2, H = 1.812 m"));
  CHECK(geotube({"--area", "3.36", "--output", output}).code == 0);
  CHECK(geodrop::read_csv(directory / "tube" / "outline.csv").rows() == 401);

  std::ofstream(directory / "letter.txt") << "dear reader";
  check_refused(geotube({"--area", "5.56", "--output", directory / ""}),
                "--output: found a directory with other files in it");
  CHECK_FALSE(std::filesystem::exists(directory / "geotube.csv"));
}

TEST_CASE("Mistakes name the option, what was found and what is allowed") {
  const std::string one = "exactly one of --area, --height, --pressure, --tension, --table";
  check_refused(geotube({}), "found nothing; allowed: " + one);
  check_refused(geotube({"--area", "5", "--height", "2"}), "found --area and --height; allowed: " + one);
  check_refused(geotube({"--area", "7"}), "--area: found 7; allowed: less than 6.73543719 m2, the area of the circle");
  check_refused(geotube({"--area", "-1"}), "--area: found -1; allowed: an area > 0 [m2]");
  check_refused(geotube({"--area", "big"}), "--area: found big; allowed: an area > 0 [m2]");
  check_refused(geotube({"--area", "5", "--stiffness", "-1e6"}),
                "--stiffness: found -1e6; allowed: a stiffness > 0 [N/m]");
  check_refused(geotube({"--area", "5", "--water-level", "1"}), "found one of them; allowed: both or none");
  check_refused(geotube({"--area", "5", "--water-level", "4", "--water-unit-weight", "13e3"}),
                "--water-level: found 4; allowed:");
  check_refused(geotube({"--area", "5", "--reduction-creep", "1.5"}), "found no --strength");
  check_refused(geotube({"--area", "5", "--strength", "1e5", "--reduction-creep", "0.9"}),
                "--reduction-creep: found 0.9; allowed: a reduction factor >= 1");
  check_refused(geotube({"--area", "5", "--strength", "1e5", "--seam-efficiency", "70"}),
                "--seam-efficiency: found 70; allowed: a number > 0 and at most 1");
  check_refused(geotube({"--table", "height=1:3:0.1"}), "--height: found 3; allowed: less than 2.92845095 m");
  for (const char* table :
       {"height", "width=1:2:0.1", "height=1:2", "height=2:1:0.1", "height=1:2:0", "height=1:2:0.1x"})
    check_refused(geotube({"--table", table}),
                  std::string("--table: found ") + table + "; allowed: QUANTITY=FROM:TO:STEP");
  check_refused(geotube({"--table", "height=1:2:1e-9"}), "allowed: at most 10000 rows");
  CHECK(contains(run_program({"geotube", "--area", "5"}).err, "--perimeter is required"));
}
