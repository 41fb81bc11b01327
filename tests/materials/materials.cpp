// The constants of a material and what the time step asks of it.
#include "element.hpp"

#include <doctest/doctest.h>

#include "support/near.hpp"

namespace {

using namespace geodrop;
using namespace geodrop::test;

template <class Spec>
Material material(const Spec& spec) {
  MaterialSpec named;
  named.model = spec;
  return make_material(named);
}

}  // namespace

TEST_CASE("Moduli, wave speed and viscosity follow from the scene's constants") {
  const Material water = material(NewtonianSpec{1000, 2.13e9, 8.9e-4});
  CHECK(wave_speed(water) == near(1459.45195, 1e-8));  // sqrt(2.13e6)
  CHECK(kinematic_viscosity(water) == near(8.9e-7, 1e-12));
  CHECK(reference_density(water) == 1000);

  // E = 10 MPa, nu = 1/4: K = E / 1.5, G = E / 2.5, K + 4G/3 = 12 MPa.
  const Material solid = material(LinearElasticSpec{3000, 10e6, 0.25});
  CHECK(std::get<LinearElastic>(solid).bulk_modulus == near(10e6 / 1.5, 1e-12));
  CHECK(std::get<LinearElastic>(solid).shear_modulus == near(4e6, 1e-12));
  CHECK(wave_speed(solid) == near(std::sqrt(12e6 / 3000), 1e-12));
  CHECK(impedance(solid) == near(std::sqrt(12e6 * 3000), 1e-12));
  CHECK(kinematic_viscosity(solid) == 0);
}

TEST_CASE("Pore water stiffens an undrained soil") {
  MohrCoulombSpec spec;
  spec.density = 2000;
  spec.youngs_modulus = 10e6;
  spec.poissons_ratio = 0.25;
  spec.friction_angle_deg = 30;
  const Material drained = material(spec);
  CHECK(wave_speed(drained) == near(std::sqrt(12e6 / 2000), 1e-12));
  CHECK(skempton_b(std::get<MohrCoulomb>(drained)) == 0);
  spec.pores = UndrainedSpec{0.4, 80e6};
  const Material undrained = material(spec);
  CHECK(std::get<MohrCoulomb>(undrained).pore_stiffness == near(200e6, 1e-12));
  CHECK(wave_speed(undrained) == near(std::sqrt(212e6 / 2000), 1e-12));
  CHECK(skempton_b(std::get<MohrCoulomb>(undrained)) == near(200 / (200 + 10 / 1.5), 1e-12));
}

TEST_CASE("Water and gas in the pores: compliances add up by their shares") {
  CHECK(pore_fluid_bulk_modulus({1, 2e9, 1e5}) == near(2e9, 1e-12));
  CHECK(pore_fluid_bulk_modulus({0, 2e9, 1e5}) == near(1e5, 1e-12));
  // 0.5 / 3 + 0.5 / 1 = 2/3
  CHECK(pore_fluid_bulk_modulus({0.5, 3, 1}) == near(1.5, 1e-12));
  // One per cent of gas at 2 bar makes water softer than rubber: 1 / (0.99 / 2.13e9 + 0.01 / 2e5) = 19.8 MPa
  CHECK(pore_fluid_bulk_modulus({0.99, 2.13e9, 2e5}) == near(19.8158e6, 4e-7));
}

TEST_CASE("Density of a mixture of grains, water and gas") {
  CHECK(mixture_density({2650, 0.4, 1, 1000}) == near(1990, 1e-12));  // 1590 + 400
  CHECK(mixture_density({2650, 0.4, 0.9, 1000}) == near(1950, 1e-12));
  CHECK(mixture_density({2650, 0.4, 0, 1000}) == near(1590, 1e-12));
}

TEST_CASE("The tension cut-off is kept at or below the apex") {
  const double apex = 1000 * std::sqrt(3.0);  // c cot(30 degrees)
  CHECK(soil({1e6, 0.3, 1000, 30, 0, 1800}).tension_cutoff == near(apex, 1e-12));
  CHECK(soil({1e6, 0.3, 1000, 30, 0, 600}).tension_cutoff == 600);
  CHECK(soil({1e6, 0.3, 1000, 0, 0, 600}).tension_cutoff == 600);  // without friction there is no apex
  const MohrCoulomb law = soil({1e6, 0.3, 1000, 30, 10});
  CHECK(law.sin_phi == near(0.5, 1e-12));
  CHECK(law.cos_phi == near(std::sqrt(0.75), 1e-12));
  CHECK(law.sin_psi == near(0.17364818, 4e-8));
}

TEST_CASE("Water with gas: Boyle's law by hand, one pressure for each volume, energy, the stiffest wave") {
  Newtonian fluid{1000, 2e9, 0};
  fluid.gas = 0.5;
  fluid.atmosphere = 1e5;
  CHECK(fluid_pressure(fluid, 1.5, 0.5) == near_zero(1e-6));
  // One atmosphere more halves the gas, and presses the water by 1 / 20000.
  CHECK(fluid_pressure(fluid, 0.25 + 1 / (1 + 5e-5), 0.5) == near(1e5, 1e-9));
  CHECK(fluid_pressure(fluid, 0.9, 0) == near(2e9 * (1 / 0.9 - 1), 1e-12));
  for (const double gas : {1e-6, 0.05, 0.5, 3.0})
    for (const double p : {-9e4, -1e3, 0.0, 1e3, 2e5, 1e7}) {
      CAPTURE(gas);
      CAPTURE(p);
      const double J = fluid_volume_ratio(fluid, p, gas), step = 1e-6 * J;
      CHECK(fluid_pressure(fluid, J, gas) == within(p, 1e-7 * std::max(1e5, std::abs(p))));
      const double slope = (fluid_energy(fluid, J + step, gas) - fluid_energy(fluid, J - step, gas)) / (2 * step);
      CHECK(slope == within(-p, 1e-3 * (1e5 + std::abs(p))));
      const double stiffness =
          (fluid_pressure(fluid, J - step, gas) - fluid_pressure(fluid, J + step, gas)) / (2 * step) * J;
      CHECK(fluid_stiffness(fluid, p, gas) == near(stiffness, 1e-3));
      fluid.gas = gas;
      CHECK(stiffness * J < 1.0001 * wave_modulus(fluid));  // c^2 times the density of the water
    }
  CHECK(fluid_energy(fluid, 1.5, 0.5) == near_zero(1e-9));
  CHECK(fluid_pressure(fluid, 1e6, 0.5) > -1e5);
}

TEST_CASE("Still water with a still level has its density at every depth; the pressure is the slope of its energy") {
  Newtonian fluid{1000, 3.6e6, 0, 0, 1e4};
  fluid.unit_weight = 9810;
  fluid.still_level = 5;
  CHECK(fluid.of_weight(3) == near(2 * 9810, 1e-12));
  CHECK(still_pressure(fluid, 9.81, 2) == near(2 * 9810, 1e-12));
  CHECK(still_pressure(Newtonian{1000, 3.6e6, 0}, 9.81, 2) == near(3.6e6 * std::expm1(2 * 9810 / 3.6e6), 1e-12));
  for (const double depth : {-2.0, 0.0, 3.0, 12.0}) {  // above the level: less than nothing
    CAPTURE(depth);
    const double weight = 9810 * depth;
    CHECK(fluid_pressure(fluid, 1, 0, weight) == within(std::max(weight, -1e4), 1e-6));
    for (const double J : {0.99, 1.0, 1.002, 1.2}) {
      const double p = fluid_pressure(fluid, J, 0, weight), step = 1e-6;
      const double slope =
          (fluid_energy(fluid, J + step, 0, weight) - fluid_energy(fluid, J - step, 0, weight)) / (2 * step);
      CHECK(slope == within(-p, 5));
    }
  }
}

TEST_CASE("Water that is not torn follows K (1/J - 1); torn, it keeps its cut-off; energy is the integral of both") {
  const Newtonian whole{1000, 2e6, 0}, torn{1000, 2e6, 0, 0, 1e5};
  CHECK(fluid_pressure(whole, 0.5) == near(2e6, 1e-12));
  CHECK(fluid_pressure(whole, 4) == near(-1.5e6, 1e-12));
  CHECK(fluid_pressure(torn, 0.5) == near(2e6, 1e-12));
  CHECK(fluid_pressure(torn, 1.05) == near(2e6 * (1 / 1.05 - 1), 1e-12));
  CHECK(fluid_pressure(torn, 4) == -1e5);
  CHECK_FALSE(whole.cavitates());
  CHECK(torn.cavitates());
  CHECK(fluid_energy(torn, 1) == 0);
  const double step = 1e-5;
  for (const double J : {0.8, 0.99, 1.04, 1.06, 1.0527, 3.0}) {  // it tears at J = 1 / 0.95 = 1.0526
    CAPTURE(J);
    for (const Newtonian& fluid : {whole, torn}) {
      const double slope = (fluid_energy(fluid, J + step) - fluid_energy(fluid, J - step)) / (2 * step);
      CHECK(slope == near(-fluid_pressure(fluid, J), 1e-8));
    }
  }
}
