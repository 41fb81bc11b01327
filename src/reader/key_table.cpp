#include "key_table.hpp"

#include "reader/sections/sections.hpp"

#include <algorithm>
#include <cassert>
#include <stdexcept>

namespace geodrop {
namespace {

void set_paths(Section& section, const std::string& path) {
  section.path = path;
  for (Key& key : section.keys) {
    key.section = path;
    if (key.below) set_paths(*key.below, join_path(path, key.name));
  }
}

void list(const Section& section, std::vector<const Section*>& sections) {
  sections.push_back(&section);
  for (const Key& key : section.keys)
    if (key.below) list(*key.below, sections);
}

}  // namespace

const Section& scene_section() {
  static const Section top = [] {
    Section section = top_level();
    set_paths(section, "");
    return section;
  }();
  return top;
}

const std::vector<const Section*>& section_table() {
  static const std::vector<const Section*> all = [] {
    std::vector<const Section*> sections;
    list(scene_section(), sections);
    return sections;
  }();
  return all;
}

const Section& find_section(std::string_view path) {
  const auto& all = section_table();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Section* each) { return each->path == path; });
  assert(found != all.end() && "every table key has a section");
  return **found;
}

std::string word_of(std::string_view section, std::string_view name, int enumerator) {
  for (const Key& key : find_section(section).keys)
    for (std::size_t i = 0; key.name == name && i < key.numbers.size(); ++i)
      if (key.numbers[i] == enumerator) return key.words[i];
  throw std::logic_error("no such choice");
}

}  // namespace geodrop
