// Scenes that were changed at random: refused with a place, or run.
#include "fuzz/attempt_scene.hpp"
#include "fuzz/mutate_text.hpp"

using namespace geodrop;

TEST_CASE("Changed scenes are refused with a place, or run") {
  fuzz::Trials trials("scene", 10000);
  trials.run(".toml", fuzz::changed_scene,
             [](const std::filesystem::path& path, fuzz::Chance&) { return fuzz::attempt_scene(path, {}); });
}
