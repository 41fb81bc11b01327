// Numbers as they are handed in, and names of columns in words.
#include "base/figures.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "base/units.hpp"

using namespace geodrop;

TEST_CASE("Numbers as they are handed in") {
  CHECK(figure(1.811713473, "m") == "1.81 m");
  CHECK(figure(14115.21827, "N/m") == "14.1 kN/m");
  CHECK(figure(26487, "Pa") == "26.5 kPa");
  CHECK(figure(2.13e9, "Pa") == "2130 MPa");
  CHECK(figure(0.0385991, "s") == "0.0386 s");
  CHECK(figure(-5.62864e-08, "degree") == "0 degree");
  CHECK(figure(995.6, "kg/m3") == "996 kg/m3");
  CHECK(figure(0.96, "1") == "0.960");
  CHECK(figure(12345, "1") == "12345");
  CHECK(figure(std::nan(""), "m") == "-");
  CHECK(figure(120, "N") == "120 N");
  CHECK(figure(-1e-5, "m") == "-1e-05 m");
  CHECK(figure(-1e-5, "m", 10) == "0 m");  // a place in a domain of 10 m
  CHECK(figure(-1e-3, "m", 10) == "-0.00100 m");
}

TEST_CASE("Names in words: without their unit, but for that of r squared") {
  CHECK(in_words("fall_velocity_max_m_s") == "fall velocity max");
  CHECK(in_words("container.velocity_y_m_s") == "container velocity y");
  CHECK(in_words("mean_stress_r_squared") == "mean stress r squared");
}
