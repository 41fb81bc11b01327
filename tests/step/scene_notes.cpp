// What `check` tells beside mistakes: which drained bodies carry the pressure of water in their skeleton.
#include <geodrop/step/run.hpp>

#include "support/scene_files.hpp"
#include "support/text.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace geodrop;
using test::contains;

namespace {

/// A drained bag, 2 m wide and high, its centre 5 m under the surface of water or in the air.
std::string bag(const std::string& initial_stress, const std::string& more) {
  return "title = \"A bag\"\ngravity = [0.0, -10.0]\n"
         "[grid]\nlower = [0.0, 0.0]\nupper = [20.0, 20.0]\nspacing = 0.5\n"
         "[walls]\nleft = \"slip\"\nright = \"slip\"\nbottom = \"slip\"\ntop = \"slip\"\n"
         "[solver]\ntransfer = \"tpic\"\n[time]\nend = 1.0\n[output]\nframe_interval = 1.0\nhistory_interval = 1.0\n"
         "[materials.water]\nmodel = \"newtonian\"\ndensity = 1000.0\nbulk_modulus = 2e9\nviscosity = 0.0\n"
         "[materials.sand]\nmodel = \"mohr_coulomb\"\ndensity = 1600.0\nyoungs_modulus = 3e6\npoissons_ratio = 0.3\n"
         "cohesion = 0.0\nfriction_angle_deg = 30.0\ndilatancy_angle_deg = 0.0\ntension_cutoff = 0.0\n"
         "drainage = \"drained\"\n"
         "[[bodies]]\nname = \"bag\"\nmaterial = \"sand\"\n"
         "shape = { type = \"box\", lower = [9.0, 10.0], upper = [11.0, 12.0] }\n"
         "initial_stress = { " +
         initial_stress + " }\n" + more;
}

const std::string zero = "type = \"zero\"";
const std::string pond =
    "[[bodies]]\nname = \"pond\"\nmaterial = \"water\"\nminus = [\"bag\"]\n"
    "shape = { type = \"box\", lower = [0.0, 0.0], upper = [20.0, 16.0] }\n"
    "initial_stress = { type = \"hydrostatic\", fluid = \"water\", surface = 16.0 }\n";
const std::string still =
    "[[membranes]]\nname = \"geotextile\"\nbody = \"bag\"\naxial_stiffness = 1e5\nmass_per_area = 0.5\nstrength = 1e5\n"
    "slack = 0.0\n[[still_fluids]]\nmembrane = \"geotextile\"\nfluid = \"water\"\nsurface = 16.0\n";

std::vector<std::string> all_notes_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  const std::filesystem::path path = directory / "scene.toml";
  std::ofstream(path) << text;
  return scene_notes(read_scene(path, overrides));
}

/// Those on drained soil in water.
std::vector<std::string> notes_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  std::vector<std::string> notes = all_notes_of(text, overrides);
  std::erase_if(notes, [](const std::string& note) { return contains(note, "void_memory"); });
  return notes;
}

}  // namespace

TEST_CASE("drained soil in water is told, with the pressure that it carries") {
  // 1000 kg/m3, 10 m/s2, 4 and 6 m deep: 40 and 60 kPa (compression of the water: 1e-5 of that); tan 30 = 0.577.
  const std::string in_water[] = {
      bag("type = \"fluid_pressure\", fluid = \"water\", surface = 16.0", ""), bag(zero, pond), bag(zero, still),
      bag("type = \"k0\", surface = 12.0, k0 = 0.5, under = \"fluid\", fluid = \"water\", fluid_surface = 16.0", "")};
  for (const std::string& text : in_water) {
    const std::vector<std::string> notes = notes_of(text);
    REQUIRE(notes.size() == 1);
    CHECK(contains(notes[0], "body \"bag\" is drained: without pore water"));
    CHECK(contains(notes[0], "40 kPa at its highest and 60 kPa at its lowest point"));
    CHECK(contains(notes[0], "0.577 (tan phi)"));
  }
}

TEST_CASE("what is out of the water carries none of its pressure") {
  const std::vector<std::string> half = notes_of(bag(zero, still), {"still_fluids.0.surface=11.0"});
  REQUIRE(half.size() == 1);
  CHECK(contains(half[0], "0 kPa at its highest and 10 kPa at its lowest point"));
  CHECK(notes_of(bag(zero, still), {"still_fluids.0.surface=9.5"}).empty());
}

TEST_CASE("drained soil beside water may get into it") {
  const std::string beside =
      "[[bodies]]\nname = \"lake\"\nmaterial = \"water\"\n"
      "shape = { type = \"box\", lower = [0.0, 0.0], upper = [20.0, 6.0] }\n"
      "initial_stress = { type = \"hydrostatic\", fluid = \"water\", surface = 6.0 }\n";
  const std::vector<std::string> notes = notes_of(bag(zero, beside));
  REQUIRE(notes.size() == 1);
  CHECK(contains(notes[0], "the pressure of \"lake\" wherever it gets into it"));
  CHECK(contains(notes[0], "0.577 (tan phi)"));
}

TEST_CASE("dry soil and soil with water in its pores need no note") {
  CHECK(notes_of(bag(zero, "")).empty());
  CHECK(notes_of(bag("type = \"k0\", surface = 12.0, k0 = 0.5, under = \"air\"", "")).empty());
  CHECK(notes_of(bag(zero, pond), {"materials.sand.drainage=undrained", "materials.sand.porosity=0.4",
                                   "materials.sand.fluid_bulk_modulus=2e9"})
            .empty());
}

TEST_CASE("soil in a bag that keeps the volume by which it opens is told, and void memory ends that") {
  const std::vector<std::string> notes = all_notes_of(bag(zero, still), {"still_fluids.0.surface=9.5"});
  REQUIRE(notes.size() == 1);
  CHECK(contains(notes[0], "soil of body \"bag\" keeps the volume by which it opens inside membrane \"geotextile\""));
  CHECK(all_notes_of(bag(zero, still), {"still_fluids.0.surface=9.5", "materials.sand.void_memory=true"}).empty());
  CHECK(all_notes_of(bag(zero, still), {"still_fluids.0.surface=9.5", "materials.sand.dilatancy_angle_deg=5"}).empty());
  CHECK(all_notes_of(bag(zero, "")).empty());
}

TEST_CASE("coupled soil is told which pressure suits it: that of particles, in a sharp membrane that of cells") {
  const auto notes = [](const char* scene, const std::string& setting) {
    std::string all;
    for (const std::string& note : scene_notes(read_scene(source_path(scene), {setting}))) all += note + '\n';
    return all;
  };
  const char *const column = "cases/verification/terzaghi.toml", *const bag = "cases/dump_kekerdom.toml";
  CHECK(contains(notes(column, "bodies.soil.pressure='cell'"), "take pressure = \"particle\""));
  CHECK_FALSE(contains(notes(column, "bodies.soil.pressure='particle'"), "pressure = "));
  CHECK(contains(notes(bag, "bodies.container.pressure='particle'"), "take pressure = \"cell\" in a sharp membrane"));
  CHECK_FALSE(contains(notes(bag, "bodies.container.pressure='cell'"), "pressure = "));
}

TEST_CASE(
    "water whose reduced stiffness makes it denser below is told where a bag is in it, and a still level ends that") {
  const auto told = [](const std::vector<std::string>& settings) {
    const auto notes = scene_notes(read_scene(source_path("cases/dump_kekerdom_undrained.toml"), settings));
    return std::ranges::any_of(notes, [](const std::string& note) {
      return contains(note, "\"water\" is 3.6 % denser at its lowest point than its density says");  // exp(g H / c^2)
    });
  };
  CHECK(told({"materials.water.still_level="}));
  CHECK_FALSE(told({}));
  CHECK_FALSE(told({"materials.water.still_level=", "materials.water.sound_speed=300"}));
}
