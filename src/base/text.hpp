// Numbers and tables as text, the same everywhere in a run directory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace geodrop {

/// Nine significant digits; "nan", "inf", "-inf" where it is none.
std::string format_number(double value, int digits = 9);

/// For tables that people read: four significant digits, and all those before the point of values below 1e9; "-" where
/// it is no number.
std::string short_number(double value);

/// 16 hex digits.
std::string format_hash(std::uint64_t hash);

/// Lines of cells in aligned columns, two spaces apart; `alignment` has a letter per column, l or r.
std::string format_table(const std::vector<std::vector<std::string>>& lines, const std::string& alignment);

/// "1:02:03", "2:03"; "-" if not finite.
std::string format_duration(double seconds);

}  // namespace geodrop
