// Former words of the scene still hold, and a note names the word of today.
#include "support/scene_files.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace geodrop;

namespace {

const std::string every_key = source_path("tests/reader/every_key.toml");

/// The scene of all keys with the former word for absorbing layers.
struct FormerScene {
  TemporaryDirectory directory;
  std::string path = (directory / "scene.toml").string();
  int line = 1;  ///< of the former word

  explicit FormerScene(const std::string& more = "") {
    std::string text = read_file(every_key);
    const std::string present = "[[absorbing_layers]]", former = "[[silent_sides]]";
    const std::size_t at = text.find(present);
    REQUIRE(at != std::string::npos);
    line += static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    std::ofstream(path) << text.replace(at, present.size(), former) + more;
  }
};

const std::string advice = ": \"silent_sides\" is called \"absorbing_layers\" now";

}  // namespace

TEST_CASE("a former word is read as the one of today, with a note of its place") {
  const FormerScene former;
  const Scene scene = read_scene(former.path), present = read_scene(every_key);
  REQUIRE(scene.notes.size() == 1);
  CHECK(scene.notes[0] == former.path + ":" + std::to_string(former.line) + ":3" + advice);
  CHECK(present.notes.empty());
  CHECK(scene.silent_sides == present.silent_sides);
  CHECK(scene.as_run == present.as_run);
}

TEST_CASE("a mistake below a former word is reported under the one of today") {
  const FormerScene former;
  CHECK(scene_error(former.path, {"silent_sides.open_sea.width=0"})
            .find("absorbing_layers.open_sea.width: found 0; allowed: a number > 0 [m]") != std::string::npos);
}

TEST_CASE("overrides know both words, in the path and in the value") {
  const FormerScene former;
  const std::string left =
      "{name = 'left', body = 'pool', side = 'left', width = 3.0, water_beyond = 1, rest_time = 9}";
  for (const std::string& path : {every_key, former.path}) {
    CHECK(read_scene(path, {"absorbing_layers.0.width=3"}).silent_sides[0].width == 3);
    const Scene scene = read_scene(path, {"silent_sides.0.width=3"});
    CHECK(scene.silent_sides[0].width == 3);
    CHECK(scene.notes.back() == path + ": --set" + advice);
    CHECK(read_scene(path, {"silent_sides=[]"}).silent_sides.empty());
  }
}

TEST_CASE("both words at once are a mistake") {
  const FormerScene former("\n[[absorbing_layers]]\n");
  CHECK(scene_error(former.path)
            .find("silent_sides: found both silent_sides and absorbing_layers, of which it is a former name; allowed: "
                  "only absorbing_layers") != std::string::npos);
}
