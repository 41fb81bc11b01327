#include "judge.hpp"

#include <geodrop/scene_reader.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace geodrop {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double value_of(const VerifySpec& spec, const VariantRun& run) {
  if (run.status != RunStatus::done) return not_a_number;
  const auto found = std::find_if(run.results.begin(), run.results.end(),
                                  [&](const Result& result) { return result.name == spec.result; });
  return found == run.results.end() ? not_a_number : found->value;
}

VerifyRow row_of(const Scene& scene, const VerifySpec& spec, VerifyMode mode) {
  VerifyRow row;
  row.scene = std::filesystem::path(scene.file).stem().string();
  row.what = spec.what;
  row.result = spec.result;
  row.unit = unit_of_name(spec.result);
  row.expected = spec.expected;
  const bool quick = mode == VerifyMode::quick;
  row.target = quick && spec.quick_target > 0 ? spec.quick_target : spec.target;
  row.least_order = quick ? 0 : spec.least_order;
  row.source = spec.source;
  row.shortfall = spec.shortfall;
  return row;
}

void add_run(const VerifySpec& spec, const VariantRun& run, VerifyRow& row) {
  row.runs.push_back(&run);
  row.values.push_back(value_of(spec, run));
  row.errors.push_back(error_of(spec, run));
}

VerifyRow measure_row(const Scene& scene, const VerifySpec& spec, const std::vector<VariantRun>& runs,
                      VerifyMode mode) {
  VerifyRow row = row_of(scene, spec, mode);
  std::vector<double> spacings;
  for (const VariantRun& run : runs) {
    if (run.control) continue;
    add_run(spec, run, row);
    spacings.push_back(run.spacing);
  }
  row.order = observed_order(spacings, row.errors);
  const bool converges = row.least_order == 0 || row.order >= row.least_order;
  const bool met = !row.errors.empty() && row.errors.back() <= row.target && converges;
  // A target that is set for quick runs is one that they meet: they guard a known shortfall against getting worse.
  const bool guarded = mode == VerifyMode::quick && spec.quick_target > 0;
  row.verdict = met ? Verdict::met : spec.shortfall.empty() || guarded ? Verdict::missed : Verdict::known;
  return row;
}

/// By the measure that it misses most.
VerifyRow control_row(const Scene& scene, const VariantRun& run, VerifyMode mode) {
  const auto row_for = [&](const VerifySpec& spec) {
    VerifyRow row = row_of(scene, spec, mode);
    add_run(spec, run, row);
    return row;
  };
  const auto excess = [](const VerifyRow& row) {
    const double error = row.errors.back();
    return std::isnan(error) ? std::numeric_limits<double>::infinity() : error / row.target;
  };
  VerifyRow worst = row_for(scene.verify.front());
  for (const VerifySpec& spec : scene.verify)
    if (const VerifyRow row = row_for(spec); excess(row) > excess(worst)) worst = row;
  worst.what = "control: " + run.name;
  worst.shortfall.clear();
  worst.least_order = 0;
  worst.order = not_a_number;
  worst.control = true;
  worst.verdict = excess(worst) > 1 ? Verdict::met : Verdict::missed;
  return worst;
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
    if (run.control) rows.push_back(control_row(scene, run, mode));
  return rows;
}

std::string word_of(Verdict verdict) {
  if (verdict == Verdict::met) return "yes";
  return verdict == Verdict::known ? "no, known" : "NO";
}

}  // namespace geodrop
