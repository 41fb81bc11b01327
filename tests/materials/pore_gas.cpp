// Gas in the pores: Boyle's law by hand, the stiffness as a derivative, the energy as an integral, and the limits.
#include "element.hpp"

#include <doctest/doctest.h>

#include "support/near.hpp"

namespace {

using namespace geodrop;
using namespace geodrop::test;

constexpr double n = 0.4, S = 0.83, atmosphere = 1e5, water = 2.13e9;

MohrCoulombWithGas soil_of(double saturation = S, double water_modulus = water) {
  MohrCoulombSpec spec;
  spec.density = 1900;
  spec.youngs_modulus = 1e6;
  spec.poissons_ratio = 0.3;
  UndrainedSpec pores{n, pore_fluid_bulk_modulus({saturation, water_modulus, atmosphere}), saturation};
  pores.gas = PoreGasSpec{water_modulus, atmosphere, atmosphere};
  spec.pores = pores;
  MaterialSpec material;
  material.model = spec;
  return std::get<MohrCoulombWithGas>(make_material(material));
}

}  // namespace

TEST_CASE("Squeezed until half of its gas is gone, the soil has one atmosphere more") {
  const MohrCoulombWithGas soil = soil_of(S, 1e30);  // rigid water
  double u = 0, J = 1;
  const int steps = 1000;
  for (int k = 0; k < steps; ++k) {
    const double change = -n * (1 - S) / 2 / steps;  // of J
    u = gas_pore_pressure(soil, u, change);
    J += change;
  }
  CHECK(u == near(atmosphere, 1e-9));
  CHECK(J == near(1 - n * (1 - S) / 2, 1e-12));
  // And back, beyond the start: suction stays above absolute zero.
  CHECK(gas_pore_pressure(soil, u, n * (1 - S) / 2) == near_zero(1e-9 * atmosphere));
  CHECK(gas_pore_pressure(soil, u, 100.0) > -atmosphere);
}

TEST_CASE("In one step or in many the pressure is a function of the volume, and that of the water counts") {
  const MohrCoulombWithGas soil = soil_of();
  double u = 0;
  for (int k = 0; k < 100; ++k) u = gas_pore_pressure(soil, u, -1e-3);
  CHECK(u == near(gas_pore_pressure(soil, 0.0, -0.1), 1e-9));
  // More than all of the gas, n (1 - S) = 0.068: the rest is water, 0.032 of n S / K.
  CHECK(u == near(0.032 * water / (n * S), 0.01));
}

TEST_CASE("Stiffness and energy belong to the pressure; about the start they are those of K_f") {
  const MohrCoulombWithGas soil = soil_of();
  const double K = pore_fluid_bulk_modulus({S, water, atmosphere});
  CHECK(gas_pore_stiffness(soil, 0, 1) == near(K / n, 1e-12));
  CHECK(soil.pore_stiffness == near(K / n, 1e-12));
  for (const double u : {-5e4, 2e4, 3e5}) {
    CAPTURE(u);
    const double small = 1e-7;
    const double slope = (gas_pore_pressure(soil, u, -small) - gas_pore_pressure(soil, u, small)) / (2 * small);
    CHECK(slope == near(gas_pore_stiffness(soil, u, 1), 1e-6));
    // dW = -u dJ
    const double above = gas_pore_pressure(soil, u, -small), below = gas_pore_pressure(soil, u, small);
    CHECK((gas_pore_energy(soil, above) - gas_pore_energy(soil, below)) / (2 * small) == near(u, 1e-6));
  }
  CHECK(gas_pore_energy(soil, 0) == 0);
  CHECK(gas_pore_energy(soil, 1e3) == near(1e6 / (2 * K / n), 0.02));
}
