// Samples of uncertain inputs: one value in each part of a range, bands and rank correlations by hand.
#include <doctest/doctest.h>

#include <geodrop/base/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "ensemble/samples.hpp"
#include "support/near.hpp"

using namespace geodrop;
using namespace geodrop::test;

TEST_CASE("A range is KEY=LOW:HIGH") {
  CHECK(parse_variation("a.b=1.5:2") == Variation{"a.b", 1.5, 2, false});
  CHECK(parse_variation("bodies.water.jitter_seed=1:20") == Variation{"bodies.water.jitter_seed", 1, 20, true});
  CHECK(parse_variation("x=-3e-4:1e5") == Variation{"x", -3e-4, 1e5, false});
  CHECK(parse_variation("a+b=1:100:log") == Variation{"a+b", 1, 100, false, true});
  for (const char* wrong : {"", "x", "x=", "x=1", "x=1:", "x=:2", "=1:2", "x=2:1", "x=1:2:3", "x=0:2:log", "x=1:2:lin",
                            "x=1:2:log:", "x=nan:2", "x=1:inf", "x=a:b"})
    CHECK_THROWS_AS(parse_variation(wrong), SceneError);
}

TEST_CASE("A range by factors: as many samples in each decade") {
  const auto values = latin_hypercube({{"k", 1e-5, 1e-2, false, true}}, 30, 1);
  for (const double decade : {1e-5, 1e-4, 1e-3})
    CHECK(std::ranges::count_if(
              values, [&](const auto& sample) { return sample[0] >= decade && sample[0] < 10 * decade; }) == 10);
  CHECK(variation_text({"k", 1e-5, 1e-2, false, true}) == "k=1e-05:0.01:log");
}

TEST_CASE("Latin hypercube: one value of each key in each part of its range, another order for each seed and key") {
  const std::vector<Variation> ranges{{"a", -1, 3, false}, {"b", 10, 20, false}, {"c", 1, 40, true}};
  const auto values = latin_hypercube(ranges, 40, 7);
  REQUIRE(values.size() == 40);
  for (std::size_t v = 0; v < 2; ++v) {
    std::set<int> parts;
    for (const auto& sample : values) {
      const double share = (sample[v] - ranges[v].low) / (ranges[v].high - ranges[v].low);
      CHECK(share >= 0);
      CHECK(share < 1);
      parts.insert(static_cast<int>(std::floor(share * 40)));
    }
    CHECK(parts.size() == 40);
  }
  std::set<double> whole;
  for (const auto& sample : values) whole.insert(sample[2]);
  CHECK(whole.size() == 40);  // 1 to 40, each once
  CHECK(*whole.begin() == 1);
  CHECK(*whole.rbegin() == 40);
  CHECK(latin_hypercube(ranges, 40, 7) == values);
  CHECK(latin_hypercube(ranges, 40, 8) != values);
  CHECK(latin_hypercube({ranges[0]}, 40, 7)[11][0] == values[11][0]);  // a further key changes nothing for this one
  bool same_order = true;
  for (const auto& sample : values)
    same_order = same_order && std::floor((sample[0] + 1) * 10) == std::floor((sample[1] - 10) * 4);
  CHECK_FALSE(same_order);
}

TEST_CASE("Values as settings: whole ones without a point, others always with one") {
  CHECK(value_text({"n", 1, 9, true}, 4) == "4");
  CHECK(value_text({"x", 1, 9, false}, 4) == "4.0");
  CHECK(value_text({"x", 0, 1, false}, 0.1) == "0.1");
}

TEST_CASE("Bands lie between the sorted values; what is no number is left out") {
  std::vector<double> values;
  for (int i = 20; i >= 0; --i) values.push_back(i);
  values.push_back(std::numeric_limits<double>::quiet_NaN());
  const Band band = band_of(values);
  CHECK(band.low == near(1, 1e-14));
  CHECK(band.median == near(10, 1e-14));
  CHECK(band.high == near(19, 1e-14));
  CHECK(band_of({3, 4}).median == near(3.5, 1e-14));
  CHECK(std::isnan(band_of({}).median));
}

TEST_CASE("Rank correlation: 1 for what rises together, however; by hand with ties") {
  CHECK(rank_correlation({1, 2, 3, 4}, {1, 10, 100, 1e9}) == near(1, 1e-14));
  CHECK(rank_correlation({1, 2, 3, 4}, {5, 4, 2, -7}) == near(-1, 1e-14));
  CHECK(rank_correlation({1, 2, 3}, {2, 2, 2}) == 0);
  // Ranks 0 1 2 3 and 0.5 0.5 2 3: 4.5 / sqrt(5 * 4.5).
  CHECK(rank_correlation({1, 2, 3, 4}, {7, 7, 8, 9}) == near(std::sqrt(0.9), 1e-14));
  const double none = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(rank_correlation({1, 2, 3}, {4, none, 5})));
  CHECK(rank_correlation({1, none, 2, 3}, {4, 0, 5, 6}) == near(1, 1e-14));
}
