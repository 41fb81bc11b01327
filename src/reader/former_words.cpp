#include "former_words.hpp"

#include "key_table.hpp"

#include <algorithm>

namespace geodrop {
namespace {

void rename_key(toml::table& table, const Key& key, const std::string& path, Report& report) {
  const auto found = table.find(key.former);
  if (found == table.end()) return;
  const std::string former(key.former), present(key.name);
  const toml::node& value = found->second;
  const bool by_override = value.source().path && *value.source().path == kOverrideSource;
  const SourceRef at = to_ref(by_override ? value.source() : found->first.source());
  if (table.contains(key.name))
    report.add_at(at, join_path(path, former), "both " + former + " and " + present + ", of which it is a former name",
                  "only " + present);
  else {
    report.note(at, former, present);
    std::move(found->second).visit([&](auto&& node) {
      table.insert_or_assign(toml::key(key.name, found->first.source()), std::forward<decltype(node)>(node));
    });
  }
  table.erase(key.former);
}

void rename_below(toml::node& node, const Section& section, Kind kind, const std::string& path, Report& report);

void rename_in(toml::table& table, const Section& section, const std::string& path, Report& report) {
  for (const Key& key : section.keys) {
    if (!key.former.empty()) rename_key(table, key, path, report);
    if (toml::node* node = table.get(key.name); node && key.below)
      rename_below(*node, *key.below, key.kind, join_path(path, key.name), report);
  }
}

void rename_below(toml::node& node, const Section& section, Kind kind, const std::string& path, Report& report) {
  if (toml::table* table = node.as_table(); table && kind == Kind::table) rename_in(*table, section, path, report);
  const auto rename_element = [&](toml::node& element) {
    if (toml::table* table = element.as_table()) rename_in(*table, section, path, report);
  };
  if (toml::array* list = node.as_array(); list && kind == Kind::table_list)
    for (toml::node& element : *list) rename_element(element);
  if (toml::table* tables = node.as_table(); tables && kind == Kind::named_tables)
    for (auto&& [name, element] : *tables) rename_element(element);
}

}  // namespace

std::string_view gone_word(std::string_view section, std::string_view key) {
  struct Gone {
    std::string_view section, key, instead;
  };
  constexpr Gone gone[] = {{"membranes", "averaging_segments",
                            "no such key any more: strain is not averaged over segments, the geotextile slides over "
                            "what is inside (contents_friction), and tension is reported over gauge_length"}};
  for (const Gone& word : gone)
    if (word.section == section && word.key == key) return word.instead;
  return {};
}

void rename_former_words(toml::table& written, Report& report) { rename_in(written, scene_section(), "", report); }

std::vector<std::string> present_words(std::vector<std::string> parts, Report& report) {
  const Section* section = &scene_section();
  for (std::size_t i = 0; section && i < parts.size(); ++i) {
    const auto key = std::find_if(section->keys.begin(), section->keys.end(), [&](const Key& each) {
      return each.name == parts[i] || (!each.former.empty() && each.former == parts[i]);
    });
    if (key == section->keys.end()) break;
    if (key->name != parts[i]) {
      report.note({}, parts[i], std::string(key->name));
      parts[i] = key->name;
    }
    section = key->below.get();
    if (key->kind == Kind::named_tables || key->kind == Kind::table_list) ++i;  // the element
  }
  return parts;
}

}  // namespace geodrop
