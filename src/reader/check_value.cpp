#include "check_value.hpp"
#include "base/nearest_name.hpp"
#include "key_table.hpp"
#include "keys/plain_values.hpp"
#include "keys/to_text.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace geodrop {
namespace {

std::string type_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::string:
      return " (a text)";
    case toml::node_type::integer:
      return " (a whole number)";
    case toml::node_type::floating_point:
      return " (a number)";
    case toml::node_type::boolean:
      return " (true or false)";
    case toml::node_type::array:
      return " (a list of " + std::to_string(node.as_array()->size()) + ")";
    case toml::node_type::table:
      return "";
    default:
      return " (a date or time)";
  }
}

ValueCheck wrong_type(const toml::node& node) { return {false, to_text(node) + type_of(node)}; }

ValueCheck check_number(const Key& key, const toml::node& node) {
  if (!node.is_number() || (key.kind == Kind::integer && !node.is_integer())) return wrong_type(node);
  const double value = to_number(node);
  const bool finite = std::isfinite(value) || (key.allowed.infinite && !std::isnan(value));
  return {finite && key.allowed.holds(value), to_text(node)};
}

/// A list of numbers; `size` 0: any number of them.
ValueCheck check_numbers(const Key& key, const toml::node& node, std::size_t size) {
  const toml::array* list = node.as_array();
  if (!list || (size > 0 && list->size() != size)) return wrong_type(node);
  for (const toml::node& element : *list) {
    const ValueCheck check = check_number(key, element);
    if (!check.ok) return {false, check.found + " in " + to_text(node)};
  }
  return {};
}

ValueCheck check_points(const Key& key, const toml::node& node, int dimension) {
  const toml::array* list = node.as_array();
  if (!list) return wrong_type(node);
  for (const toml::node& element : *list) {
    ValueCheck check = check_numbers(key, element, static_cast<std::size_t>(dimension));
    if (!check.ok) return check;
  }
  return {};
}

/// "a" or "b" or "c".
std::string quoted_words(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "\"" : " or \"") + word + '"';
  return text;
}

/// Says of a word that is no choice in this dimension that it is one in the other.
std::string other_dimension(const Key& key, const std::string& word) {
  for (const Key& other : find_section(key.section).keys) {
    if (other.name != key.name || other.dimension == key.dimension) continue;
    if (std::find(other.words.begin(), other.words.end(), word) != other.words.end())
      return "only with " + readable_condition(other);
  }
  return {};
}

ValueCheck check_texts(const Key& key, const toml::node& node) {
  const toml::array* list = node.as_array();
  if (!list) return wrong_type(node);
  for (const toml::node& element : *list) {
    const auto* text = element.as_string();
    if (!text) return {false, to_text(element) + " in " + to_text(node)};
    if (!key.allowed.holds(static_cast<double>(text->get().size()))) return {false, to_text(element)};
  }
  return {};
}

ValueCheck check_text(const Key& key, const toml::node& node) {
  const auto* text = node.as_string();
  if (!text) return wrong_type(node);
  const std::string& word = text->get();
  bool ok = true;
  if (key.kind == Kind::choice) {
    ok = std::find(key.words.begin(), key.words.end(), word) != key.words.end();
    if (!ok && key.words.size() > 1) {
      const std::string nearest = nearest_name(word, key.words);
      std::string more = other_dimension(key, word);
      if (!nearest.empty()) more += (more.empty() ? "" : "; ") + ("the nearest is \"" + nearest + '"');
      return {false, to_text(node) + (more.empty() ? "" : " (" + more + ")")};
    }
  } else if (key.kind == Kind::text) {
    ok = key.allowed.holds(static_cast<double>(word.size()));
  } else {
    ok = is_identifier(word);
  }
  return {ok, to_text(node)};
}

ValueCheck check_names(const Key& key, const toml::node& node) {
  const toml::array* list = node.as_array();
  if (!list) return wrong_type(node);
  for (const toml::node& element : *list) {
    ValueCheck check = check_text(key, element);
    if (!check.ok) return check;
  }
  return {};
}

std::string kind_text(const Key& key, int dimension) {
  const std::string size = dimension == 0
                               ? "as many numbers as dimension"
                               : std::to_string(dimension) + " numbers (dimension = " + std::to_string(dimension) + ")";
  switch (key.kind) {
    case Kind::text:
      return "a text, " + std::string(key.allowed.text);
    case Kind::texts:
      return "a list of texts";
    case Kind::name:
      return "a name (" + std::string(key.allowed.text) + ")";
    case Kind::names:
      return "a list of names (each " + std::string(key.allowed.text) + ")";
    case Kind::choice:
      return quoted_words(key.words);
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
      return "a whole number " + std::string(key.allowed.text);
    case Kind::real:
      return key.allowed.text.starts_with("any") ? std::string(key.allowed.text)
                                                 : "a number " + std::string(key.allowed.text);
    case Kind::reals:
      return "a list of numbers, each " + std::string(key.allowed.text);
    case Kind::point:
      return "a list of " + size + ", each " + std::string(key.allowed.text);
    case Kind::points:
      return "a list of points, each of " + size + ", finite";
    case Kind::table:
      return "a table";
    case Kind::named_tables:
      return "tables [" + std::string(key.name) + ".NAME], " + std::string(key.allowed.text);
    case Kind::table_list:
      return "tables [[" + std::string(key.name) + "]], " + std::string(key.allowed.text);
  }
  return {};
}

}  // namespace

ValueCheck check_value(const Key& key, const toml::node& node, int dimension) {
  switch (key.kind) {
    case Kind::boolean:
      return node.is_boolean() ? ValueCheck{} : wrong_type(node);
    case Kind::integer:
    case Kind::real:
      return check_number(key, node);
    case Kind::reals:
      return check_numbers(key, node, 0);
    case Kind::point:
      return check_numbers(key, node, static_cast<std::size_t>(dimension));
    case Kind::points:
      return check_points(key, node, dimension);
    case Kind::texts:
      return check_texts(key, node);
    case Kind::names:
      return check_names(key, node);
    default:
      return check_text(key, node);
  }
}

std::string describe_allowed(const Key& key, int dimension) {
  std::string text = kind_text(key, dimension);
  if (!key.unit.empty()) text += " [" + std::string(key.unit) + "]";
  return text;
}

std::string readable_condition(const Key& key) {
  std::string text;
  for (const std::string& part : split(key.when, '&')) {
    const std::vector<std::string> sides = split(part, '=');
    text +=
        (text.empty() ? "" : " and ") + sides[0] + (sides.size() > 1 ? " = " + quoted_words(split(sides[1], '|')) : "");
  }
  if (key.dimension != 0) text += (text.empty() ? "" : " and ") + ("dimension = " + std::to_string(key.dimension));
  return text;
}

}  // namespace geodrop
