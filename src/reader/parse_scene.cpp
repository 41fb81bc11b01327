#include "parse_scene.hpp"

#include "base/nearest_name.hpp"
#include "key_table.hpp"
#include "keys/report.hpp"

#include <geodrop/base/input_file.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <regex>
#include <sstream>

namespace geodrop {
namespace {

namespace fs = std::filesystem;

constexpr const char* any_toml = "TOML 1.0, each key once";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

/// Of the keys of this name, if they have one in common.
std::string unit_of_key(std::string_view name) {
  std::string unit;
  for (const Section* section : section_table())
    for (const Key& key : section->keys) {
      if (key.name != name || key.unit.empty()) continue;
      if (!unit.empty() && unit != key.unit) return {};
      unit = key.unit;
    }
  return unit;
}

constexpr std::size_t longest_line = 2000;  // of what regular expressions are asked about

/// A line that stands alone: KEY = VALUE with all its brackets closed.
struct KeyLine {
  std::string key, value;
};
std::optional<KeyLine> key_line(const std::string& line) {
  static const std::regex pattern(R"(^\s*([A-Za-z_][A-Za-z0-9_.]*)\s*=\s*([^#]*?)\s*(#.*)?$)");
  std::smatch found;
  if (line.size() > longest_line || !std::regex_match(line, found, pattern)) return std::nullopt;
  const std::string value = found[2];
  const auto count = [&](char c) { return std::ranges::count(value, c); };
  const bool closed = count('[') == count(']') && count('{') == count('}') && count('"') % 2 == 0;
  if (!closed || value.find("\"\"\"") != std::string::npos) return std::nullopt;
  const std::string key = found[1];
  const std::size_t dot = key.rfind('.');
  return KeyLine{dot == std::string::npos ? key : key.substr(dot + 1), value};
}

/// "bodies" of the line "[bodies]", if there may be several of them.
std::optional<std::string> single_list(const std::string& line) {
  static const std::regex pattern(R"(^\s*\[\s*([a-z_]+)\s*\]\s*(#.*)?$)");
  std::smatch found;
  if (line.size() > longest_line || !std::regex_match(line, found, pattern)) return std::nullopt;
  for (const Key& key : scene_section().keys)
    if (key.name == found[1].str() && key.kind == Kind::table_list) return found[1];
  return std::nullopt;
}

/// "[[bodies]]" of the line "[[bodies]", "[grid]" of "[grid"; nothing if its brackets are closed.
std::optional<std::string> closed_header(const std::string& line) {
  static const std::regex pattern(R"(^\s*(\[\[?)\s*([A-Za-z_][A-Za-z0-9_.]*)\s*(\]?)\s*(#.*)?$)");
  std::smatch found;
  if (line.size() > longest_line || !std::regex_match(line, found, pattern)) return std::nullopt;
  if (found[1].length() == found[3].length()) return std::nullopt;
  return found[1].str() + found[2].str() + std::string(static_cast<std::size_t>(found[1].length()), ']');
}

/// Whether toml++ met the end of the line within quotes: it tells of a control character where the line has none.
bool ends_within_quotes(const std::string& line, const SceneProblem& slip) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\r'; };
  return slip.found.find("control characters") != std::string::npos && std::ranges::none_of(line, is_control);
}

/// The key of a line whose value is nothing but the text that is not closed.
std::optional<std::string> key_of_open_text(const std::string& line) {
  static const std::regex pattern(R"(^\s*([A-Za-z_][A-Za-z0-9_]*)\s*=\s*("[^"]*|'[^']*)$)");
  std::smatch found;
  if (line.size() > longest_line || !std::regex_match(line, found, pattern)) return std::nullopt;
  return found[1];
}

/// Makes the lines such that the next parse gets further; false if it is not known how. Says in the slip what is
/// allowed, and adds to `lost`.
bool mend(std::vector<std::string>& lines, SceneProblem& slip, std::vector<std::string>& lost) {
  const auto number = static_cast<std::size_t>(slip.at.line);
  if (number == 0 || number > lines.size()) return false;
  std::string& line = lines[number - 1];
  std::string& allowed = slip.allowed;
  if (ends_within_quotes(line, slip)) {
    slip.found = "a quote that is not closed in its line";
    allowed = "a closing quote behind the text";
    const std::optional<std::string> open = key_of_open_text(line);
    if (!open) return false;
    lost.push_back(*open);
    line.clear();
    return true;
  }
  if (const auto header = closed_header(line)) {
    line = allowed = *header;
    return true;
  }
  if (const auto list = single_list(line)) {
    allowed = "[[" + *list + "]] above each of several";
    for (std::string& other : lines)
      if (single_list(other) == list) other = "[[" + *list + "]]";
    return true;
  }
  const std::optional<KeyLine> wrong = key_line(line);
  if (!wrong) return false;
  if (const std::string advice = advice_on_value(wrong->value, wrong->key); !advice.empty()) allowed = advice;
  lost.push_back(wrong->key);
  line.clear();
  return true;
}

/// Scenes beside a name that is not there, the nearest of them.
std::string nearest_file(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().filename());
  std::ranges::sort(names);
  const std::string nearest = nearest_name(fs::path(path).filename().string(), names);
  return nearest.empty() ? "" : "; the nearest is " + (folder / nearest).string();
}

}  // namespace

std::string advice_on_value(std::string_view value, std::string_view key) {
  static const std::regex number_with_unit(R"(^[-+]?[0-9][0-9._eE+-]*\s*[A-Za-zµ%°/][A-Za-z0-9%°/^²³ ]*$)");
  static const std::regex comma(R"(^[-+]?[0-9]+,[0-9]+([eE][-+]?[0-9]+)?$)");
  static const std::regex word(R"(^[A-Za-z_][A-Za-z0-9_ -]*$)");
  constexpr std::size_t longest = 200;
  const std::string text(value.substr(0, longest));
  const std::string unit = unit_of_key(key);
  const std::string in = unit.empty() ? "" : ", in " + unit;
  if (std::regex_match(text, comma)) return "a number with a decimal point" + in;
  if (std::regex_match(text, number_with_unit)) return "a number without a unit" + (in.empty() ? ", SI" : in);
  if (std::regex_match(text, word)) return "a text in quotes, \"" + text + "\"";
  return {};
}

ParsedScene parse_scene(const std::string& path) {
  constexpr std::size_t most_slips = 10;
  const fs::path folder = fs::path(path).parent_path();
  const bool missing = !fs::exists(path);
  std::vector<std::string> lines =
      lines_of(read_input(path, "", "a scene in TOML" + (missing ? nearest_file(path) : "")));
  ParsedScene parsed;
  while (parsed.slips.size() < most_slips) {
    try {
      parsed.table = toml::parse(joined(lines), std::string_view(path));
      return parsed;
    } catch (const toml::parse_error& error) {
      parsed.slips.push_back({to_ref(error.source()), "syntax", std::string(error.description()), any_toml});
      if (!mend(lines, parsed.slips.back(), parsed.lost)) break;
    }
  }
  throw SceneError(path, parsed.slips);
}

std::vector<SceneProblem> without(std::vector<SceneProblem> problems, const std::vector<std::string>& keys) {
  std::erase_if(problems, [&](const SceneProblem& problem) {
    return std::ranges::any_of(
        keys, [&](const std::string& key) { return problem.key == key || problem.key.ends_with("." + key); });
  });
  return problems;
}

}  // namespace geodrop
