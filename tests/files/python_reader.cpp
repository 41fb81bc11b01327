// paraview/geodrop.py reads what a run wrote, plain and compressed. Without Python and numpy there is nothing to test.
#include <doctest/doctest.h>

#include <sstream>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop::test;

namespace {

const std::string python = "/usr/bin/python3";

std::string ask_python(const std::string& code, const std::filesystem::path& directory) {
  const std::string file = directory / "said";
  std::ofstream(directory / "ask.py") << "import sys\nsys.dont_write_bytecode = True\nsys.path.insert(0, '"
                                      << geodrop::source_path("paraview") << "')\n"
                                      << code;
  const std::string command = python + " '" + (directory / "ask.py").string() + "' >'" + file + "' 2>/dev/null";
  return std::system(command.c_str()) == 0 ? geodrop::read_file(file) : "failed";
}

void check_run(const SceneRun& run) {
  const geodrop::TemporaryDirectory directory;
  const std::string said = ask_python("import geodrop\nrun = geodrop.read('" + run.file("").string() +
                                          "')\nframe = run.frame(0.1)\n"
                                          "print(len(run.times), frame.particles['points'].shape[0], "
                                          "frame.particles['velocity'].shape[1], frame.membranes['tension'].max(), "
                                          "run.history['geotextile.tension_max_N_m'][-1], "
                                          "run.results['fall_velocity_max_m_s'])\n",
                                      directory / "");
  std::istringstream numbers(said);
  double frames = 0, particles = 0, width = 0, tension = 0, last = 0, result = 0;
  numbers >> frames >> particles >> width >> tension >> last >> result;
  CAPTURE(said);
  CHECK(frames == 2);
  CHECK(particles == run.result("particles_count"));
  CHECK(width == 3);
  CHECK(tension == near(run.column("geotextile.tension_max_N_m").back(), 1e-6));  // single precision in frames
  CHECK(last == run.column("geotextile.tension_max_N_m").back());
  CHECK(result == near(run.result("fall_velocity_max_m_s"), 1e-9));
}

}  // namespace

TEST_CASE("Python reads history, results and frames of a run") {
  if (std::system((python + " -c 'import numpy' 2>/dev/null").c_str()) != 0) {
    MESSAGE("not tested: no " << python << " with numpy");
    return;
  }
  const std::vector<std::string> coarse{"grid.spacing=0.5", "time.end=0.1"};
  check_run(SceneRun("cases/dump_kekerdom_mixture.toml", {coarse[0], coarse[1], "output.compress=false"}));
  check_run(SceneRun("cases/dump_kekerdom_mixture.toml", coarse));
}
