// From the rows of the history to named results, and their table beside what was expected.
#include <algorithm>
#include <cmath>
#include <geodrop/base/error.hpp>
#include <geodrop/base/find_named.hpp>
#include <geodrop/measure/results.hpp>
#include <limits>

#include "base/nearest_name.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "membrane_balance.hpp"
#include "series.hpp"

namespace geodrop {
namespace {

/// Rows of a column within the window of the result, without those whose value is NaN.
Series column_series(const ResultSpec& spec, const std::string& column, const HistoryTable& history) {
  const std::size_t c = history.find(column);
  Series series;
  for (const std::vector<double>& row : history.rows) {
    const double t = row.front();
    if (t < spec.from || t > spec.to || std::isnan(row.at(c))) continue;
    series.t.push_back(t);
    series.value.push_back(row[c]);
  }
  return series;
}

double reduce_series(const ResultSpec& spec, const Series& series, const HistoryTable& history) {
  const std::vector<double>& v = series.value;
  if (v.empty()) return std::numeric_limits<double>::quiet_NaN();
  switch (spec.reduce) {
    case Reduction::last:
      return v.back();
    case Reduction::min:
      return *std::min_element(v.begin(), v.end());
    case Reduction::max:
      return *std::max_element(v.begin(), v.end());
    case Reduction::mean:
      return mean(v);
    case Reduction::rms:
      return rms(v);
    case Reduction::percentile:
      return percentile(v, spec.percentile);
    case Reduction::period:
      return period(series);
    case Reduction::first_time_below:
      return first_time_below(series, spec.level);
    case Reduction::rms_difference:
      return rms_difference(series, spec.times, spec.values);
    case Reduction::r_squared:
      return r_squared(series, column_series(spec, spec.against, history));
    case Reduction::slope:
      return slope(series);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// Of a result that is the largest of a membrane's tensions: the error of its balance in that row.
double balance_error(const ResultSpec& spec, const HistoryTable& history) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const std::size_t dot = std::min(spec.column.find(".tension_gauge_N_m"), spec.column.find(".tension_max_N_m"));
  if (spec.reduce != Reduction::max || dot == std::string::npos) return none;
  const std::size_t tension = history.find(spec.column),
                    error = history.find(spec.column.substr(0, dot) + balance_column);
  if (error == history.columns.size()) return none;
  const std::vector<double>* largest = nullptr;
  for (const std::vector<double>& row : history.rows)
    if (row.front() >= spec.from && row.front() <= spec.to && (!largest || row[tension] > (*largest)[tension]))
      largest = &row;
  return largest ? (*largest)[error] : none;
}

bool out_of_balance(const Result& result) { return result.balance_error > most_balance_error; }

std::string verdict(const Expectation& expectation) {
  if (expectation.met) return "yes";
  if (std::isnan(expectation.result.value)) return "NO, not reached";
  return out_of_balance(expectation.result) ? "NO, out of balance" : "NO";
}

std::vector<std::string> expectation_cells(const Expectation& expectation) {
  const Result& result = expectation.result;
  return {result.name,
          short_number(result.value),
          shown_unit(result.unit),
          short_number(expectation.expected),
          "+-" + short_number(expectation.tolerance),
          verdict(expectation),
          expectation.source};
}

}  // namespace

void check_results(const Scene& scene) {
  const std::vector<std::string> columns = history_columns(scene);
  std::vector<SceneProblem> problems;
  const auto check = [&](const ResultSpec& spec, const char* key, const std::string& column) {
    if (std::find(columns.begin(), columns.end(), column) != columns.end()) return;
    const std::string nearest = nearest_name(column, columns);
    problems.push_back({spec.at, "results." + spec.name + "." + key, '"' + column + '"',
                        "a column of history.csv" + (nearest.empty() ? "" : "; nearest: \"" + nearest + '"')});
  };
  for (const ResultSpec& spec : scene.results) {
    check(spec, "column", spec.column);
    if (spec.reduce == Reduction::r_squared) check(spec, "against", spec.against);
  }
  if (!problems.empty()) throw SceneError(scene.file, problems);
}

double reduce(const ResultSpec& spec, const HistoryTable& history) {
  return spec.scale * reduce_series(spec, column_series(spec, spec.column, history), history);
}

std::vector<Result> reduce_all(const Scene& scene, const HistoryTable& history) {
  std::vector<Result> results;
  const auto time_of = [&](const std::string& event, double never) {
    const Result* const found = find_or_null(results, event);
    return !found || std::isnan(found->value) ? never : found->value;
  };
  constexpr double always = std::numeric_limits<double>::infinity();
  for (ResultSpec spec : scene.results) {
    if (!spec.after.empty()) spec.from = std::max(spec.from, time_of(spec.after, always));
    spec.to = std::min(spec.to, time_of(spec.before, always));
    results.push_back({spec.name, reduce(spec, history), unit_of_name(spec.name), balance_error(spec, history)});
  }
  return results;
}

std::vector<Expectation> compare(const Scene& scene, const std::vector<Result>& results) {
  std::vector<Expectation> expectations;
  for (const ExpectSpec& spec : scene.expect) {
    const Result* const found = find_or_null(results, spec.result);
    if (!found)
      throw SceneError(scene.file, {{spec.at, "expect.result", '"' + spec.result + '"', "the name of a result"}});
    const bool met = std::abs(found->value - spec.expected) <= spec.tolerance && !out_of_balance(*found);
    expectations.push_back({*found, spec.expected, spec.tolerance, spec.source, met});
  }
  return expectations;
}

std::string results_table(const std::vector<Result>& results, const std::vector<Expectation>& expectations) {
  std::vector<std::vector<std::string>> lines = {{"result", "value", "unit", "expected", "tolerance", "met", "source"}};
  for (const Expectation& expectation : expectations) lines.push_back(expectation_cells(expectation));
  for (const Result& result : results) {
    const bool shown = std::any_of(expectations.begin(), expectations.end(),
                                   [&](const Expectation& e) { return e.result.name == result.name; });
    if (!shown) lines.push_back({result.name, short_number(result.value), shown_unit(result.unit)});
  }
  return format_table(lines, "lrlrrll");
}

}  // namespace geodrop
