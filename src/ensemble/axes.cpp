#include "axes.hpp"

#include <geodrop/base/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/text.hpp"
#include "keys/key.hpp"
#include "samples.hpp"

namespace geodrop {
namespace {

/// Without the round-off of the steps: 0.1 + 0.2 is 0.3.
double rounded(double value) {
  constexpr int digits = 12;
  return std::strtod(format_number(value, digits).c_str(), nullptr);
}

/// Of A:B:N or A:B:N:log; empty if it is neither.
std::vector<std::string> values_between(const std::vector<std::string>& parts) {
  const bool by_factors = parts.size() == 4 && parts[3] == "log";
  if (parts.size() != 3 && !by_factors) return {};
  const auto from = number_in(parts[0]), to = number_in(parts[1]), count = number_in(parts[2]);
  constexpr double most = 1e5;
  if (!from || !to || !count || *count != std::floor(*count) || *count < 1 || *count > most) return {};
  if (by_factors && (*from <= 0 || *to <= 0)) return {};
  const double steps = std::max(1.0, *count - 1);
  const bool whole = is_whole(parts[0]) && is_whole(parts[1]) && !by_factors && std::fmod(*to - *from, steps) == 0;
  std::vector<std::string> values;
  for (int i = 0; i < static_cast<int>(*count); ++i) {
    const double share = i / steps;
    double value = by_factors ? *from * std::pow(*to / *from, share) : *from + share * (*to - *from);
    if (i > 0 && i == static_cast<int>(steps)) value = *to;
    values.push_back(value_text({"", 0, 0, whole}, rounded(value)));
  }
  return values;
}

}  // namespace

Axis parse_axis(const std::string& text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  Axis axis{text.substr(0, equals), {}};
  const std::string range = equals < text.size() ? text.substr(equals + 1) : "";
  axis.values = range.find(':') == std::string::npos ? split(range, ',') : values_between(split(range, ':'));
  const bool has_empty = std::ranges::any_of(axis.values, [](const std::string& value) { return value.empty(); });
  if (!axis.key.empty() && !axis.values.empty() && !has_empty) return axis;
  throw SceneError("--vary", {{{},
                               "",
                               '"' + text + '"',
                               "KEY=FROM:TO:COUNT (also with :log), or KEY=A,B,C, e.g. grid.spacing=0.5,0.25",
                               ProblemSource::elsewhere}});
}

std::vector<std::vector<std::string>> combinations(const std::vector<Axis>& axes) {
  std::vector<std::vector<std::string>> all{{}};
  for (const Axis& axis : axes) {
    std::vector<std::vector<std::string>> longer;
    for (const auto& before : all)
      for (const std::string& value : axis.values) {
        longer.push_back(before);
        longer.back().push_back(value);
      }
    all = std::move(longer);
  }
  return all;
}

}  // namespace geodrop
