// history.csv of a run as a picture with a panel for each kind of column, beside what its scene says of them.
#pragma once

#include "chart.hpp"
#include "csv_table.hpp"
#include "reference_lines.hpp"

#include <string>
#include <vector>

namespace geodrop {

/// Panels of position, velocity, tension and energy, those that the table has columns of. Lines that move too little to
/// be seen beside the others, or lie on one of them, are left out and named below the title, as are references too far
/// from the curves.
Chart history_chart(const CsvTable& table, const std::string& title, const std::vector<ReferenceLine>& references);

}  // namespace geodrop
