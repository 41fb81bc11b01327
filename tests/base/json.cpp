#include "base/json.hpp"

#include <doctest/doctest.h>

#include <limits>

using namespace geodrop;

TEST_CASE("what a run writes is JSON, whatever bytes its names have") {
  const std::string broken = "K\u0151r\xff";
  const Json read = Json::parse(json_text({{"name", broken}, {"lines", "two\n\"lines\""}}));
  CHECK(read.at("name") == "K\u0151r\ufffd");
  CHECK(read.at("lines") == "two\n\"lines\"");
}

TEST_CASE("numbers come back with all their digits, as null where they are not finite") {
  const double third = 1.0 / 3, nan = std::numeric_limits<double>::quiet_NaN();
  const Json read = Json::parse(json_text({{"third", third}, {"tiny", 1e-300}, {"nan", nan}, {"inf", -1 / 0.0}}));
  CHECK(read.at("third").get<double>() == third);
  CHECK(read.at("tiny").get<double>() == 1e-300);
  CHECK(read.at("nan").is_null());
  CHECK(read.at("inf").is_null());
}

TEST_CASE("members keep their order, two spaces a level") {
  CHECK(json_text({{"x", 3}, {"list", {1, 2}}, {"a", Json::object()}}) ==
        "{\n  \"x\": 3,\n  \"list\": [\n    1,\n    2\n  ],\n  \"a\": {}\n}\n");
}
