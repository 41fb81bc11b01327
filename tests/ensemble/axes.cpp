// Values of a sweep: evenly, by equal factors, listed; all combinations.
#include "ensemble/axes.hpp"

#include <doctest/doctest.h>
#include <geodrop/base/error.hpp>

using namespace geodrop;

using Texts = std::vector<std::string>;

TEST_CASE("Values from A to B, whole where all are") {
  CHECK(parse_axis("a.b=1:2:3") == Axis{"a.b", {"1.0", "1.5", "2.0"}});
  CHECK(parse_axis("seed=1:5:3") == Axis{"seed", {"1", "3", "5"}});
  CHECK(parse_axis("x=0.1:0.5:5").values == Texts{"0.1", "0.2", "0.3", "0.4", "0.5"});
  CHECK(parse_axis("x=5.0:1.0:3").values == Texts{"5.0", "3.0", "1.0"});
  CHECK(parse_axis("x=2.5:9.0:1").values == Texts{"2.5"});
  CHECK(parse_axis("k=1e-6:1e-2:3:log").values == Texts{"1e-06", "1e-04", "0.01"});
  CHECK(parse_axis("solver.transfer=tpic,blend") == Axis{"solver.transfer", {"tpic", "blend"}});
  CHECK(parse_axis("x=3").values == Texts{"3"});
}

TEST_CASE("What is no list of values is refused") {
  for (const char* wrong : {"", "x", "=1:2:3", "x=", "x=1:2", "x=1:2:0", "x=1:2:2.5", "x=1:b:3", "x=1:2:3:lin",
                            "x=0:1:3:log", "x=1,,2", "x=1:2:3:log:4"})
    CHECK_THROWS_AS(parse_axis(wrong), SceneError);
}

TEST_CASE("Combinations: each value with each, the last key fastest") {
  const auto all = combinations({{"a", {"1", "2"}}, {"b", {"x", "y", "z"}}});
  REQUIRE(all.size() == 6);
  CHECK(all[0] == Texts{"1", "x"});
  CHECK(all[1] == Texts{"1", "y"});
  CHECK(all[3] == Texts{"2", "x"});
  CHECK(all[5] == Texts{"2", "z"});
}
