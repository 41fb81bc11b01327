#include "judge.hpp"
#include "base/units.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/reader/scene_reader.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

namespace geodrop {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double result_of(const VariantRun& run, const std::string& name) {
  const Result* const found = find_or_null(run.results, name);
  return found ? found->value : not_a_number;
}

double value_of(const VerifySpec& spec, const VariantRun& run) {
  if (run.status != RunStatus::done) return not_a_number;
  const double value = result_of(run, spec.result);
  return spec.over.empty() ? value : value / result_of(run, spec.over);
}

/// Quick runs stop at a coarser grid, and may have a target of their own; a known miss is held to its guard.
double bar_of(const VerifySpec& spec, VerifyMode mode) {
  if (mode == VerifyMode::quick && spec.quick_target > 0) return spec.quick_target;
  return spec.shortfall.empty() ? spec.target : spec.guard;
}

VerifyRow row_of(const Scene& scene, const VerifySpec& spec, VerifyMode mode) {
  VerifyRow row;
  row.scene = std::filesystem::path(scene.file).stem().string();
  row.what = spec.what;
  row.result = spec.result;
  row.unit = spec.over.empty() ? unit_of_name(spec.result) : "";
  row.expected = spec.expected;
  row.kind = spec.kind;
  row.target = spec.target;
  row.bar = bar_of(spec, mode);
  row.least_order = spec.least_order;
  row.source = spec.source;
  row.shortfall = spec.shortfall;
  row.loose = spec.loose;
  return row;
}

bool belongs_to(const VariantRun& control, const VerifySpec& spec) {
  return control.of.empty() || std::find(control.of.begin(), control.of.end(), spec.result) != control.of.end();
}

void add_run(const VerifySpec& spec, const VariantRun& run, VerifyRow& row) {
  row.runs.push_back(&run);
  row.values.push_back(value_of(spec, run));
  row.errors.push_back(error_of(spec, run));
}

/// The order counts like the target. It excuses nothing: a row that is held to a quick target needs it too.
Verdict verdict_of(const VerifyRow& row) {
  if (row.errors.empty()) return Verdict::missed;
  const double error = row.errors.back();
  const bool converges = !row.judges_order || row.order >= row.least_order;
  if (!(error <= row.bar)) return Verdict::missed;
  if (error <= row.target && converges) return Verdict::met;
  if (!row.shortfall.empty()) return Verdict::guarded;
  return converges ? Verdict::coarse : Verdict::missed;
}

VerifyRow measure_row(const Scene& scene, const VerifySpec& spec, const std::vector<VariantRun>& runs,
                      VerifyMode mode) {
  VerifyRow row = row_of(scene, spec, mode);
  std::vector<double> spacings;
  for (const VariantRun& run : runs) {
    if (run.control) {
      row.controlled = row.controlled || belongs_to(run, spec);
      continue;
    }
    add_run(spec, run, row);
    spacings.push_back(run.spacing);
  }
  row.order = observed_order(spacings, row.errors);
  const bool several = std::set<double>(spacings.begin(), spacings.end()).size() > 1;
  row.judges_order = spec.least_order > 0 && (several || mode == VerifyMode::full);
  row.verdict = verdict_of(row);
  return row;
}

bool fails_as_it_must(const VariantRun& run, const VerifyRow& row) {
  if (run.breaks.empty()) return run.status == RunStatus::done && row.errors.back() > row.bar;
  return run.status == RunStatus::failed && run.message.find(run.breaks) != std::string::npos;
}

VerifyRow control_row(const Scene& scene, const VerifySpec& spec, const VariantRun& run, VerifyMode mode) {
  VerifyRow row = row_of(scene, spec, mode);
  add_run(spec, run, row);
  row.misses = row.what;
  row.what = "control: " + run.name;
  row.shortfall.clear();
  row.loose.clear();
  row.least_order = 0;
  row.order = not_a_number;
  row.control = true;
  row.verdict = fails_as_it_must(run, row) ? Verdict::met : Verdict::missed;
  return row;
}

}  // namespace

double error_of(const VerifySpec& spec, const VariantRun& run) {
  const double scale = spec.scale > 0 ? spec.scale : std::abs(spec.expected);
  return std::abs(value_of(spec, run) - spec.expected) / scale;
}

double observed_order(const std::vector<double>& spacings, const std::vector<double>& errors) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (!(errors[i] > 0)) return not_a_number;
    const double log_h = std::log(spacings[i]), log_e = std::log(errors[i]);
    n += 1;
    x += log_h;
    y += log_e;
    xx += log_h * log_h;
    xy += log_h * log_e;
  }
  const double spread = n * xx - x * x;
  constexpr double rounding = 1e-9;
  return spread > rounding ? (n * xy - x * y) / spread : not_a_number;
}

std::vector<VerifyRow> judge(const Scene& scene, const std::vector<VariantRun>& runs, VerifyMode mode) {
  std::vector<VerifyRow> rows;
  for (const VerifySpec& spec : scene.verify) rows.push_back(measure_row(scene, spec, runs, mode));
  for (const VariantRun& run : runs)
    for (const VerifySpec& spec : scene.verify)
      if (run.control && belongs_to(run, spec)) rows.push_back(control_row(scene, spec, run, mode));
  return rows;
}

double slack(const VerifyRow& row) {
  if (row.control || row.errors.empty()) return not_a_number;
  return row.bar / row.errors.back();
}

bool is_loose(const VerifyRow& row) {
  constexpr double rounding = 1.02;  // targets and errors are written with two or three digits
  return slack(row) > most_slack * rounding;
}

std::string word_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::met:
      return "yes";
    case Verdict::coarse:
      return "coarse";
    case Verdict::guarded:
      return "known, guarded";
    case Verdict::missed:
      break;
  }
  return "NO";
}

}  // namespace geodrop
