// Scenes with mistakes that a person, an editor or a careless script could make, and some that only malice makes.
#pragma once

#include "fuzz/fuzz.hpp"
#include "support/scene_files.hpp"

#include <algorithm>

namespace geodrop::fuzz {

inline void add_scenes(const std::string& folder, std::vector<std::string>& texts) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(source_path(folder)))
    if (entry.path().extension() == ".toml") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  for (const auto& path : paths) texts.push_back(read_file(path));
}

/// Every scene of the repository, good and bad.
inline const std::vector<std::string>& scene_texts() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> texts;
    for (const char* folder : {"cases", "cases/verification", "tests/bad_scenes", "tests/scene", "tests/scenes"})
      add_scenes(folder, texts);
    return texts;
  }();
  return all;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

inline std::string join(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// Begin and length of a piece of text that consists of such letters; nothing if there is none.
template <class Letter>
std::pair<std::size_t, std::size_t> some_run(const std::string& text, Chance& chance, Letter letter) {
  if (text.empty()) return {0, 0};
  const std::size_t from = chance.below(text.size());
  const auto begin = static_cast<std::size_t>(
      std::find_if(text.begin() + static_cast<std::ptrdiff_t>(from), text.end(), letter) - text.begin());
  std::size_t end = begin;
  while (end < text.size() && letter(text[end])) ++end;
  return {begin, end - begin};
}

inline bool in_number(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == 'e'; }
inline bool in_word(char c) { return (c >= 'a' && c <= 'z') || c == '_'; }

inline void change_number(std::string& text, Chance& chance) {
  const auto [begin, length] = some_run(text, chance, in_number);
  if (length == 0) return;
  std::string number = chance.of(odd_numbers());
  if (chance.one_in(2)) {
    static const std::vector<std::string> powers{"e1", "e-1", "e3", "e-3", "e9"};
    number = text.substr(begin, length) + chance.of(powers);
  }
  text.replace(begin, length, number);
}

inline void swap_words(std::string& text, Chance& chance) {
  const auto [begin, length] = some_run(text, chance, in_word);
  const std::string& other = chance.of(scene_texts());
  const auto [from, count] = some_run(chance.one_in(2) ? other : text, chance, in_word);
  const std::string word = (chance.one_in(2) ? other : text).substr(0, from + count);
  if (from < word.size()) text.replace(begin, length, word.substr(from));
}

/// Removes, repeats, moves or borrows a line.
inline void change_line(std::string& text, Chance& chance) {
  std::vector<std::string> lines = lines_of(text);
  if (lines.empty()) return;
  const auto at = lines.begin() + static_cast<std::ptrdiff_t>(chance.below(lines.size()));
  const std::string line = *at;
  switch (chance.below(4)) {
    case 0:
      lines.erase(at);
      break;
    case 1:
      lines.insert(at, line);
      break;
    case 2:
      lines.erase(at);
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(chance.below(lines.size() + 1)), line);
      break;
    default: {
      const std::vector<std::string> others = lines_of(chance.of(scene_texts()));
      lines.insert(at, others[chance.below(others.size())]);
    }
  }
  text = join(lines);
}

/// A table with its keys, from this scene or another, once or many times.
inline void add_table(std::string& text, Chance& chance) {
  const std::vector<std::string> lines = lines_of(chance.one_in(2) ? text : chance.of(scene_texts()));
  std::vector<std::size_t> heads;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].starts_with('[')) heads.push_back(i);
  if (heads.empty()) return;
  const std::size_t head = chance.below(heads.size());
  const std::size_t end = head + 1 < heads.size() ? heads[head + 1] : lines.size();
  const std::string table = join(
      {lines.begin() + static_cast<std::ptrdiff_t>(heads[head]), lines.begin() + static_cast<std::ptrdiff_t>(end)});
  const std::size_t times = chance.one_in(40) ? 1 + chance.below(400) : 1;
  for (std::size_t i = 0; i < times; ++i) text += "\n" + table;
}

inline void change_bytes(std::string& text, Chance& chance) {
  for (std::size_t i = 0; i <= chance.below(8); ++i) {
    const std::size_t at = chance.below(text.size() + 1);
    static const std::vector<std::string> pieces{
        std::string(1, '\0'), "\xff", "\xc3", "\xed\xa0\x80", "[", "]", "\"", "'''", "\\u", "=", ",", "\r", "{", "}"};
    if (chance.one_in(3) && at < text.size())
      text[at] = static_cast<char>(chance.below(256));
    else
      text.insert(at, chance.of(pieces));
  }
}

/// Nesting, keys and texts beyond all measure.
inline void add_monster(std::string& text, Chance& chance) {
  const std::size_t size = 1 + chance.below(3000);
  std::string key = "a";
  for (std::size_t i = 0; i < size; ++i) key += ".a";
  const std::vector<std::string> monsters{"x = " + std::string(size, '[') + std::string(size, ']') + "\n",
                                          key + " = 1\n",
                                          "[" + key + "]\n",
                                          "question = \"" + std::string(100 * size, 'x') + "\"\n",
                                          "gravity = [" + std::string(size, '-') + "9.81]\n",
                                          "title = '''" + std::string(10 * size, '\n') + "'''\n"};
  const std::string& monster = monsters[chance.below(monsters.size())];
  text = chance.one_in(2) ? monster + text : text + monster;
}

inline std::string changed_scene(Chance& chance) {
  std::string text = chance.of(scene_texts());
  for (std::size_t i = 0; i <= chance.below(4); ++i) {
    switch (chance.below(20)) {
      case 0:
        add_monster(text, chance);
        break;
      case 1:
      case 2:
        change_bytes(text, chance);
        break;
      case 3:
      case 4:
        add_table(text, chance);
        break;
      case 5:
      case 6:
      case 7:
        change_line(text, chance);
        break;
      case 8:
      case 9:
      case 10:
        swap_words(text, chance);
        break;
      default:
        change_number(text, chance);
    }
  }
  return text;
}

}  // namespace geodrop::fuzz
