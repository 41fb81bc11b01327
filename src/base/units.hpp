// Names of columns and results end in their unit.
#pragma once

#include <string>

namespace geodrop {

/// The unit in which a column of history.csv or a result is named to end, e.g. "m/s" for `fall_velocity_max_m_s` and
/// "1" for `pressure_ratio`; empty if the name ends in no known unit.
std::string unit_of_name(const std::string& name);

/// As people read it: none for "1".
std::string shown_unit(const std::string& unit);

/// The ending of a name that is its unit, "_m_s" of `fall_velocity_max_m_s`; empty if the name ends in no known unit.
std::string unit_ending(const std::string& name);

/// "container.velocity_y_m_s" as "container velocity y", "stress_r_squared" as "stress r squared".
std::string in_words(std::string name);

}  // namespace geodrop
