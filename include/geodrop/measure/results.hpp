// Named results of a run: columns of its history reduced to single numbers, and what was expected of them.
#pragma once

#include <geodrop/measure/history.hpp>
#include <geodrop/scene/scene.hpp>
#include <limits>
#include <string>
#include <vector>

namespace geodrop {

/// One number that a run ends with.
struct Result {
  std::string name;
  double value = 0;  ///< NaN if the history does not reach so far
  std::string unit;  ///< from the end of the name
  /// Of the largest tension of a membrane: by which share its T kappa differs from the pressure on it in that row; else
  /// NaN [-].
  double balance_error = std::numeric_limits<double>::quiet_NaN();
};

/// Beyond this balance_error a tension is no equilibrium, and an expectation of it fails: nothing bears it but the
/// grid.
inline constexpr double most_balance_error = 0.5;

/// A result beside what was expected of it.
struct Expectation {
  Result result;
  double expected = 0, tolerance = 0;  ///< in the unit of the result
  std::string source;
  bool met = false;  ///< |value - expected| <= tolerance, and a largest tension is in balance
};

/// Throws SceneError if a result names a column that the scene's history does not have.
void check_results(const Scene& scene);

/// Applies a reduction to the rows with from <= t <= to. Rows whose value is NaN are left out; NaN if none is left.
double reduce(const ResultSpec& spec, const HistoryTable& history);

std::vector<Result> reduce_all(const Scene& scene, const HistoryTable& history);
std::vector<Expectation> compare(const Scene& scene, const std::vector<Result>& results);

/// Aligned table: name, value, unit, expected, tolerance, met, source. Results without expectation come after.
std::string results_table(const std::vector<Result>& results, const std::vector<Expectation>& expectations);

}  // namespace geodrop
