// paraview/geodrop.py reads what a run wrote, plain and compressed. Without Python and numpy there is nothing to test.
#include <doctest/doctest.h>

#include <sstream>

#include "support/near.hpp"
#include "support/not_tested.hpp"
#include "support/program.hpp"
#include "support/python.hpp"

using namespace geodrop::test;

namespace {

void check_run(const SceneRun& run) {
  const std::string said = ask_python("import geodrop\nrun = geodrop.read('" + run.file("").string() +
                                      "')\nframe = run.frame(0.1)\n"
                                      "print(len(run.times), frame.particles['points'].shape[0], "
                                      "frame.particles['velocity'].shape[1], frame.membranes['tension'].max(), "
                                      "len(frame.membranes['connectivity']) / len(frame.membranes['tension']), "
                                      "run.history['geotextile.tension_max_N_m'][-1], "
                                      "run.results['fall_velocity_max_m_s'])\n");
  std::istringstream numbers(said);
  double frames = 0, particles = 0, width = 0, tension = 0, nodes = 0, last = 0, result = 0;
  numbers >> frames >> particles >> width >> tension >> nodes >> last >> result;
  CAPTURE(said);
  CHECK(frames == 2);
  CHECK(particles == run.result("particles_count"));
  CHECK(width == 3);
  CHECK(tension == near(run.column("geotextile.tension_max_N_m").back(), 1e-6));  // single precision in frames
  CHECK(nodes == 2);                                                              // of a segment
  CHECK(last == run.column("geotextile.tension_max_N_m").back());
  CHECK(result == near(run.result("fall_velocity_max_m_s"), 1e-9));
}

}  // namespace

TEST_CASE("Python reads history, results and frames of a run") {
  if (!python_has("numpy")) {
    not_tested("no " + python + " with numpy");
    return;
  }
  const std::vector<std::string> coarse{"grid.spacing=0.5", "time.end=0.1"};
  check_run(SceneRun("cases/dump_kekerdom_mixture.toml", {coarse[0], coarse[1], "output.compress=false"}));
  check_run(SceneRun("cases/dump_kekerdom_mixture.toml", coarse));
}
