#include "reference_lines.hpp"

#include <geodrop/base/find_named.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/figures.hpp"
#include "base/units.hpp"

namespace geodrop {
namespace {

constexpr double always = std::numeric_limits<double>::infinity();

void add_strength(const std::string& column, const std::string& of, double strength, TensionStrength factors,
                  std::vector<ReferenceLine>& lines) {
  if (strength <= 0) return;
  const auto add = [&](const std::string& what, double value) {
    lines.push_back({column, what + " of " + of + ", " + figure(value, unit_of_name(column)), value, 0, always});
  };
  add("strength", strength);
  factors.strength = strength;
  if (const double allowed = allowable_tension(factors); allowed < strength) add("allowable", allowed);
}

bool is_value_of_column(Reduction reduce) {
  switch (reduce) {
    case Reduction::last:
    case Reduction::min:
    case Reduction::max:
    case Reduction::mean:
    case Reduction::percentile:
      return true;
    default:
      return false;
  }
}

}  // namespace

std::vector<ReferenceLine> reference_lines(const Scene& scene, const TensionStrength& factors,
                                           const std::function<double(const std::string&)>& time_of) {
  std::vector<ReferenceLine> lines;
  for (const MembraneSpec& membrane : scene.membranes) {
    add_strength(membrane.name + ".tension_gauge_N_m", membrane.name, membrane.strength, factors, lines);
    add_strength(membrane.name + ".cross_tension_mean_N_m", membrane.name + " across", membrane.weft_strength, factors,
                 lines);
  }
  for (const ExpectSpec& expect : scene.expect) {
    const ResultSpec* const result = find_or_null(scene.results, expect.result);
    if (!result || !is_value_of_column(result->reduce) || result->scale == 0) continue;
    const auto time = [&](const std::string& event, double without) {
      const double found = event.empty() ? without : time_of(event);
      return std::isnan(found) ? always : found;
    };
    const double from = std::max(result->from, time(result->after, 0));
    if (!std::isfinite(from)) continue;
    lines.push_back({result->column,
                     in_words(result->name) + " expected, " + figure(expect.expected, unit_of_name(result->name)),
                     expect.expected / result->scale, from, std::min(result->to, time(result->before, always))});
  }
  return lines;
}

}  // namespace geodrop
