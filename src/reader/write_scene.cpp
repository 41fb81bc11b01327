#include "write_scene.hpp"
#include "check_value.hpp"
#include "key_table.hpp"
#include "keys/plain_values.hpp"
#include "keys/to_text.hpp"

#include <set>

namespace geodrop {
namespace {

/// A number that TOML reads as floating point.
std::string real_text(double value) {
  const std::string text = to_text(value);
  return text.find_first_of(".eni") == std::string::npos ? text + ".0" : text;
}

std::string inline_table(const toml::table& table, const Section& section);

std::string value_text(const Key& key, const toml::node& node) {
  const bool as_real =
      key.kind == Kind::real || key.kind == Kind::reals || key.kind == Kind::point || key.kind == Kind::points;
  if (const toml::table* table = node.as_table()) return inline_table(*table, *key.below);
  const toml::array* list = node.as_array();
  if (!list) return as_real ? real_text(to_number(node)) : to_text(node);
  std::string text = "[";
  for (const toml::node& element : *list) text += (text.size() > 1 ? ", " : "") + value_text(key, element);
  return text + "]";
}

/// The `key = value` of each key that the table has, once each though a key may have several rows.
template <class Visit>
void for_each_value(const toml::table& table, const Section& section, Visit visit) {
  std::set<std::string_view> written;
  for (const Key& key : section.keys) {
    const toml::node* node = table.get(key.name);
    const bool has_header = section.path.empty() && key.below;
    if (node && !has_header && written.insert(key.name).second)
      visit(std::string(key.name) + " = " + value_text(key, *node));
  }
}

std::string inline_table(const toml::table& table, const Section& section) {
  std::string text;
  for_each_value(table, section, [&](const std::string& line) { text += (text.empty() ? " " : ", ") + line; });
  return "{" + text + " }";
}

std::string block(const std::string& header, const toml::table& table, const Section& section) {
  std::string text = header.empty() ? "" : "\n" + header + "\n";
  for_each_value(table, section, [&](const std::string& line) { text += line + "\n"; });
  return text;
}

}  // namespace

std::string write_scene(const toml::table& complete) {
  std::string text = block("", complete, scene_section());
  for (const Key& key : scene_section().keys) {
    const std::string name(key.name);
    const toml::node* node = complete.get(name);
    if (!node) continue;
    if (key.kind == Kind::table) text += block("[" + name + "]", *node->as_table(), *key.below);
    if (key.kind == Kind::named_tables)
      for (const auto& [word, element] : *node->as_table())
        text += block("[" + name + "." + std::string(word.str()) + "]", *element.as_table(), *key.below);
    if (key.kind == Kind::table_list)
      for (const toml::node& element : *node->as_array())
        text += block("[[" + name + "]]", *element.as_table(), *key.below);
  }
  return text;
}

}  // namespace geodrop
