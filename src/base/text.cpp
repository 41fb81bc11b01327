#include "text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace geodrop {

std::string format_number(double value, int digits) {
  if (std::isnan(value)) return "nan";  // printf writes the sign bit of a NaN, too
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

std::string format_hash(std::uint64_t hash) {
  std::array<char, 17> text;
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
  return text.data();
}

std::string format_table(const std::vector<std::vector<std::string>>& lines, const std::string& alignment) {
  std::vector<std::size_t> width(alignment.size(), 0);
  for (const auto& line : lines)
    for (std::size_t c = 0; c < line.size(); ++c) width[c] = std::max(width[c], line[c].size());
  std::string text;
  for (const auto& line : lines) {
    std::string row;
    for (std::size_t c = 0; c < line.size(); ++c) {
      const std::string fill(width[c] - line[c].size(), ' ');
      row += (c == 0 ? "" : "  ") + (alignment[c] == 'r' ? fill + line[c] : line[c] + fill);
    }
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + "\n";
  }
  return text;
}

std::string format_duration(double seconds) {
  constexpr double longest = 1e9;  // beyond that it is a division by nearly nothing
  if (!(seconds >= 0 && seconds < longest)) return "-";
  const auto total = static_cast<long>(std::lround(seconds));
  std::array<char, 64> text;
  if (total >= 3600)
    std::snprintf(text.data(), text.size(), "%ld:%02ld:%02ld", total / 3600, total / 60 % 60, total % 60);
  else
    std::snprintf(text.data(), text.size(), "%ld:%02ld", total / 60, total % 60);
  return text.data();
}

}  // namespace geodrop
