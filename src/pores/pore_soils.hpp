// What a scene says of its coupled soils: constants of the pores, how far they consolidate, waves through their water.
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

namespace geodrop {

/// A coupled soil and its water.
struct PoreSoil {
  int body = 0;              ///< in the order of the scene
  int field = 0, water = 0;  ///< velocity fields
  double grain_density = 0;  ///< [kg/m3]
  double porosity = 0;       ///< n0 [-]
  double conductivity = 0;   ///< k0 [m/s]
  CoupledSpec::Permeability law{};
  double water_unit_weight = 0;  ///< gamma_w of Darcy's law [N/m3]
  double forchheimer = 0;        ///< b0 [s2/m2]; 0: Darcy's law alone
  double kozeny_at_start = kozeny(porosity), ergun_at_start = ergun(porosity);

  /// How the conductivity goes with the porosity (Kozeny-Carman), and how Forchheimer's drag does (Ergun) [-].
  static double kozeny(double n) { return std::pow(n, 3) / std::pow(1 - n, 2); }
  static double ergun(double n) { return (1 - n) / std::pow(n, 3); }

  /// n of a particle that has the volume ratio J.
  double porosity_at(double J) const { return 1 - (1 - porosity) / J; }
  /// gamma_w / k: times n^2 the drag per volume and relative velocity [N s/m4].
  double resistance(double n) const;
  /// gamma_w b: times n^3 the drag per volume and square of the relative velocity [N s2/m5].
  double inertial_resistance(double n) const;
};

/// All of them.
std::vector<PoreSoil> pore_soils(const Scene& scene);

/// How far a coupled soil consolidates in a run (Terzaghi 1925).
struct Consolidation {
  double coefficient = 0;  ///< c_v = k M / gamma_w, M the confined modulus of the skeleton [m2/s]
  double path = 0;  ///< of drainage [m]: least extent of the body, half of it if no wall is there; infinite: none
  double time_factor = 0;  ///< T_v = c_v time.end / path^2 [-]
};
Consolidation consolidation(const Scene& scene, const PoreSoil& soil);

/// Waves through the water in the pores of a coupled soil.
struct PoreWaves {
  std::size_t water = 0;  ///< its body
  /// What the water adds to the square of the soil's wave speed, with no drag between water and grains, the fastest
  /// case, at the start: (K_w / n) ((1 - n) / rho_s + n / rho_w) [m2/s2].
  double speed_squared = 0;
};
/// Of each coupled soil, by the number of its body.
std::map<std::size_t, PoreWaves> pore_waves(const Scene& scene);

/// What the pore water of body number `soil` adds to its c_eff^2 in the next step [m2/s2]; 0 of implicit pore pressure.
template <int Dim>
double explicit_waves(const std::map<std::size_t, PoreWaves>& waves, std::size_t soil, const State<Dim>& state) {
  /// Share of rho c^2 that counts where cells bear the pressure of water in pores: omega^2 <= 1.1 c^2 / h^2 with full
  /// cells in place of the 6 d c^2 / h^2 of particles; 1 / 6 keeps full cells from being softened.
  constexpr double cells_to_particles = 1.0 / 6;
  const auto found = waves.find(soil);
  const bool acts = found != waves.end() && !implicit_pores_now(state.bodies[found->second.water]);
  return acts ? cells_to_particles * found->second.speed_squared : 0;
}

}  // namespace geodrop
