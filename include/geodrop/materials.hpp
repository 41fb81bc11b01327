// Constitutive laws. A law sees one point, or one packet of points with the lanes as points; never an array.
// `R` is double or a packet type (GCC vector extension); laws are written with `select`, without branches.
#pragma once

#include <geodrop/scene/materials.hpp>
#include <geodrop/types.hpp>

#include <array>
#include <limits>
#include <variant>

namespace geodrop {

/// p = K (1/J - 1), deviator 2 (mu + mu_t) dev(D). J = rho0 / rho. Eddies smaller than the mixing length l mix as
/// mu_t = rho0 l^2 sqrt(2 dev(D) : dev(D)) (Prandtl 1925; Smagorinsky 1963). Water that cavitates keeps p = -T however
/// far it opens: p is a function of J all the same, so that voids close again without a loss of volume.
struct Newtonian {
  double density;                                                   ///< rho0 [kg/m3]
  double bulk_modulus;                                              ///< K [Pa]
  double viscosity;                                                 ///< mu [Pa s]
  double mixing_length = 0;                                         ///< l [m]; 0: no eddies
  double tension_cutoff = std::numeric_limits<double>::infinity();  ///< T [Pa]

  bool viscous() const { return viscosity > 0 || mixing_length > 0; }
  /// At J = infinity p = -K.
  bool cavitates() const { return tension_cutoff < bulk_modulus; }
};

/// Isotropic hypoelasticity in Cauchy stress.
struct LinearElastic {
  double density;        ///< [kg/m3]
  double bulk_modulus;   ///< [Pa]
  double shear_modulus;  ///< [Pa]
};

/// Elastic, perfectly plastic Mohr-Coulomb with a non-associated flow rule and a tension cut-off.
struct MohrCoulomb {
  double density;        ///< of the mixture [kg/m3]
  double bulk_modulus;   ///< of the skeleton [Pa]
  double shear_modulus;  ///< [Pa]
  double cohesion;       ///< [Pa]
  double sin_phi, cos_phi;
  double sin_psi;
  double tension_cutoff;  ///< largest principal effective stress [Pa]; <= c cot(phi)
  double pore_stiffness;  ///< K_f / n [Pa]; 0: drained
};

/// The same without dilatancy, where what opens at the cut-off closes again without stress; see materials/void_memory.
struct MohrCoulombWithVoids : MohrCoulomb {};

/// Compressible neo-Hookean solid at finite strain; needs the deformation gradient.
struct NeoHookean {
  double density;        ///< unstrained [kg/m3]
  double lame_lambda;    ///< [Pa]
  double shear_modulus;  ///< mu [Pa]
};

using Material = std::variant<Newtonian, LinearElastic, MohrCoulomb, NeoHookean, MohrCoulombWithVoids>;

Material make_material(const MaterialSpec& spec);

/// The law of a soil, with or without voids; null if the material is no soil.
const MohrCoulomb* soil_law(const Material& material);

/// Density at zero pressure (fluid) or at the start (soil) [kg/m3].
double reference_density(const Material& material);

/// Speed of elastic compression waves at zero strain, pore fluid included [m/s].
double wave_speed(const Material& material);

/// What elastic compression waves meet at zero strain, rho c [Pa s/m].
double impedance(const Material& material);

/// Speed of elastic shear waves at zero strain [m/s]; 0 in a fluid.
double shear_wave_speed(const Material& material);

/// Pressure of a fluid [Pa] and its energy per volume at zero pressure [J/m3], whose slope -dW/dJ is the pressure.
double fluid_pressure(const Newtonian& fluid, double J);
double fluid_energy(const Newtonian& fluid, double J);

/// Kinematic viscosity that limits the explicit time step [m2/s]; 0 for solids.
double kinematic_viscosity(const Material& material);

/// Water and gas in the pores of a soil.
struct PoreFluid {
  double saturation;          ///< S, share of the pores that water fills [-]
  double water_bulk_modulus;  ///< K_w [Pa]
  double gas_pressure;        ///< p, absolute [Pa]
};

/// 1/K_f = S/K_w + (1 - S)/p [Pa] (Verruijt 1969, Elastic storage of aquifers): water and gas under one pressure, each
/// by its own compliance; that of an ideal gas at constant temperature is 1/p (Boyle). Of small changes about p: what
/// dissolves, the tension of menisci and the stiffening of the gas under load are left out.
double pore_fluid_bulk_modulus(const PoreFluid& fluid);

/// Grains and the water between them.
struct GrainsAndWater {
  double grain_density;  ///< rho_s [kg/m3]
  double porosity;       ///< n [-]
  double saturation;     ///< S [-]
  double fluid_density;  ///< rho_f [kg/m3]
};

/// (1 - n) rho_s + n S rho_f [kg/m3]; gas weighs nothing.
double mixture_density(const GrainsAndWater& soil);

/// Skempton's B of an undrained soil, (K_f/n) / (K_f/n + K'); 0 if drained.
double skempton_b(const MohrCoulomb& soil);

/// Pressure [Pa] of the still, weakly compressible fluid at `depth` [m] below its surface: K (exp(rho0 g d / K) - 1),
/// 0 above the surface. `gravity` [m/s2] is positive downwards.
double still_pressure(const Newtonian& fluid, double gravity, double depth);

}  // namespace geodrop
