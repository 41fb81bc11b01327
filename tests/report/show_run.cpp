// paraview/show_run.py draws each preset. Where ParaView's Python is missing, draws nothing at all for want of a
// display, or GEODROP_NO_PARAVIEW is set, there is nothing to test.
#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>

#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;
namespace fs = std::filesystem;

namespace {

bool there(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

}  // namespace

TEST_CASE("ParaView draws each preset of show_run.py without a display") {
  if (std::getenv("GEODROP_NO_PARAVIEW") || !there("pvbatch") || !there("xvfb-run")) {
    MESSAGE("not tested: no pvbatch and xvfb-run, or GEODROP_NO_PARAVIEW");
    return;
  }
  const SceneRun run("tests/scenes/hanging.toml");
  const geodrop::TemporaryDirectory directory;
  const std::string path = directory / "", draw = path + "draw.sh", drew = path + "drew", said = path + "said";
  std::ofstream(path + "sphere.py") << "from paraview import simple\nsimple.Show(simple.Sphere())\nsimple.Render()\n";
  std::ofstream(draw) << "cd '" << path << "'\n"
                      << "pvbatch sphere.py && touch drew || exit\n"
                      << "for preset in layers stresses pressure tension utilisation; do\n"
                      << "  pvbatch '" << geodrop::source_path("paraview/show_run.py") << "' '" << run.file("").string()
                      << "' --show $preset --screenshot $preset.png\n"
                      << "done\n";
  [[maybe_unused]] const int status = std::system(("xvfb-run -a sh '" + draw + "' >'" + said + "' 2>&1").c_str());
  CAPTURE(geodrop::read_file(said));
  if (!fs::exists(drew)) {
    MESSAGE("not tested: ParaView does not draw a sphere here");
    return;
  }
  for (const std::string preset : {"layers", "stresses", "pressure", "tension", "utilisation"}) {
    const std::string picture = directory / (preset + ".png");
    CAPTURE(preset);
    REQUIRE(fs::exists(picture));
    CHECK(fs::file_size(picture) > 10000);
  }
}

TEST_CASE("Each preset of show_run.py is one of the page of ParaView") {
  const std::string page = geodrop::read_file(geodrop::source_path("paraview/README.md"));
  const std::string script = geodrop::read_file(geodrop::source_path("paraview/show_run.py"));
  for (const std::string preset : {"layers", "stresses", "pressure", "tension", "utilisation"}) {
    CAPTURE(preset);
    CHECK(contains(script, "\"" + preset + "\": Preset("));
    CHECK(contains(page, "| `" + preset + "`"));
  }
}
