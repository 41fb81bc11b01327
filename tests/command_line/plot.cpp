// geodrop plot: the picture of a run that was just made.
#include <doctest/doctest.h>

#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;

namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t number = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++number;
  return number;
}

}  // namespace

TEST_CASE("plot draws position, velocity, tension and energy of a run, and follows its values") {
  const SceneRun run("cases/dump_kekerdom_mixture.toml", {"grid.spacing=0.5", "time.end=0.1"});
  REQUIRE(run.outcome().code == 0);
  const std::string directory = run.file("").string();
  const Outcome outcome = run_program({"plot", directory});
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(contains(outcome.out, "history.svg"));
  const std::string svg = geodrop::read_file(run.file("history.svg"));
  for (const char* text :
       {"Position", "Velocity", "Membrane tension", "Energy since the start", "container.velocity_y",
        "geotextile.tension_max", "geotextile.tension_mean", "kinetic", "velocity [m/s]", "tension [kN/m]",
        "change of energy [kJ]", "Geocontainer dumped in water as one mixture", "centre above bed expected, 1.00 m",
        "velocity_y of bed; membrane energy", "strength of geotextile, 120 kN/m"})
    CHECK(contains(svg, text));
  // Water and container downwards, twice, and where it is expected; three tensions; energies but that of the membrane.
  CHECK(count(svg, "<title>gnuplot_plot_") == 2 + 1 + 2 + 3 + 5);

  CHECK(run_program({"plot", directory, "--format", "png"}).code == 0);
  CHECK(geodrop::read_file(run.file("history.png")).starts_with("\x89PNG"));

  std::string history = geodrop::read_file(run.file("history.csv"));
  const std::size_t last = history.rfind('\n', history.size() - 2) + 1;
  history.replace(last, history.find(',', last) - last, "0.2");  // the last row at twice the time
  std::ofstream(run.file("history.csv")) << history;
  CHECK(run_program({"plot", directory}).code == 0);
  CHECK(geodrop::read_file(run.file("history.svg")) != svg);

  // A run that replaces this one takes the pictures away: they would show another one.
  std::ofstream(run.file("section_middle.svg")) << "of a run before";
  std::ofstream(run.file("section_notes.txt")) << "someone's";
  CHECK(run_program(run.arguments({"--overwrite"})).code == 0);
  CHECK_FALSE(std::filesystem::exists(run.file("history.svg")));
  CHECK_FALSE(std::filesystem::exists(run.file("history.png")));
  CHECK_FALSE(std::filesystem::exists(run.file("section_middle.svg")));
  CHECK(std::filesystem::exists(run.file("section_notes.txt")));
}

TEST_CASE("plot draws energies from where they began") {
  const geodrop::TemporaryDirectory directory;
  std::ofstream(directory / "history.csv") << "time_s,energy.total_J\n0,1e6\n1,1000004\n";
  CHECK(run_program({"plot", directory / ""}).code == 0);
  const std::string svg = geodrop::read_file(directory / "history.svg");
  CHECK(contains(svg, "> 4<"));  // the highest tick; gnuplot sets a blank before
  CHECK_FALSE(contains(svg, "1e+06"));
}

namespace {

/// A barge that turns from t = 1 to 3 s, to 20 degrees; its other half sways by 2 degrees meanwhile.
const std::string opening =
    "time_s,fill.rotation_deg,starboard.rotation_deg,starboard.displacement_x_m,port.rotation_deg,port.displacement_x_"
    "m,"
    "middle.soil_force_N_m,middle.membrane_force_N_m\n"
    "0,0,0,0,0,0,77000,0\n"
    "1,90,0,0,0,0,20000,1000\n"
    "2,90,2,0,-10,0,30000,4000\n"
    "3,90,0,0,-20,0,40000,9000\n"
    "4,90,0,0,-20,0,88000,0\n";

}  // namespace

TEST_CASE("plot draws section forces and their difference against the angle of the barge while it opens") {
  const geodrop::TemporaryDirectory directory;
  std::ofstream(directory / "history.csv") << opening;
  const Outcome outcome = run_program({"plot", directory / ""});
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "section_middle.svg"));
  const std::string svg = geodrop::read_file(directory / "section_middle.svg");
  for (const char* text : {"soil", "geotextile", "difference", "angle of port [deg]", "force [kN/m]", "> 20<"})
    CHECK(contains(svg, text));
  CHECK(count(svg, "<title>gnuplot_plot_") == 3);
  CHECK(contains(svg, "> 40<"));  // the highest tick: not the 77 kN/m before, nor the 88 after
  for (const char* more : {"> 45<", "> 50<"}) CHECK_FALSE(contains(svg, more));  // as the sum of forces
  CHECK_FALSE(contains(svg, "> 90<"));                                           // of a body of particles
  CHECK_FALSE(contains(svg, "-20<"));
}

TEST_CASE("plot draws each section against the barge that opens its container") {
  const geodrop::TemporaryDirectory directory;
  std::ofstream(directory / "history.csv")
      << "time_s,first.rotation_deg,first.displacement_x_m,second.rotation_deg,second.displacement_x_m,"
         "one.soil_force_N_m,one.membrane_force_N_m,two.soil_force_N_m,two.membrane_force_N_m\n"
         "0,0,0,0,0,10,1,0,0\n"
         "1,40,0,0,0,20,9,0,0\n"
         "2,40,0,0,0,5,2,9,1\n"
         "3,40,0,40.1,0,5,2,20,9\n";
  CHECK(run_program({"plot", directory / ""}).code == 0);
  CHECK(contains(geodrop::read_file(directory / "section_one.svg"), "angle of first [deg]"));
  CHECK(contains(geodrop::read_file(directory / "section_two.svg"), "angle of second [deg]"));
}

TEST_CASE("plot draws no section where nothing opens or a force is missing") {
  const geodrop::TemporaryDirectory directory;
  std::ofstream(directory / "history.csv") << "time_s,port.rotation_deg,port.displacement_x_m,middle.soil_force_N_m,"
                                              "middle.membrane_force_N_m,a.velocity_x_m_s"
                                              "\n0,5,0,1,1,0\n1,5,0,1,1,1\n";
  CHECK(run_program({"plot", directory / ""}).out == (directory / "history.svg").string() + "\n");
  std::ofstream(directory / "history.csv") << "time_s,port.rotation_deg,port.displacement_x_m,middle.soil_force_N_m,a."
                                              "velocity_x_m_s\n0,5,0,1,0\n1,6,0,1,1\n";
  const Outcome outcome = run_program({"plot", directory / ""});
  CHECK(outcome.code == 0);
  CHECK(outcome.out == (directory / "history.svg").string() + "\n");
}

TEST_CASE("A row of the history that is still being written is left out") {
  const geodrop::TemporaryDirectory directory;
  const auto picture = [&](const std::string& last) {
    std::ofstream(directory / "history.csv") << "time_s,a.velocity_x_m_s\n0,0\n1,1.5\n" << last;
    CHECK(run_program({"plot", directory / ""}).code == 0);
    return geodrop::read_file(directory / "history.svg");
  };
  const std::string whole = picture("");
  CHECK(picture("2,1") == whole);  // of 2,1.75
  CHECK(picture("2") == whole);
  CHECK(picture("2,1.75\n") != whole);
}

TEST_CASE("plot says what is missing") {
  const geodrop::TemporaryDirectory directory;
  const auto check = [&](const std::string& says) {
    const Outcome outcome = run_program({"plot", directory / ""});
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, says));
  };
  check("history.csv: found no such file; allowed: the history of a run");
  std::ofstream(directory / "history.csv") << "time_s,step\n";
  check("found no row of numbers");
  std::ofstream(directory / "history.csv") << "time_s,step\n0,0\n";
  check("found no column that is drawn");
  std::ofstream(directory / "history.csv") << "time_s,bag.velocity_x_m_s\n0,fast\n";
  check("history.csv:2:3: found \"fast\"; allowed: a number");
  CHECK(run_program({"plot", directory / "", "--format", "gif"}).code == 2);
}
