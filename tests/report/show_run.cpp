// paraview/show_run.py draws each preset. Where ParaView's Python is missing, draws nothing at all for want of a
// display, or GEODROP_NO_PARAVIEW is set, there is nothing to test.
#include <doctest/doctest.h>

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "files/read_frames.hpp"
#include "support/not_tested.hpp"
#include "support/program.hpp"
#include "support/python.hpp"
#include "support/text.hpp"

using namespace geodrop::test;
namespace fs = std::filesystem;

namespace {

const std::string script = geodrop::source_path("paraview/show_run.py");

bool there(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

}  // namespace

TEST_CASE("ParaView draws each preset of show_run.py without a display, on one scale, and all frames") {
  if (std::getenv("GEODROP_NO_PARAVIEW") || !there("pvbatch") || !there("xvfb-run")) {
    not_tested("no pvbatch and xvfb-run, or GEODROP_NO_PARAVIEW");
    return;
  }
  const SceneRun run("tests/scenes/hanging.toml");
  const geodrop::TemporaryDirectory directory;
  const std::string path = directory / "", draw = path + "draw.sh", drew = path + "drew", said = path + "said";
  std::ofstream(path + "sphere.py") << "from paraview import simple\nsimple.Show(simple.Sphere())\nsimple.Render()\n";
  std::ofstream(draw) << "cd '" << path << "'\n"
                      << "show() { pvbatch '" << script << "' '" << run.file("").string() << "' \"$@\"; }\n"
                      << "pvbatch sphere.py && touch drew || exit\n"
                      << "for preset in layers stresses pressure tension utilisation; do\n"
                      << "  show --show $preset --screenshot $preset.png; echo $? >$preset.code\n"
                      << "done\n"
                      << "show --show tension --range 0 1e9 --screenshot range.png; echo $? >range.code\n"
                      << "show --show tension --animation frames.png --size 300 300; echo $? >frames.code\n";
  [[maybe_unused]] const int status = std::system(("xvfb-run -a sh '" + draw + "' >'" + said + "' 2>&1").c_str());
  CAPTURE(geodrop::read_file(said));
  if (!fs::exists(drew)) {
    not_tested("ParaView does not draw a sphere here");
    return;
  }
  for (const std::string picture : {"layers", "stresses", "pressure", "tension", "utilisation", "range"}) {
    CAPTURE(picture);
    CHECK(geodrop::read_file(path + picture + ".code") == "0\n");
    REQUIRE(fs::exists(path + picture + ".png"));
    CHECK(fs::file_size(path + picture + ".png") > 10000);
  }
  CHECK(geodrop::read_file(path + "range.png") != geodrop::read_file(path + "tension.png"));
  CHECK(geodrop::read_file(path + "frames.code") == "0\n");
  const std::size_t frames = geodrop::frame_times(run.file("")).size();
  char last[32];
  std::snprintf(last, sizeof last, "frames.%04zu.png", frames - 1);
  CHECK(fs::exists(path + last));
  CHECK(geodrop::read_file(path + "frames.0000.png") != geodrop::read_file(path + last));
}

TEST_CASE("show_run.py refuses options that do not fit, before it draws anything") {
  const geodrop::TemporaryDirectory directory;
  fs::create_directory(directory / "paraview");
  std::ofstream(directory / "paraview/__init__.py") << "simple = None\n";
  const auto refused = [&](const std::string& options) {
    const std::string said = directory / "said", command = "PYTHONPATH='" + (directory / "").string() + "' " + python +
                                                           " '" + script + "' runs/none " + options;
    const int status = std::system((command + " >'" + said + "' 2>&1").c_str());
    CHECK(WEXITSTATUS(status) == 2);
    return geodrop::read_file(said);
  };
  CHECK(contains(refused("--range 2 1"), "--range: found 2 1; allowed: MIN below MAX"));
  CHECK(
      contains(refused("--animation frames.gif"), "--animation: found frames.gif; allowed: a file .png, .avi or .ogv"));
  CHECK(contains(refused("--animation a.png --time 1"), "--time: not allowed with argument --animation"));
  CHECK(contains(refused("--animation a.png --screenshot b.png"), "not allowed with argument"));
}

TEST_CASE("Each preset of show_run.py is one of the page of ParaView") {
  const std::string page = geodrop::read_file(geodrop::source_path("paraview/README.md"));
  const std::string code = geodrop::read_file(script);
  for (const std::string preset : {"layers", "stresses", "pressure", "tension", "utilisation"}) {
    CAPTURE(preset);
    CHECK(contains(code, "\"" + preset + "\": Preset("));
    CHECK(contains(page, "| `" + preset + "`"));
  }
}
