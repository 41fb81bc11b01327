#include "lasting_text.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

namespace geodrop {
namespace {

/// One table of a scene as run, which has one line for each header and for each key.
struct Block {
  std::string header;  ///< "[grid]"; "" above all headers
  std::vector<std::pair<std::string, std::string>> values;

  std::string value_of(const std::string& key) const {
    const auto found =
        std::find_if(values.begin(), values.end(), [&](const auto& value) { return value.first == key; });
    return found == values.end() ? std::string() : found->second;
  }
};

std::vector<Block> blocks_of(const std::string& text) {
  std::vector<Block> blocks{{}};
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t equals = line.find(" = ");
    if (line.starts_with('['))
      blocks.push_back({line, {}});
    else if (equals != std::string::npos)
      blocks.back().values.emplace_back(line.substr(0, equals), line.substr(equals + 3));
  }
  return blocks;
}

bool lasts(const std::string& header) {
  constexpr std::array passing = {"[output]",   "[checkpoints]", "[[results]]",
                                  "[[expect]]", "[[verify]]",    "[[variants]]"};
  return std::find(passing.begin(), passing.end(), header) == passing.end();
}

bool lasts(const std::string& header, const std::string& key) {
  return !(header.empty() && (key == "title" || key == "question")) && !(header == "[time]" && key == "end");
}

std::string without_brackets(const std::string& header) {
  const std::size_t begin = header.find_first_not_of('['), end = header.find_last_not_of(']');
  return begin == std::string::npos ? "" : header.substr(begin, end - begin + 1);
}

using Values = std::vector<std::pair<std::string, std::string>>;

/// Full keys, as messages name them: "bodies.water.material", "contacts.0.friction".
Values values_of(const std::string& text) {
  Values all;
  std::map<std::string, int> count;
  for (const Block& block : blocks_of(text)) {
    std::string path = without_brackets(block.header);
    if (block.header.starts_with("[[")) {
      const int index = count[path]++;
      const std::string name = block.value_of("name");
      path += '.' + (name.size() > 2 ? name.substr(1, name.size() - 2) : std::to_string(index));
    }
    if (!path.empty()) all.emplace_back(path, "");
    for (const auto& [key, value] : block.values) all.emplace_back((path.empty() ? "" : path + '.') + key, value);
  }
  return all;
}

}  // namespace

std::string lasting_text(const std::string& as_run) {
  std::string text;
  for (const Block& block : blocks_of(as_run)) {
    if (!lasts(block.header)) continue;
    if (!block.header.empty()) text += block.header + '\n';
    for (const auto& [key, value] : block.values)
      if (lasts(block.header, key)) text += key + " = " + value + '\n';
  }
  return text;
}

std::string first_difference(const std::string& there, const std::string& here) {
  const Values old_values = values_of(there), new_values = values_of(here);
  const std::map<std::string, std::string> before(old_values.begin(), old_values.end());
  const std::map<std::string, std::string> now(new_values.begin(), new_values.end());
  for (const auto& [key, value] : old_values) {
    const auto found = now.find(key);
    if (found == now.end()) return key + (value.empty() ? "" : " = " + value) + ", which is not here";
    if (found->second != value) return key + " = " + value + ", here " + found->second;
  }
  for (const auto& [key, value] : new_values)
    if (!before.contains(key)) return "no " + key + ", here " + (value.empty() ? "it is" : value);
  return there == here ? "" : "the order of its tables";
}

}  // namespace geodrop
