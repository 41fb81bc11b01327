#include "units.hpp"

#include <algorithm>
#include <string_view>

namespace geodrop {
namespace {

struct Ending {
  std::string_view ending, unit;
};

/// Longer endings stand before those that they contain ("_kg_m3" before "_m3", "_N_m" before "_m").
constexpr Ending endings[] = {
    {"_kg_m_s", "kg m/s"}, {"_kg_m3", "kg/m3"}, {"_kg_m2", "kg/m2"}, {"_kg_m", "kg/m"}, {"_m_s2", "m/s2"},
    {"_rad_s2", "rad/s2"}, {"_rad_s", "rad/s"}, {"_J_m", "J/m"},     {"_N_s", "N s"},   {"_N_m", "N/m"},
    {"_m2_s", "m2/s"},     {"_m3_s", "m3/s"},   {"_m_s", "m/s"},     {"_1_s", "1/s"},   {"_Pa", "Pa"},
    {"_kg", "kg"},         {"_rad", "rad"},     {"_deg", "degree"},  {"_m3", "m3"},     {"_m2", "m2"},
    {"_J", "J"},           {"_N", "N"},         {"_m", "m"},         {"_s", "s"},       {"_ratio", "1"},
    {"_r_squared", "1"},   {"_count", "1"},
};

const Ending* find_ending(const std::string& name) {
  for (const Ending& known : endings)
    if (name.size() > known.ending.size() && name.ends_with(known.ending)) return &known;
  return nullptr;
}

}  // namespace

std::string unit_of_name(const std::string& name) {
  const Ending* const found = find_ending(name);
  return found ? std::string(found->unit) : std::string();
}

std::string shown_unit(const std::string& unit) { return unit == "1" ? "" : unit; }

std::string unit_ending(const std::string& name) {
  const Ending* const found = find_ending(name);
  return found ? std::string(found->ending) : std::string();
}

std::string in_words(std::string name) {
  if (!name.ends_with("_r_squared")) name.resize(name.size() - unit_ending(name).size());
  std::ranges::replace_if(
      name, [](char c) { return c == '_' || c == '.'; }, ' ');
  return name;
}

}  // namespace geodrop
