#include "base/json.hpp"

#include <doctest/doctest.h>

#include <limits>

using namespace geodrop;

TEST_CASE("texts are escaped") {
  CHECK(json_text("a \"b\" \\ c") == R"("a \"b\" \\ c")");
  CHECK(json_text("two\nlines\tand \x01") == R"("two\nlines\tand \u0001")");
  CHECK(json_text("K\u0151rös") == "\"K\u0151rös\"");
}

TEST_CASE("bytes that are no UTF-8 are replaced one by one, letters are kept") {
  CHECK(json_text("a\xff"
                  "b") == R"("a\ufffdb")");
  CHECK(json_text("\xc3") == R"("\ufffd")");                      // cut off
  CHECK(json_text("\xc0\xaf") == R"("\ufffd\ufffd")");            // overlong
  CHECK(json_text("\xed\xa0\x80") == R"("\ufffd\ufffd\ufffd")");  // a surrogate
  CHECK(json_text("\xf0\x9f\x8c\x8a \xe2\x82\xac \xc3\xa9") == "\"\xf0\x9f\x8c\x8a \xe2\x82\xac \xc3\xa9\"");
}

TEST_CASE("numbers that JSON has no word for are null") {
  CHECK(json_number(std::numeric_limits<double>::quiet_NaN()) == "null");
  CHECK(json_number(-std::numeric_limits<double>::infinity()) == "null");
  CHECK(json_number(-0.125) == "-0.125");
  CHECK(json_number(1e300) == "1e+300");
}

TEST_CASE("objects and arrays") {
  CHECK(json_object({}) == "{}");
  CHECK(json_array({}) == "[]");
  CHECK(json_record({{"a", "1"}, {"b", "null"}}) == R"({"a": 1, "b": null})");
  CHECK(json_object({{"list", json_array({"1", "2"})}, {"x", "3"}}) ==
        "{\n  \"list\": [\n    1,\n    2\n  ],\n  \"x\": 3\n}");
}
