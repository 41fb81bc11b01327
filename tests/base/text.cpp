// Numbers as tables show them.
#include "base/text.hpp"

#include <doctest/doctest.h>

#include <limits>

TEST_CASE("Short numbers: four digits, all before the point, a dash for what is none") {
  using geodrop::short_number;
  CHECK(short_number(1.811713473) == "1.812");
  CHECK(short_number(-0.00021153) == "-0.0002115");
  CHECK(short_number(14115.218) == "14115");
  CHECK(short_number(-107509.4) == "-107509");
  CHECK(short_number(3.25e12) == "3.25e+12");
  CHECK(short_number(0) == "0");
  CHECK(short_number(std::numeric_limits<double>::quiet_NaN()) == "-");
}
