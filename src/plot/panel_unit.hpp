// Numbers of a panel in a unit of fitting size: kN/m in place of 2.1e4 N/m.
#pragma once

#include "chart.hpp"

#include <string>

namespace geodrop {

/// Brings the values along an axis from `unit` to thousands or millions of it, where the largest is that large, and
/// names the axis "QUANTITY [UNIT]".
void set_x_unit(ChartPanel& panel, const std::string& quantity, const std::string& unit);
void set_y_unit(ChartPanel& panel, const std::string& quantity, const std::string& unit);

}  // namespace geodrop
