#include "panel_unit.hpp"

#include "base/figures.hpp"

#include <algorithm>
#include <cmath>

namespace geodrop {
namespace {

using Values = std::vector<double> ChartSeries::*;

std::string bring_to_unit(ChartPanel& panel, Values values, const std::string& quantity, const std::string& unit) {
  double largest = 0;
  for (const ChartSeries& series : panel.series)
    for (const double value : series.*values)
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  const Scaled scaled = scaled_unit(unit, largest);
  for (ChartSeries& series : panel.series)
    for (double& value : series.*values) value *= scaled.factor;
  return quantity + " [" + (scaled.unit.empty() ? "-" : scaled.unit) + "]";
}

}  // namespace

void set_x_unit(ChartPanel& panel, const std::string& quantity, const std::string& unit) {
  panel.x_label = bring_to_unit(panel, &ChartSeries::x, quantity, unit);
}

void set_y_unit(ChartPanel& panel, const std::string& quantity, const std::string& unit) {
  panel.y_label = bring_to_unit(panel, &ChartSeries::y, quantity, unit);
}

}  // namespace geodrop
