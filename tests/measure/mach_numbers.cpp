// Largest speed over the wave speed of each fluid.
#include "measure/mach_numbers.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/near.hpp"
#include "support/small_state.hpp"

using namespace geodrop;
using namespace geodrop::test;

TEST_CASE("The Mach number of a fluid is the largest rms velocity of any body over its wave speed; soil has none") {
  const HistoryTable history{{"time_s", "pool.velocity_rms_m_s", "bag.velocity_rms_m_s"},
                             {{0, 0.1, 0}, {1, 0.2, 0.05}, {2, 0.15, 0.3}, {3, 0.1, 0.02}}};
  const std::vector<Fact> facts = mach_numbers(small_scene(), history);
  REQUIRE(facts.size() == 1);
  CHECK(facts[0].name == "pool.mach_ratio");
  CHECK(facts[0].value == near(0.3 / std::sqrt(2e6 / 1000), 1e-14));
}
