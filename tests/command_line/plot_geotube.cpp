// geodrop plot of what a geotube probe left: each panel shows the numbers of its own columns.
#include <doctest/doctest.h>

#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;

TEST_CASE("plot draws outline, pressure and tension of a geotube, each from its columns, with the exact tube") {
  const geodrop::TemporaryDirectory directory;
  std::ofstream(directory / "history.csv") << "time_s,fill.velocity_x_m_s\n0,0\n1,0.5\n";
  std::ofstream(directory / "geotube_tube_outline.csv") << "x_m,y_m,tension_N_m\n0,0,10000\n3,0,20000\n3,4,30000\n";
  std::ofstream(directory / "geotube_tube_pressure.csv") << "height_m,pressure_Pa\n0,700\n4,100\n";
  std::ofstream(directory / "geotube_tube_exact.csv")
      << "x_m,y_m,pressure_Pa,tension_N_m\n0,0,600,25000\n3,0,600,25000\n3,4,200,25000\n";
  const Outcome outcome = run_program({"plot", directory / ""});
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "geotube_tube.svg"));
  const std::string svg = geodrop::read_file(directory / "geotube_tube.svg");
  for (const char* text : {"Outline", "Pressure of the fill", "Tension", "simulated", "exact", "particles"})
    CHECK(contains(svg, text));
  CHECK(contains(svg, "tension [kN/m]"));
  CHECK(contains(svg, "> 30<"));  // the highest tension
  CHECK(contains(svg, "> 10<"));
  CHECK(contains(svg, "> 700<"));  // the highest pressure
  CHECK(contains(svg, "> 7<"));    // 3 m and 4 m along the membrane
  for (const char* tick : {"> 35<", "> 800<", "> 8<"}) CHECK_FALSE(contains(svg, tick));
}
