#include "text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace geodrop {

std::string format_number(double value, int digits) {
  if (std::isnan(value)) return "nan";  // without the sign bit of a NaN
  return fmt::format("{:.{}g}", value, digits);
}

std::string short_number(double value) {
  constexpr double longest = 1e9;
  if (std::isnan(value)) return "-";
  const bool whole = std::abs(value) >= 1e4 && std::abs(value) < longest;
  return whole ? format_number(std::round(value), 10) : format_number(value, 4);
}

std::string format_hash(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

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
  const long hours = total / 3600, minutes = total / 60 % 60, rest = total % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, rest) : fmt::format("{}:{:02}", minutes, rest);
}

}  // namespace geodrop
