// geodrop plot: the picture of a run that was just made.
#include <doctest/doctest.h>

#include "support/program.hpp"

using namespace geodrop::test;

namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t number = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++number;
  return number;
}

}  // namespace

TEST_CASE("plot draws position, velocity, tension and energy of a run, and follows its values") {
  const SceneRun run("cases/dump_kekerdom.toml", {"grid.spacing=0.5", "time.end=0.1"});
  REQUIRE(run.outcome().code == 0);
  const std::string directory = run.file("").string();
  const Outcome outcome = run_program({"plot", directory});
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(contains(outcome.out, "history.svg"));
  const std::string svg = geodrop::read_file(run.file("history.svg"));
  for (const char* text : {"Position", "Velocity", "Membrane tension", "Energy since the start", "container.velocity_y",
                           "geotextile.tension_max", "geotextile.tension_mean", "kinetic", "velocity [m/s]"})
    CHECK(contains(svg, text));
  // Three bodies in two directions, twice; two tensions; six energies.
  CHECK(count(svg, "<title>gnuplot_plot_") == 6 + 6 + 2 + 6);

  CHECK(run_program({"plot", directory, "--format", "png"}).code == 0);
  CHECK(geodrop::read_file(run.file("history.png")).starts_with("\x89PNG"));

  std::string history = geodrop::read_file(run.file("history.csv"));
  const std::size_t last = history.rfind('\n', history.size() - 2) + 1;
  history.replace(last, history.find(',', last) - last, "0.2");  // the last row at twice the time
  std::ofstream(run.file("history.csv")) << history;
  CHECK(run_program({"plot", directory}).code == 0);
  CHECK(geodrop::read_file(run.file("history.svg")) != svg);

  // The next run into the directory takes the pictures away: they would show another one.
  CHECK(run_program(run.arguments({})).code == 0);
  CHECK_FALSE(std::filesystem::exists(run.file("history.svg")));
  CHECK_FALSE(std::filesystem::exists(run.file("history.png")));
}

TEST_CASE("plot draws energies from where they began") {
  const geodrop::TemporaryDirectory directory;
  std::ofstream(directory / "history.csv") << "time_s,energy.total_J\n0,1e6\n1,1000004\n";
  CHECK(run_program({"plot", directory / ""}).code == 0);
  const std::string svg = geodrop::read_file(directory / "history.svg");
  CHECK(contains(svg, "> 4<"));  // the highest tick; gnuplot sets a blank before
  CHECK_FALSE(contains(svg, "1e+06"));
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
