// The helpers of support/near.hpp themselves: a comparison that cannot fail would take every test with it.
#include "support/near.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

using namespace geodrop::test;

namespace {

const double undefined = std::nan(""), infinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("near is relative for small, large and negative values, on both sides and from both sides") {
  for (const double x : {1.0, -1.0, 0.66e-3, -8.9e-7, 1e-300, 2.13e9}) {
    CAPTURE(x);
    CHECK(x == near(x, 1e-15));
    for (const double sign : {-1.0, 1.0}) {
      CHECK(x * (1 + sign * 0.0099) == near(x, 0.01));
      CHECK(near(x, 0.01) == x * (1 + sign * 0.0099));
      CHECK(x * (1 + sign * 0.0101) != near(x, 0.01));
      CHECK(near(x, 0.01) != x * (1 + sign * 0.0101));
    }
    CHECK(0.0 != near(x, 0.99));
    CHECK(-x != near(x, 0.99));
  }
}

TEST_CASE("near throws where it says nothing: expected 0 or NaN, no tolerance, one that lets 0 pass") {
  CHECK_THROWS_AS(near(0, 1e-9), std::invalid_argument);
  CHECK_THROWS_AS(near(-0.0, 1e-9), std::invalid_argument);
  CHECK_THROWS_AS(near(undefined, 1e-9), std::invalid_argument);
  CHECK_THROWS_AS(near(1, 0), std::invalid_argument);
  CHECK_THROWS_AS(near(1, -1e-9), std::invalid_argument);
  CHECK_THROWS_AS(near(1, undefined), std::invalid_argument);
  CHECK_THROWS_AS(near(1, 1), std::invalid_argument);
  CHECK_THROWS_AS(near(1e-9, 1000), std::invalid_argument);  // the arguments the wrong way round
}

TEST_CASE("within and near_zero are absolute, whatever the size of the value") {
  CHECK(1000.4 == within(1000, 0.5));
  CHECK(999.6 == within(1000, 0.5));
  CHECK(1000.6 != within(1000, 0.5));
  CHECK(999.4 != within(1000, 0.5));
  CHECK(1e-6 == within(0, 1e-6));
  CHECK(2.0 == within(2, 0));
  CHECK(-1e-12 == near_zero(1e-12));
  CHECK(1.1e-12 != near_zero(1e-12));
  CHECK(-1.1e-12 != near_zero(1e-12));
}

TEST_CASE("Neither NaN nor an infinite value passes") {
  for (const double value : {undefined, infinity, -infinity}) {
    CHECK(value != near(1, 0.5));
    CHECK(value != within(1, 1e300));
    CHECK(value != near_zero(1e300));
  }
  CHECK(undefined != within(undefined, 1));
  CHECK(1.0 != within(1, undefined));
}

TEST_CASE("A failure shows the expected value in full, and its tolerance") {
  CHECK(toString(near(0.25, 0.01)) == "0.25 +- 0.0025");
  CHECK(toString(near_zero(1e-9)) == "0 +- 1e-09");
}
