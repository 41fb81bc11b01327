// The judging of pairs, on made-up ratios: nothing here is timed.
#include "bench/pairs.hpp"

#include <cmath>

#include "support/near.hpp"

using namespace geodrop;
using namespace geodrop::test;

TEST_CASE("How many values lie outside of the 95 % interval of a median: the table of the binomial distribution") {
  CHECK(left_out_at_each_end(5) == -1);   // even all five values miss the median with 2 / 32 = 6.25 %
  CHECK(left_out_at_each_end(6) == 0);    // 2 / 64 = 3.1 %
  CHECK(left_out_at_each_end(8) == 0);    // 2 (1 + 8) / 256 = 7.0 % with one left out
  CHECK(left_out_at_each_end(9) == 1);    // 2 (1 + 9) / 512 = 3.9 %
  CHECK(left_out_at_each_end(15) == 3);   // 2 (1 + 15 + 105 + 455) / 32768 = 3.5 %; with four 11.8 %
  CHECK(left_out_at_each_end(51) == 18);  // 4.9 %; with nineteen 9.2 %
}

TEST_CASE("Median and interval of nine ratios, by hand") {
  const MedianInterval interval = median_interval({1.09, 1.01, 1.05, 1.03, 1.02, 1.04, 1.07, 1.06, 1.08});
  CHECK(interval.median == 1.05);
  CHECK(interval.lower == 1.02);
  CHECK(interval.upper == 1.08);
}

TEST_CASE("An even number of values has its median between the middle ones; few have no interval") {
  const MedianInterval interval = median_interval({4, 1, 3, 2});
  CHECK(interval.median == 2.5);
  CHECK(std::isinf(interval.lower));
  CHECK(std::isinf(interval.upper));
}

TEST_CASE("The interval moves by one order statistic, not by an outlier") {
  std::vector<double> ratios(15, 1.0);
  ratios[3] = 20;  // one pair in fifteen disturbed grossly
  ratios[9] = 0.1;
  CHECK(median_interval(ratios).median == 1);
  CHECK(median_interval(ratios).lower == 1);
  CHECK(median_interval(ratios).upper == 1);
}

TEST_CASE("Slower or not is said only of an interval on one side of the limit") {
  PairRules rules;
  rules.limit = 0.03;
  CHECK(judge_pairs({1.05, 1.031, 1.07}, rules) == PairVerdict::slower);
  CHECK(judge_pairs({1.05, 1.029, 1.07}, rules) == PairVerdict::undecided);
  CHECK(judge_pairs({1.00, 0.98, 1.029}, rules) == PairVerdict::not_slower);
  CHECK(judge_pairs({0.80, 0.70, 0.90}, rules) == PairVerdict::not_slower);
}

TEST_CASE("Pairs are taken until the verdict is clear, within the least and the most") {
  const auto pairs = [](const std::function<double(int)>& ratio) { return compare_in_pairs({0.025, 15, 51}, ratio); };
  const PairOutcome same = pairs([](int pair) { return pair % 2 ? 1.01 : 0.99; });
  CHECK(same.pairs == 15);
  CHECK(same.verdict == PairVerdict::not_slower);
  const PairOutcome slow = pairs([](int pair) { return pair % 2 ? 1.06 : 1.04; });
  CHECK(slow.pairs == 15);
  CHECK(slow.verdict == PairVerdict::slower);
  const PairOutcome never_clear = pairs([](int pair) { return pair % 2 ? 1.20 : 0.85; });
  CHECK(never_clear.pairs == 51);
  CHECK(never_clear.verdict == PairVerdict::undecided);
  const PairOutcome late =
      pairs([](int pair) { return pair == 0 || pair == 2 || pair == 4 || pair == 6 ? 0.9 : 1.05; });
  CHECK(late.pairs == 17);  // four low ones are all left out from 17 pairs on: 2 P(B <= 4) = 4.9 %
  CHECK(late.verdict == PairVerdict::slower);
}
