#include "overrides.hpp"
#include "base/nearest_name.hpp"
#include "former_words.hpp"
#include "key_table.hpp"
#include "parse_scene.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

namespace geodrop {
namespace {

/// A mistake in an override: what was found and what is allowed.
struct OverrideError {
  std::string found, allowed;
};

std::string trim(const std::string& text) {
  const char* blanks = " \t";
  const std::size_t begin = text.find_first_not_of(blanks);
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

bool is_bare_text(const std::string& value) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || std::string("_-./ ").find(c) != std::string::npos;
  };
  return std::isalpha(static_cast<unsigned char>(value[0])) && std::all_of(value.begin(), value.end(), plain);
}

/// A table with the one key `x`.
toml::table parse_value(const std::string& value, const std::string& key) {
  try {
    toml::table parsed = toml::parse("x = " + value, std::string_view(kOverrideSource));
    if (parsed.size() == 1) return parsed;
  } catch (const toml::parse_error&) {
    if (is_bare_text(value)) return toml::parse("x = '" + value + "'", std::string_view(kOverrideSource));
  }
  if (const std::string advice = advice_on_value(value, key); !advice.empty()) throw OverrideError{value, advice};
  throw OverrideError{value, "a TOML value: a number, a word, \"a text\", true, [list], { key = value }"};
}

std::optional<std::size_t> to_index(const std::string& word, const toml::array& list) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
  if (error != std::errc() || end != word.data() + word.size() || index >= list.size()) return std::nullopt;
  return index;
}

std::size_t find_element(const toml::array& list, const std::string& word, const std::string& list_name) {
  if (const auto index = to_index(word, list)) return *index;
  std::vector<std::string> names;
  std::vector<std::size_t> hits;
  const auto& sections = section_table();
  const auto section =
      std::find_if(sections.begin(), sections.end(), [&](const Section* s) { return s->path == list_name; });
  for (std::size_t i = 0; section != sections.end() && i < list.size(); ++i) {
    const toml::table* table = list.get(i)->as_table();
    const auto name = table ? (*table)[(*section)->id_key].value<std::string>() : std::nullopt;
    if (name) names.push_back(*name);
    if (name == word) hits.push_back(i);
  }
  if (hits.size() == 1) return hits.front();
  const std::string range = "an index from 0 to " + std::to_string(list.size() - 1);
  if (list.empty()) throw OverrideError{'"' + word + '"', "nothing here: the scene has no " + list_name};
  if (names.empty()) throw OverrideError{'"' + word + '"', range};
  if (!hits.empty()) throw OverrideError{"\"" + word + "\", the name of " + std::to_string(hits.size()), range};
  throw OverrideError{'"' + word + '"', name_advice(word, names, list_name) + "; or " + range};
}

std::vector<std::string> names_in(const toml::table& table) {
  std::vector<std::string> names;
  for (const auto& [name, node] : table) names.emplace_back(name.str());
  return names;
}

/// The node one step down; a table that is not there yet is made, and judged later like one in the file.
toml::node& step_into(toml::node& node, const std::string& word, const std::string& above) {
  if (toml::array* list = node.as_array()) return *list->get(find_element(*list, word, above));
  toml::table* table = node.as_table();
  if (!table) throw OverrideError{above + ", which is a single value", "a key that has keys below it"};
  if (above == "materials" && !table->contains(word)) {
    throw OverrideError{'"' + word + '"', name_advice(word, names_in(*table), "materials")};
  }
  return table->insert(word, toml::table{}).first->second;
}

void set_value(toml::node& node, const std::string& word, const std::string& value, const std::string& above) {
  if (toml::array* list = node.as_array()) {
    const std::size_t index = find_element(*list, word, above);
    toml::table parsed = parse_value(value, word);
    std::move(*parsed.get("x")).visit([&](auto&& x) {
      list->replace(list->cbegin() + static_cast<std::ptrdiff_t>(index), std::forward<decltype(x)>(x));
    });
    return;
  }
  toml::table* table = node.as_table();
  if (!table) throw OverrideError{above + ", which is a single value", "a key that has keys below it"};
  if (value.empty()) {
    if (table->erase(word) == 0)
      throw OverrideError{"no such key to remove", name_advice(word, names_in(*table), "keys here")};
    return;
  }
  toml::table parsed = parse_value(value, word);
  std::move(*parsed.get("x")).visit([&](auto&& x) { table->insert_or_assign(word, std::forward<decltype(x)>(x)); });
}

void apply(toml::table& scene, const std::string& key, const std::string& value, Report& report) {
  const std::vector<std::string> words = present_words(split(key, '.'), report);
  if (std::any_of(words.begin(), words.end(), [](const std::string& word) { return word.empty(); })) {
    throw OverrideError{'"' + key + '"', "a key such as grid.spacing or materials.water.viscosity"};
  }
  toml::node* node = &scene;
  std::string above;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    node = &step_into(*node, words[i], above);
    above = join_path(above, words[i]);
  }
  set_value(*node, words.back(), value, above);
}

}  // namespace

void apply_overrides(toml::table& scene, const std::vector<std::string>& overrides, Report& report) {
  for (const std::string& text : overrides) {
    const std::size_t equals = text.find('=');
    const std::string key = trim(text.substr(0, equals));
    try {
      if (equals == std::string::npos) throw OverrideError{'"' + text + '"', "KEY=VALUE, e.g. grid.spacing=0.125"};
      apply(scene, key, trim(text.substr(equals + 1)), report);
    } catch (const OverrideError& error) {
      report.add_at({}, !key.empty() ? key : text.empty() ? "\"\"" : text, error.found, error.allowed);
    }
  }
}

}  // namespace geodrop
