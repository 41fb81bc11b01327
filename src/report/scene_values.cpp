#include "scene_values.hpp"

#include <geodrop/base/input_file.hpp>

#include <algorithm>

#include "base/figures.hpp"
#include "base/text.hpp"
#include "html.hpp"
#include "keys/plain_values.hpp"
#include "keys/to_text.hpp"
#include "reader/key_table.hpp"

namespace geodrop {
namespace {

toml::table parse(const std::filesystem::path& scene) {
  return toml::parse(read_input(scene, "", "the scene of a run"), std::string_view(scene.c_str()));
}

/// As to_text, but texts without quotes.
std::string plain_text(const toml::node& node) {
  if (const auto* word = node.as_string()) return word->get();
  const toml::array* list = node.as_array();
  if (!list) return to_text(node);
  std::string text;
  for (const toml::node& element : *list) text += (text.empty() ? "" : ", ") + plain_text(element);
  return "[" + text + "]";
}

std::string name_of(const toml::node& node, std::size_t index) {
  const toml::table* table = node.as_table();
  for (const char* key : {"name", "result"})
    if (const auto name = table ? (*table)[key].value<std::string>() : std::nullopt) return *name;
  return std::to_string(index);
}

bool holds_tables(const toml::node& node) {
  const toml::array* list = node.as_array();
  return list && !list->empty() && list->front().is_table();
}

void flatten(const toml::node& node, const std::string& path, std::vector<std::pair<std::string, std::string>>& list) {
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table) flatten(value, join_path(path, key.str()), list);
  } else if (holds_tables(node)) {
    const toml::array& elements = *node.as_array();
    for (std::size_t i = 0; i < elements.size(); ++i)
      flatten(elements[i], join_path(path, name_of(elements[i], i)), list);
  } else {
    list.emplace_back(path, plain_text(node));
  }
}

/// As it was written, with thousands of N and Pa as kN and kPa.
std::string value_cell(const toml::node& node, std::string_view unit) {
  constexpr int digits = 6;
  if (!node.is_number()) {
    const bool has_unit = !unit.empty() && unit != "-" && !(node.is_array() && node.as_array()->empty());
    return html::text(plain_text(node) + (has_unit ? " " + std::string(unit) : ""));
  }
  const double value = to_number(node);
  const Scaled scaled = scaled_unit(std::string(unit), value);
  return format_number(value * scaled.factor, digits) +
         (scaled.unit.empty() || scaled.unit == "-" ? "" : " " + html::text(scaled.unit));
}

/// What a key is in a table, or is taken for where it is not written; nothing if there is neither.
std::optional<std::string> word_of(const toml::table& table, const Section& section, const std::string& name) {
  if (const toml::node* node = table.get(name)) return node->value_or<std::string>("");
  for (const Key& key : section.keys)
    if (key.name == name && key.need.how == Need::How::standard)
      return toml::parse("x = " + std::string(key.need.text))["x"].value_or<std::string>("");
  return {};
}

/// Whether the neighbours of a key are as its condition says, see Key::when.
bool holds(const Key& key, const toml::table& table, const Section& section) {
  if (key.when.empty()) return true;
  return std::ranges::all_of(split(key.when, '&'), [&](const std::string& part) {
    const std::vector<std::string> sides = split(part, '=');
    const std::optional<std::string> word = word_of(table, section, sides[0]);
    if (!word || sides.size() == 1) return word.has_value();
    return std::ranges::count(split(sides[1], '|'), *word) > 0;
  });
}

/// Several keys have one name: the one whose condition holds.
bool meant(const Key& key, const toml::table& table, const Section& section) {
  if (holds(key, table, section)) return true;
  return std::ranges::none_of(section.keys, [&](const Key& other) {
    return other.name == key.name && &other != &key && holds(other, table, section);
  });
}

/// Rows of a table and of the tables below it.
void add_rows(const toml::table& table, const Section& section, const std::string& before,
              std::vector<std::vector<std::string>>& lines) {
  for (const Key& key : section.keys) {
    const toml::node* node = table.get(key.name);
    const std::string name = before + std::string(key.name);
    const bool listed = std::ranges::any_of(lines, [&](const auto& line) { return line[0] == html::text(name); });
    if (!node || key.name == "name" || listed || !meant(key, table, section)) continue;
    if (const toml::table* below = node->as_table(); below && key.below)
      add_rows(*below, *key.below, name + ".", lines);
    else if (!holds_tables(*node))
      lines.push_back({html::text(name), value_cell(*node, key.unit), html::text(std::string(key.meaning))});
  }
}

std::string table_of(const toml::table& table, const Section& section, const std::string& heading) {
  std::vector<std::vector<std::string>> lines{{html::text(heading), "value", "meaning"}};
  add_rows(table, section, "", lines);
  return lines.size() > 1 ? html::table(lines, {}) : "";
}

}  // namespace

std::string scene_values_html(const std::filesystem::path& file) {
  const toml::table scene = parse(file);
  std::string html;
  for (const char* name : {"grid", "walls", "solver", "time"})
    if (const toml::table* table = scene.get_as<toml::table>(name)) html += table_of(*table, find_section(name), name);
  if (const toml::table* materials = scene.get_as<toml::table>("materials"))
    for (const auto& [name, material] : *materials)
      if (const toml::table* table = material.as_table())
        html += table_of(*table, find_section("materials"), "material " + std::string(name.str()));
  for (const char* name : {"bodies", "membranes", "contacts", "rigid"}) {
    const toml::array* list = scene.get_as<toml::array>(name);
    for (std::size_t i = 0; list && i < list->size(); ++i)
      if (const toml::table* table = list->get_as<toml::table>(i))
        html += table_of(*table, find_section(name), std::string(name) + ": " + name_of(*table, i));
  }
  return html;
}

std::vector<std::pair<std::string, std::string>> flat_scene(const std::filesystem::path& scene) {
  std::vector<std::pair<std::string, std::string>> list;
  flatten(parse(scene), "", list);
  return list;
}

}  // namespace geodrop
