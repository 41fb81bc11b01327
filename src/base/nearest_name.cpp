#include "nearest_name.hpp"

#include <algorithm>
#include <cctype>

namespace geodrop {

int edit_distance(std::string_view a, std::string_view b) {
  const auto same = [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  };
  std::vector<std::vector<int>> d(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = static_cast<int>(i);
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replace = d[i - 1][j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, replace});
      const bool swapped = i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]);
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& known) {
  constexpr std::size_t compared = 200;  // letters: a name of a megabyte would take minutes
  const auto distance = [begin = name.substr(0, compared)](std::string_view other) {
    return edit_distance(begin, other.substr(0, compared));
  };
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
    return distance(a) < distance(b);
  });
  if (nearest == known.end()) return "";
  const std::string_view longer = name.size() < nearest->size() ? *nearest : name;
  const std::string_view shorter = name.size() < nearest->size() ? name : *nearest;
  constexpr std::size_t least_part = 4;  // letters of a word that goes on or stops early
  const bool part = (shorter.size() >= least_part && longer.find(shorter) != std::string_view::npos) ||
                    (longer.size() == 2 && longer.starts_with(shorter));
  const int limit = std::max(1, static_cast<int>(std::min(longer.size(), compared)) / 3);
  return part || (distance(*nearest) <= limit && shorter.size() > 1) ? *nearest : "";
}

std::string name_advice(std::string_view name, const std::vector<std::string>& known, std::string_view kind) {
  if (known.empty()) return "nothing here: the scene has no " + std::string(kind);
  std::string text = "one of ";
  for (const std::string& word : known) text += (&word == &known.front() ? "\"" : ", \"") + word + '"';
  const std::string nearest = nearest_name(name, known);
  return nearest.empty() ? text : text + "; the nearest is \"" + nearest + '"';
}

}  // namespace geodrop
