#include "key_units.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "key_table.hpp"

namespace geodrop {

std::string_view unit_of_path(std::string_view path) {
  const std::vector<std::string> words = split(path, '.');
  const Section* section = &scene_section();
  for (std::size_t i = 0; i < words.size(); ++i) {
    std::vector<const Key*> named;
    for (const Key& key : section->keys)
      if (key.name == words[i]) named.push_back(&key);
    if (named.empty()) return {};
    const Key& first = *named.front();
    if (!first.below) {
      const auto same = [&](const Key* key) { return key->unit == first.unit; };
      return std::ranges::all_of(named, same) ? first.unit : std::string_view();
    }
    if (first.kind == Kind::table_list || first.kind == Kind::named_tables) ++i;  // over the name
    section = first.below.get();
  }
  return {};
}

}  // namespace geodrop
