#include "pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geodrop {

int left_out_at_each_end(int n) {
  constexpr double allowed = 0.05;
  double term = std::pow(0.5, n), sum = 0;  // P(B = 0)
  for (int j = 0; j <= n; ++j) {
    sum += term;
    if (2 * sum > allowed) return j - 1;
    term *= static_cast<double>(n - j) / (j + 1);
  }
  return -1;
}

MedianInterval median_interval(std::vector<double> values) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const int n = static_cast<int>(values.size());
  if (n == 0) return {1, -infinity, infinity};
  std::sort(values.begin(), values.end());
  const double median = 0.5 * (values[(n - 1) / 2] + values[n / 2]);
  const int out = left_out_at_each_end(n);
  if (out < 0) return {median, -infinity, infinity};
  return {median, values[out], values[n - 1 - out]};
}

PairVerdict judge_pairs(const MedianInterval& ratio, const PairRules& rules) {
  if (ratio.lower > 1 + rules.limit) return PairVerdict::slower;
  return ratio.upper < 1 + rules.limit ? PairVerdict::not_slower : PairVerdict::undecided;
}

PairOutcome compare_in_pairs(const PairRules& rules, const std::function<double(int)>& ratio) {
  std::vector<double> ratios;
  PairOutcome outcome;
  while (outcome.pairs < rules.most && (outcome.pairs < rules.least || outcome.verdict == PairVerdict::undecided)) {
    ratios.push_back(ratio(outcome.pairs++));
    outcome.ratio = median_interval(ratios);
    outcome.verdict = judge_pairs(outcome.ratio, rules);
  }
  return outcome;
}

}  // namespace geodrop
