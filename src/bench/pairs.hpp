// Is one version slower than another? Judged by the ratios of pairs that were measured in turn.
#pragma once

#include <functional>
#include <vector>

namespace geodrop {

/// Median of ratios, and an interval that holds the true median with a probability of 95 % or more.
struct MedianInterval {
  double median = 0, lower = 0, upper = 0;
};

/// Number of values to leave out at each end of n sorted ones for the interval: the largest j with
/// 2 P(B <= j) <= 5 % for B binomial with n trials of probability 1/2. -1 if n < 6: no interval.
/// (Order statistics, e.g. Conover, Practical Nonparametric Statistics, 3.2: nothing is assumed of how ratios scatter.)
int left_out_at_each_end(int n);

/// Of at least six values; with fewer the interval is infinite.
MedianInterval median_interval(std::vector<double> values);

enum class PairVerdict { slower, not_slower, undecided };

/// How much slower a version may be before it counts [-], and how many pairs are taken at least and at most.
struct PairRules {
  double limit = 0.025;
  int least = 15, most = 51;
};

/// Slower if the interval lies wholly above the limit, not slower if wholly below.
PairVerdict judge_pairs(const MedianInterval& ratio, const PairRules& rules);

struct PairOutcome {
  MedianInterval ratio;  ///< new over old
  int pairs = 0;
  PairVerdict verdict = PairVerdict::undecided;
};

/// Takes pairs, of which `ratio(k)` measures number k, until the verdict is clear or their number is the largest.
PairOutcome compare_in_pairs(const PairRules& rules, const std::function<double(int)>& ratio);

}  // namespace geodrop
