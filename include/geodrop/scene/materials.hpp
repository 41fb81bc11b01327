// Materials of a scene.
#pragma once

#include <geodrop/error.hpp>

#include <limits>
#include <optional>
#include <string>
#include <variant>

namespace geodrop {

/// Newtonian, weakly compressible: p = K (rho / rho0 - 1), at least -tension_cutoff; deviator 2 mu dev(D).
struct NewtonianSpec {
  double density = 0;        ///< at zero pressure [kg/m3]
  double bulk_modulus = 0;   ///< [Pa]; the scene may give sound_speed instead, K = rho c^2
  double viscosity = 0;      ///< dynamic [Pa s]
  double mixing_length = 0;  ///< of eddies that are not resolved [m]; 0: none
  double tension_cutoff = std::numeric_limits<double>::infinity();  ///< largest suction [Pa]; infinite: any
  bool operator==(const NewtonianSpec&) const = default;
};
/// Hypoelastic with logarithmic strain and a rotated (Hughes-Winget) Cauchy stress.
struct LinearElasticSpec {
  double density = 0;         ///< [kg/m3]
  double youngs_modulus = 0;  ///< [Pa]
  double poissons_ratio = 0;  ///< [-]
  bool operator==(const LinearElasticSpec&) const = default;
};
/// Compressible neo-Hookean solid: sigma = (mu / J) (F F^T - I) + (lambda ln J / J) I.
struct NeoHookeanSpec {
  double density = 0;         ///< unstrained [kg/m3]
  double youngs_modulus = 0;  ///< at small strain [Pa]
  double poissons_ratio = 0;  ///< [-]
  bool operator==(const NeoHookeanSpec&) const = default;
};
/// Fluid in the pores of an undrained soil: pore pressure rate = -(K_f / n) div v.
struct UndrainedSpec {
  double porosity = 0;            ///< [-]
  double fluid_bulk_modulus = 0;  ///< [Pa]
  /// Share of the pores that water fills, where K_f follows from it [-]; empty: K_f is the user's own.
  std::optional<double> saturation = {};
  bool operator==(const UndrainedSpec&) const = default;
};
/// Elastic, perfectly plastic Mohr-Coulomb in effective stress.
struct MohrCoulombSpec {
  double density = 0;                      ///< of the mixture [kg/m3]; the scene may give that of the grains instead
  double youngs_modulus = 0;               ///< [Pa]
  double poissons_ratio = 0;               ///< [-]
  double cohesion = 0;                     ///< [Pa]
  double friction_angle_deg = 0;           ///< [degree]
  double dilatancy_angle_deg = 0;          ///< [degree]
  double tension_cutoff = 0;               ///< largest principal effective stress [Pa], at most c cot(phi)
  std::optional<UndrainedSpec> undrained;  ///< empty: drained
  bool void_memory = false;                ///< what opens at the cut-off closes again without stress
  bool operator==(const MohrCoulombSpec&) const = default;
};
struct MaterialSpec {
  std::string name;
  std::variant<NewtonianSpec, LinearElasticSpec, MohrCoulombSpec, NeoHookeanSpec> model;
  SourceRef at;
  bool operator==(const MaterialSpec&) const = default;
};

}  // namespace geodrop
