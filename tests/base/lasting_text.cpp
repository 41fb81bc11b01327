// What of a scene a resumed run may not change, and how the first change is named.
#include "base/lasting_text.hpp"
#include "support/scene_files.hpp"

#include <doctest/doctest.h>

using namespace geodrop;

namespace {

std::string as_run(const std::vector<std::string>& settings) {
  return read_scene(source_path("cases/dump_kekerdom.toml"), settings).as_run;
}

std::string difference(const std::vector<std::string>& before, const std::vector<std::string>& now) {
  return first_difference(lasting_text(as_run(before)), lasting_text(as_run(now)));
}

}  // namespace

TEST_CASE("When a run ends, what it writes and what it is judged by may change") {
  const std::string text = lasting_text(as_run({}));
  CHECK(text ==
        lasting_text(as_run({"time.end=77", "output.frame_interval=0.5", "output.compress=true", "title=another",
                             "question=why", "results.0.scale=2", "verify=[]", "expect=[]", "variants=[]"})));
  CHECK(text.find("spacing = ") != std::string::npos);
  CHECK(text.find("frame_interval") == std::string::npos);
}

TEST_CASE("The first key that differs is named, with both values") {
  CHECK(difference({}, {}) == "");
  CHECK(difference({"grid.spacing=0.25"}, {}) == "grid.spacing = 0.25, here 0.5");
  CHECK(difference({"materials.water.density=1000"}, {"materials.water.density=1025"}) ==
        "materials.water.density = 1000.0, here 1025.0");
  CHECK(difference({"bodies.water.jitter=0"}, {"bodies.water.jitter=0.2"}) == "bodies.water.jitter = 0.0, here 0.2");
  CHECK(difference({}, {"rigid=[{name='wall',shape={type='half_plane',point=[0.0,0.0],normal=[0.0,1.0]}}]"}) ==
        "no rigid.wall, here it is");
}

TEST_CASE("A value that looks like a header is none") {
  const std::string text = "title = \"[output]\"\ngravity = [0.0, -9.81]\n\n[time]\nend = 1.0\n[output]\nx = 1\n";
  CHECK(lasting_text(text) == "gravity = [0.0, -9.81]\n[time]\n");
  CHECK(first_difference("a = 1\nb = 2\n", "b = 2\na = 1\n") == "the order of its tables");
}
