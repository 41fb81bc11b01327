// Every row of the table of keys, against two scenes in which every row occurs: one in the plane for all rows but those
// of space, one in space for these. Each key is broken in turn.
#include "reader/key_table.hpp"
#include "keys/toml.hpp"
#include "reader/key_units.hpp"
#include "support/scene_files.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace geodrop;

namespace {

const std::string every_key = source_path("tests/reader/every_key.toml");
const std::string every_key_3d = source_path("tests/reader/every_key_3d.toml");

std::vector<Key> key_table() {
  std::vector<Key> keys;
  for (const Section* section : section_table()) keys.insert(keys.end(), section->keys.begin(), section->keys.end());
  return keys;
}

/// The scene in which a row occurs.
const std::string& scene_of(const Key& key) { return key.dimension == 3 ? every_key_3d : every_key; }

/// All tables of the scene as run, by section, with the full key of each.
using Tables = std::multimap<std::string, std::pair<std::string, toml::table>>;

void collect(const toml::table& table, const std::string& section, const std::string& path, Tables& tables) {
  tables.insert({section, {path, table}});
  for (const Key& key : find_section(section).keys) {
    const std::string sub_section = join_path(section, key.name), sub_path = join_path(path, key.name);
    const toml::node* node = table.get(key.name);
    if (!node) continue;
    if (key.kind == Kind::table) collect(*node->as_table(), sub_section, sub_path, tables);
    if (key.kind == Kind::named_tables) {
      for (const auto& [name, element] : *node->as_table()) {
        collect(*element.as_table(), sub_section, join_path(sub_path, name.str()), tables);
      }
    }
    for (std::size_t i = 0; key.kind == Kind::table_list && i < node->as_array()->size(); ++i) {
      collect(*node->as_array()->get(i)->as_table(), sub_section, join_path(sub_path, std::to_string(i)), tables);
    }
  }
}

struct BothScenes {
  Tables plane, space;
  const Tables& of(const Key& key) const { return key.dimension == 3 ? space : plane; }
};

BothScenes all_tables() {
  BothScenes both;
  collect(toml::parse(read_scene(every_key).as_run), "", "", both.plane);
  collect(toml::parse(read_scene(every_key_3d).as_run), "", "", both.space);
  return both;
}

bool applies(const Key& key, const toml::table& table) {
  if (!table.contains(key.name)) return false;
  if (key.when.empty()) return true;
  const std::vector<std::string> parts = split(key.when, '&');
  return std::all_of(parts.begin(), parts.end(), [&](const std::string& part) {
    const std::vector<std::string> sides = split(part, '=');
    if (sides.size() == 1) return table.contains(sides[0]);
    const auto value = table[sides[0]].value<std::string>();
    const std::vector<std::string> words = split(sides[1], '|');
    return value && std::find(words.begin(), words.end(), *value) != words.end();
  });
}

/// The full key, by index, of a place where the row applies; empty if there is none.
std::string place_of(const Key& key, const BothScenes& both) {
  const auto [begin, end] = both.of(key).equal_range(std::string(key.section));
  for (auto it = begin; it != end; ++it) {
    if (applies(key, it->second.second)) return join_path(it->second.first, key.name);
  }
  return {};
}

/// The message for an override of `path` speaks of the row's key.
void check_refused(const Key& key, const std::string& path, const std::string& value) {
  const std::string error = scene_error(scene_of(key), {path + "=" + value});
  CAPTURE(path);
  CAPTURE(value);
  CAPTURE(error);
  const std::string name = std::string(key.name) + ": found ";
  CHECK(error.find(key.section.empty() ? ": " + name : "." + name) != std::string::npos);
}

std::string wrong_type(Kind kind) {
  switch (kind) {
    case Kind::text:
    case Kind::texts:
    case Kind::name:
    case Kind::names:
    case Kind::choice:
      return "3";
    case Kind::integer:
      return "1.5";
    case Kind::point:
    case Kind::points:
    case Kind::reals:
      return "['a', 'b']";
    default:
      return "'word'";
  }
}

}  // namespace

TEST_CASE("every row occurs in the scene of the tests") {
  const BothScenes tables = all_tables();
  for (const Key& key : key_table()) {
    CAPTURE(std::string(key.section));
    CAPTURE(std::string(key.name));
    CAPTURE(std::string(key.when));
    CHECK_FALSE(place_of(key, tables).empty());
  }
}

TEST_CASE("a wrong type is refused for every key") {
  const BothScenes tables = all_tables();
  for (const Key& key : key_table()) check_refused(key, place_of(key, tables), wrong_type(key.kind));
}

TEST_CASE("a date is refused for every key") {
  const BothScenes tables = all_tables();
  for (const Key& key : key_table()) check_refused(key, place_of(key, tables), "1994-05-27");
}

TEST_CASE("a required key that is missing is named") {
  const BothScenes tables = all_tables();
  int count = 0;
  for (const Key& key : key_table()) {
    if (key.need.how != Need::How::required) continue;
    check_refused(key, place_of(key, tables), "");
    ++count;
  }
  CHECK(count > 60);
}

TEST_CASE("not-a-number, infinity and every number out of range are refused") {
  const BothScenes tables = all_tables();
  int ranges = 0;
  for (const Key& key : key_table()) {
    const std::string path = place_of(key, tables);
    const bool is_list = key.kind == Kind::point || key.kind == Kind::reals;
    const auto written = [&](const std::string& number) {
      return is_list ? "[" + number + ", " + number + "]" : number;
    };
    if (key.kind == Kind::real || is_list) {
      check_refused(key, path, written("nan"));
      check_refused(key, path, written("-inf"));
      if (!key.allowed.infinite) check_refused(key, path, written("inf"));
    }
    if (key.kind != Kind::real && key.kind != Kind::integer && !is_list) continue;
    bool refuses = false;
    for (const double number : {-1000.0, -1.0, 0.0, 0.5, 1.0, 1.5, 90.0, 1000.0}) {
      if (key.allowed.holds(number) || (key.kind == Kind::integer && number != std::round(number))) continue;
      const bool integer = key.kind == Kind::integer;
      check_refused(key, path, written(integer ? std::to_string(static_cast<int>(number)) : std::to_string(number)));
      refuses = true;
    }
    CHECK(refuses == !key.allowed.text.starts_with("any"));
    ranges += refuses;
  }
  CHECK(ranges > 30);
}

TEST_CASE("a misspelt key is named, with the key that was meant") {
  const BothScenes tables = all_tables();
  for (const Key& key : key_table()) {
    const std::string path = place_of(key, tables) + "_";
    const std::string error = scene_error(scene_of(key), {path + "=1"});
    CAPTURE(error);
    CHECK(error.find(std::string(key.name) + "_: found an unknown key; allowed: one of") != std::string::npos);
    CHECK(error.find("the nearest is \"" + std::string(key.name) + '"') != std::string::npos);
  }
}

TEST_CASE("every choice refuses a word that is none of its own, and names the nearest") {
  const BothScenes tables = all_tables();
  for (const Key& key : key_table()) {
    if (key.kind != Kind::choice) continue;
    const std::vector<std::string>& words = key.words;
    check_refused(key, place_of(key, tables), words.back() + "x");
    const std::string error = scene_error(scene_of(key), {place_of(key, tables) + "=" + words.back() + "x"});
    for (const std::string& word : words) CHECK(error.find('"' + word + '"') != std::string::npos);
  }
}

TEST_CASE("a row whose condition does not hold is refused") {
  CHECK(scene_error(every_key, {"materials.oil.cohesion=1"})
            .find("materials.oil.cohesion: found a key that does not apply here; allowed: only with model = "
                  "\"mohr_coulomb\"") != std::string::npos);
  CHECK(scene_error(every_key, {"solver.transfer=tpic"})
            .find("solver.blend_rate: found a key that does not apply here; allowed: only with transfer = \"blend\"") !=
        std::string::npos);
  CHECK(scene_error(every_key, {"materials.sand.porosity=0.4"}).find("only with drainage = \"undrained\"") !=
        std::string::npos);
  CHECK(scene_error(every_key, {"bodies.wedge.initial_stress.fluid=water"})
            .find("only with type = \"hydrostatic\" or \"fluid_pressure\" or under = \"fluid\"") != std::string::npos);
  CHECK(scene_error(every_key, {"materials.water.bulk_modulus=1e9"}).find("both bulk_modulus and sound_speed") !=
        std::string::npos);
  CHECK(scene_error(every_key, {"materials.water.sound_speed="}).find("neither bulk_modulus nor sound_speed") !=
        std::string::npos);
}

TEST_CASE("a key of the other dimension is refused") {
  CHECK(scene_error(every_key, {"walls.front=slip"})
            .find("walls.front: found a key that does not apply here; allowed: only with dimension = 3") !=
        std::string::npos);
  CHECK(scene_error(every_key_3d, {"viscous_boundaries=[]"})
            .find("viscous_boundaries: found a key that does not apply here; allowed: only with dimension = 2") !=
        std::string::npos);
  CHECK(scene_error(every_key_3d, {"bodies.bag.shape.tilt_deg=5"}).find("only with type = \"ellipse\"") !=
        std::string::npos);
}

TEST_CASE("a dimension that is neither 2 nor 3 is the only complaint") {
  for (const std::string& scene : {every_key, every_key_3d}) {
    for (const char* value : {"4", "0", "2.5", "'three'"}) {
      const std::string error = scene_error(scene, {std::string("dimension=") + value});
      CAPTURE(error);
      CHECK(error.find("dimension: found ") != std::string::npos);
      CHECK(error.find("allowed: a whole number 2 or 3") != std::string::npos);
      CHECK(error.find('\n') == std::string::npos);
    }
  }
}

TEST_CASE("what depends on a wrong key is not complained about") {
  for (const char* override :
       {"materials.clay.model=mohr_coulmb", "materials.clay.drainage=3", "bodies.bed.initial_stress.type=k1",
        "bodies.bag.shape.type=elipse", "bodies.bag.initial_stress.surface=high", "grid.spacing=-1"}) {
    const std::string error = scene_error(every_key, {override});
    CAPTURE(error);
    CHECK_FALSE(error.empty());
    CHECK(error.find('\n') == std::string::npos);
  }
  // A soil that is cut out of the water around it, and whose pore water has its shape.
  const std::string error = scene_error(source_path("cases/dump_kekerdom.toml"), {"bodies.container.shape.type=bag"});
  CAPTURE(error);
  CHECK(error.find("bodies.container.shape.type: found \"bag\"") != std::string::npos);
  CHECK(error.find('\n') == std::string::npos);
}

TEST_CASE("rows are well formed") {
  std::set<std::string> seen;
  for (const Key& key : key_table()) {
    const std::string row =
        join_path(key.section, key.name) + "?" + std::string(key.when) + "?" + std::to_string(key.dimension);
    CAPTURE(row);
    CHECK(seen.insert(row).second);
    CHECK(find_section(key.section).path == key.section);
    CHECK_FALSE(key.meaning.empty());
    CHECK_FALSE(key.allowed.text.empty());
  }
}

TEST_CASE("The meaning of each type of initial stress is told") {
  const std::vector<Key>& keys = find_section("bodies.initial_stress").keys;
  const auto type = std::ranges::find(keys, "type", &Key::name);
  REQUIRE(type != keys.end());
  CHECK(type->words.size() == 6);
  for (const std::string& word : type->words)
    CHECK_MESSAGE((' ' + std::string(type->meaning)).find(' ' + word + ": ") != std::string::npos, word);
}

TEST_CASE("The unit of a full key") {
  CHECK(unit_of_path("grid.spacing") == "m");
  CHECK(unit_of_path("gravity.1") == "m/s2");
  CHECK(unit_of_path("materials.sand.youngs_modulus") == "Pa");
  CHECK(unit_of_path("bodies.bag.shape.tilt_deg") == "degree");
  CHECK(unit_of_path("bodies.bag.jitter").size() < 2);  // a share
  CHECK(unit_of_path("solver.transfer").empty());
  CHECK(unit_of_path("grid.spcing").empty());
  CHECK(unit_of_path("").empty());
}

TEST_CASE("docs/scene.md is what the table says") {
  CHECK(read_file(source_path("docs/scene.md")) == scene_reference_markdown());
}
