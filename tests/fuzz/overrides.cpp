// Changes by --set, made at random, to scenes that are right: refused with a place, or run.
#include "fuzz/attempt_scene.hpp"
#include "fuzz/mutate_text.hpp"

using namespace geodrop;

namespace {

/// Full keys that the scenes have, and parts of them.
const std::vector<std::string>& some_keys() {
  static const std::vector<std::string> all{"grid.spacing",
                                            "grid.lower",
                                            "grid.upper.0",
                                            "grid.refine",
                                            "grid",
                                            "gravity.1",
                                            "gravity.-1",
                                            "bodies.0.shape",
                                            "bodies.0.shape.points.1",
                                            "bodies.1.material",
                                            "bodies.0.particles_per_cell_axis",
                                            "bodies.0.jitter",
                                            "bodies.0.initial_velocity.value",
                                            "bodies.99.name",
                                            "materials.water.density",
                                            "materials.sand.friction_angle_deg",
                                            "materials",
                                            "solver.transfer",
                                            "solver.courant",
                                            "solver.damping_rate",
                                            "time.end",
                                            "output.frame_interval",
                                            "walls.left",
                                            "membranes.0.axial_stiffness",
                                            "membranes.0.segments_per_cell",
                                            "contacts.0.friction",
                                            "results.0.column",
                                            "stages",
                                            "stages.0.from",
                                            "dimension",
                                            "title",
                                            "",
                                            ".",
                                            "a..b",
                                            "grid.spacing.x"};
  return all;
}

const std::vector<std::string>& some_values() {
  static const std::vector<std::string> all{"",
                                            "true",
                                            "[]",
                                            "{}",
                                            "[1.0,2.0]",
                                            "[1.0,2.0,3.0]",
                                            "\"water\"",
                                            "water",
                                            "2020-01-01",
                                            "periodic",
                                            "musl",
                                            "{type='uniform',value=[1e300,0]}",
                                            "{type='box',lower=[0.0,0.0],upper=[1.0,1.0]}",
                                            "[{axis='x',from=0.0,to=1.0,spacing=0.1}]",
                                            "'''",
                                            "\xff",
                                            "1\n[grid]",
                                            "\"\\u0000\""};
  return all;
}

std::string changed_override(fuzz::Chance& chance) {
  std::string key = chance.of(some_keys());
  static const std::vector<std::string> likely{"0.5", "1", "2", "0.25", "3", "0.1", "10.0", "1e3"};
  std::string value = chance.one_in(2)   ? chance.of(likely)
                      : chance.one_in(2) ? chance.of(fuzz::odd_numbers())
                                         : chance.of(some_values());
  if (chance.one_in(10)) fuzz::change_bytes(key, chance);
  if (chance.one_in(10)) fuzz::change_bytes(value, chance);
  if (chance.one_in(100)) value = std::string(1 + chance.below(200000), 'x');
  return chance.one_in(50) ? key : key + "=" + value;
}

/// The scenes that hold, beside the one that is tried: a line for each override, bytes beyond ASCII as they are.
const std::vector<std::string>& good_scenes() {
  static const std::vector<std::string> all{"tests/scenes/block_on_slab.toml", "tests/scenes/tube.toml",
                                            "tests/scenes/run_up_3d.toml",     "cases/dump_kekerdom.toml",
                                            "tests/scenes/round_pulse.toml",   "tests/reader/every_key.toml"};
  return all;
}

}  // namespace

TEST_CASE("Changes by --set are refused with a place, or run") {
  fuzz::Trials trials("overrides", 10000);
  std::vector<std::string> overrides;
  trials.run(
      ".toml",
      [&](fuzz::Chance& chance) {
        overrides.clear();
        for (std::size_t i = 0; i <= chance.below(3); ++i) overrides.push_back(changed_override(chance));
        std::string text = read_file(source_path(chance.of(good_scenes())));
        for (const std::string& one : overrides) text += "\n# --set " + one;  // for who looks at what is kept
        return text;
      },
      [&](const std::filesystem::path& path, fuzz::Chance&) {
        // The scene alone, without the comments that hold the overrides.
        const std::string kept = read_file(path);
        const std::filesystem::path scene = path.string() + ".scene";
        std::ofstream(scene) << kept.substr(0, kept.find("\n# --set "));
        const std::string became = fuzz::attempt_scene(scene, overrides);
        std::filesystem::remove(scene);
        return became;
      });
}
