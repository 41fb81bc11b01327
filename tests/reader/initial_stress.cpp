// Limits of K0, worked by hand for the bed of every_key.toml: 2 m of soil of 2000 kg/m3 under 5 m of water, phi = 30
// degrees. At its foot the vertical effective stress by weight is 1000 * 9.81 * 2 = 19620 Pa.
#include "support/scene_files.hpp"

#include <doctest/doctest.h>

using namespace geodrop;

namespace {

std::string with_k0(const std::string& k0, std::vector<std::string> overrides) {
  overrides.push_back("bodies.bed.initial_stress.k0=" + k0);
  return scene_error(source_path("tests/reader/every_key.toml"), overrides);
}

bool is_outside(const std::string& error) {
  return error.find("bodies.bed.initial_stress.k0: found ") != std::string::npos &&
         error.find("yield surface of \"clay\"") != std::string::npos;
}

}  // namespace

TEST_CASE("without cohesion K0 lies between the active and the passive coefficient, 1/3 and 3") {
  CHECK(is_outside(with_k0("0.333", {})));
  CHECK(with_k0("0.3334", {}).empty());
  CHECK(with_k0("2.999", {}).empty());
  CHECK(is_outside(with_k0("3.001", {})));
}

TEST_CASE("cohesion widens the range: 2 c cos(phi) = 17320.5 Pa, K0 up to (1.5 + 0.8828) / 0.5 = 4.7656") {
  const std::vector<std::string> cohesive{"materials.clay.cohesion=10e3"};
  CHECK(with_k0("4.765", cohesive).empty());
  CHECK(is_outside(with_k0("4.766", cohesive)));
  CHECK(with_k0("0", cohesive).empty());
}

TEST_CASE("a drained soil carries the water's pressure: 68670 Pa at the foot, K0 up to (1.5 + 3.5) / 0.5 = 10") {
  const std::vector<std::string> drained{
      "materials.clay.drainage=drained",
      "materials.clay.porosity=", "materials.clay.fluid_bulk_modulus=", "bodies.bed.implicit_pore_pressure=false"};
  CHECK(with_k0("9.99", drained).empty());
  CHECK(is_outside(with_k0("10.01", drained)));
}

TEST_CASE("soil lighter than the fluid over it has no stress at rest") {
  const std::string error = with_k0("0.5", {"materials.clay.density=900"});
  CHECK(error.find("initial_stress.type: found \"k0\" for a soil that is lighter than the fluid over it") !=
        std::string::npos);
}

TEST_CASE("the bulk modulus of the pore fluid is at least 20 K' n: B = 20/21") {
  // K' = 10e6 / (3 (1 - 0.666)) = 9.98004 MPa, n = 0.4
  const auto with_fluid = [](const char* modulus) {
    return scene_error(source_path("tests/reader/every_key.toml"),
                       {std::string("materials.clay.fluid_bulk_modulus=") + modulus});
  };
  CHECK(with_fluid("79.841e6").empty());
  const std::string error = with_fluid("79.840e6");
  CAPTURE(error);
  CHECK(error.find("(Skempton's B = 0.95238") != std::string::npos);
  CHECK(error.find("at least 79840319.36") != std::string::npos);
}
