// What a scene says of the columns of its history: strengths of geotextiles, and values that are expected of results.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <functional>
#include <string>
#include <vector>

#include "calculators/tension_safety.hpp"

namespace geodrop {

/// A value beside a column of history.csv.
struct ReferenceLine {
  std::string column, name;  ///< "geotextile.tension_gauge_N_m", "strength of geotextile"
  double value = 0;          ///< in the unit of the column
  double from = 0, to = 0;   ///< the time that it is for [s]; infinite: to the end of the run
};

/// Strengths, and where `factors` reduce them also what they leave; expectations of results that are a value of their
/// column (largest, mean, last, ...). `time_of`: a result of the run by its name [s], NaN: never.
std::vector<ReferenceLine> reference_lines(const Scene& scene, const TensionStrength& factors,
                                           const std::function<double(const std::string&)>& time_of);

}  // namespace geodrop
