// The examples of docs/scene.md: each, in the place of the same part of a scene that `geodrop new` writes, is read
// without a mistake, and its units are not doubted.
#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>

#include "doubts/doubtful_units.hpp"
#include "keys/toml.hpp"
#include "reader/key_table.hpp"
#include "support/program.hpp"

using namespace geodrop;

namespace {

/// A section that is in space only stands in a pillow, all others in a bag of sand in the plane.
toml::table scene_around(const Section& section) {
  const TemporaryDirectory directory;
  std::vector<std::string> words{"new", directory / "around"};
  if (std::ranges::all_of(section.keys, [](const Key& key) { return key.dimension == 3; }))
    words.insert(words.end(), {"--from", "pillow_3d"});
  if (section.heading == "[[still_fluids]]")  // around the bag of the starter scene is a body of water
    words.insert(words.end(), {"--from", "geotube_submerged"});
  REQUIRE(test::run_program(words).code == 0);
  toml::table scene = toml::parse_file((directory / "around.toml").string());
  if (section.heading == "[[pumps]]" || section.heading == "[[exact]]")  // not with a still level
    scene["materials"]["water"].as_table()->erase("still_level");
  return scene;
}

/// In the place of the one of its name, if there is one.
void put_element(const toml::table& element, const Section& section, toml::array& list) {
  const auto name = element[section.id_key].value<std::string>();
  for (toml::node& present : list) {
    toml::table& table = *present.as_table();
    if (name && table[section.id_key].value<std::string>() == name) {
      table = element;
      return;
    }
  }
  list.push_back(element);
}

template <class Node>
Node& made(toml::table& scene, std::string_view name) {
  return *scene.insert(name, Node{}).first->second.template as<Node>();
}

/// Tables replace those of the same name, but for one that only leads to the section of the example.
void put(const toml::table& example, const Section& here, const Section& of, toml::table& scene) {
  for (const auto& [name, node] : example) {
    const auto key = std::ranges::find(here.keys, name.str(), &Key::name);
    REQUIRE(key != here.keys.end());
    if (key->kind == Kind::table_list) {
      for (const toml::node& element : *node.as_array())
        put_element(*element.as_table(), *key->below, made<toml::array>(scene, name.str()));
    } else if (key->kind == Kind::named_tables) {
      for (const auto& [word, table] : *node.as_table())
        made<toml::table>(scene, name.str()).insert_or_assign(word.str(), *table.as_table());
    } else if (key->kind == Kind::table && of.path.starts_with(key->below->path + '.')) {
      put(*node.as_table(), *key->below, of, made<toml::table>(scene, name.str()));
    } else {
      node.visit([&, at = name.str()](const auto& value) { scene.insert_or_assign(at, value); });
    }
  }
}

/// Keys of the section that an example gives beside tables; `here` is the section of the node.
int keys_given(const toml::node& node, const Section& here, const Section& of) {
  int count = 0;
  if (const toml::array* list = node.as_array())
    for (const toml::node& element : *list) count += keys_given(element, here, of);
  if (const toml::table* table = node.as_table()) {
    for (const auto& [name, value] : *table) {
      const auto key = std::ranges::find(here.keys, name.str(), &Key::name);
      if (key == here.keys.end())  // the NAME of [materials.NAME]
        count += keys_given(value, here, of);
      else
        count += key->below ? keys_given(value, *key->below, of) : &here == &of;
    }
  }
  return count;
}

}  // namespace

TEST_CASE("Each section has an example that uses it") {
  for (const Section* section : section_table()) {
    CAPTURE(std::string(section->heading));
    CHECK_FALSE(section->example.empty());
    CHECK(keys_given(toml::parse(section->example), scene_section(), *section) > 0);
  }
}

TEST_CASE("Each example is read without a mistake, and its units are not doubted") {
  for (const Section* section : section_table()) {
    CAPTURE(std::string(section->heading));
    toml::table scene = scene_around(*section);
    put(toml::parse(section->example), scene_section(), *section, scene);
    std::ostringstream text;
    text << scene;
    const TemporaryDirectory directory;
    std::ofstream(directory / "scene.toml") << text.str();
    CHECK(scene_error(directory / "scene.toml") == "");
    CHECK(doubtful_units(read_scene(directory / "scene.toml")).empty());
  }
}
