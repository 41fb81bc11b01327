// Constitutive laws. A law sees one point, or one packet of points with the lanes as points; never an array.
// `R` is double or a packet type (GCC vector extension); laws are written with `select`, without branches.
//
// Here stand the state variables of points and, of each law, what the user wrote (XSpec, in SI units) and its constants
// (X), all of them doubles; `state` calls f with each of the state variables that the law keeps: those are allocated.
// All that goes through the laws follows from the list `Material`. The law at work is in src/materials.
#pragma once

#include <geodrop/base/arrays.hpp>
#include <geodrop/base/error.hpp>

#include <array>
#include <bit>
#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace geodrop {

/// What laws keep of a point beside its volume ratio J. In the list in the order of the checkpoint.
template <int Dim>
struct StateVariables {
  std::array<Array<double>, stress_components<Dim>>
      stress;                                        ///< soil: effective Cauchy stress; viscous fluid: deviator [Pa]
  std::array<Array<double>, Dim * Dim> deformation;  ///< neo-Hookean: F, row-major [-]
  Array<double> pore_pressure;                       ///< undrained soil [Pa]
  Array<double> deviatoric_strain;                   ///< soil: accumulated sqrt(2/3 e:e) [-]
  Array<double> gap;                                 ///< soil with void memory: volume of open voids over its own [-]
  Array<double> eddy_length;                         ///< fluid with a mixing length: that, limited near walls [m]
  Array<double> gas;  ///< pore water with gas: volume of that at zero pressure over the water's own [-]
};

template <int Dim>
inline constexpr auto state_variables = [] {
  using namespace particle_role;
  using S = StateVariables<Dim>;
  return std::tuple{field<per_particle | scattered | gathered>("stress", "Pa", &S::stress),
                    field<per_particle | gathered>("deformation", "-", &S::deformation),
                    field<per_particle | scattered | gathered | shown>("pore_pressure", "Pa", &S::pore_pressure),
                    field<per_particle | gathered | shown>("deviatoric_strain", "-", &S::deviatoric_strain),
                    field<per_particle | gathered | shown_if_any>("gap", "-", &S::gap),
                    field<per_particle | gathered>("eddy_length", "m", &S::eddy_length),
                    field<per_particle | scattered | shown_if_any>("gas", "-", &S::gas)};
}();

/// Newtonian, weakly compressible: p = K (rho / rho0 - 1), at least -tension_cutoff; deviator 2 mu dev(D).
struct NewtonianSpec {
  double density = 0;        ///< at zero pressure [kg/m3]
  double bulk_modulus = 0;   ///< [Pa]; the scene may give sound_speed instead, K = rho c^2
  double viscosity = 0;      ///< dynamic [Pa s]
  double mixing_length = 0;  ///< of eddies that are not resolved, far from walls [m]; 0: none
  double tension_cutoff = std::numeric_limits<double>::infinity();  ///< largest suction [Pa]; infinite: any
  std::optional<double> still_level = {};  ///< of the surface of still water that has its density at every depth [m]
  double unit_weight = 0;                  ///< density times gravity where it has a still_level [N/m3]
  bool operator==(const NewtonianSpec&) const = default;
};
/// p = K (1/J - 1), deviator 2 (mu + mu_t) dev(D). J = rho0 / rho. Eddies smaller than the mixing length l mix as
/// mu_t = rho0 l^2 sqrt(2 dev(D) : dev(D)) (Prandtl 1925; Smagorinsky 1963); near walls l is less, see
/// boundary/eddy_length. Water that cavitates keeps p = -T however
/// far it opens: p is a function of J all the same, so that voids close again without a loss of volume. The water in
/// the pores of a soil may have gas in it, see fluid_pressure. With a still level y0, p = K (1/J - 1) + rho0 g (y0 -
/// y): water of a reduced stiffness has its density at every depth where it is still, and stays neutral to a parcel
/// that moves up or down.
struct Newtonian {
  double density;                                                   ///< rho0 [kg/m3]
  double bulk_modulus;                                              ///< K [Pa]
  double viscosity;                                                 ///< mu [Pa s]
  double mixing_length = 0;                                         ///< l [m]; 0: no eddies
  double tension_cutoff = std::numeric_limits<double>::infinity();  ///< T [Pa]
  double gas = 0;                                                   ///< g, the most that a particle has [-]; 0: none
  double atmosphere = 0;                                            ///< absolute pressure where p = 0 [Pa]
  double unit_weight = 0;                                           ///< rho0 g; 0: no still level [N/m3]
  double still_level = 0;                                           ///< y0 [m]

  bool has_gas() const { return gas > 0; }
  bool has_still_level() const { return unit_weight > 0; }
  /// The part of the pressure at a height that its density does not follow [Pa].
  double of_weight(double y) const { return unit_weight * (still_level - y); }
  bool viscous() const { return viscosity > 0 || mixing_length > 0; }
  /// At J = infinity p = -K.
  bool cavitates() const { return tension_cutoff < bulk_modulus; }

  void state(auto& points, auto f) const {
    if (viscous()) f(points.stress);
    if (mixing_length > 0) f(points.eddy_length);
    if (has_gas()) f(points.gas);
  }
};

/// Hypoelastic with logarithmic strain and a rotated (Hughes-Winget) Cauchy stress.
struct LinearElasticSpec {
  double density = 0;         ///< [kg/m3]
  double youngs_modulus = 0;  ///< [Pa]
  double poissons_ratio = 0;  ///< [-]
  bool operator==(const LinearElasticSpec&) const = default;
};
/// Isotropic hypoelasticity in Cauchy stress.
struct LinearElastic {
  double density;        ///< [kg/m3]
  double bulk_modulus;   ///< [Pa]
  double shear_modulus;  ///< [Pa]

  void state(auto& points, auto f) const { f(points.stress); }
};

/// Gas in pores that follows Boyle's law; see materials/pore_gas for undrained soil, fluid_pressure for coupled soil.
struct PoreGasSpec {
  double water_bulk_modulus = 0;    ///< of undrained soil [Pa]
  double gas_pressure = 0;          ///< absolute, at which the gas has its share of the pores [Pa]
  double atmospheric_pressure = 0;  ///< absolute, where the pore pressure is 0 [Pa]
  bool operator==(const PoreGasSpec&) const = default;
};
/// Fluid in the pores of an undrained soil: pore pressure rate = -(K_f / n) div v.
struct UndrainedSpec {
  double porosity = 0;            ///< [-]
  double fluid_bulk_modulus = 0;  ///< [Pa]
  /// Share of the pores that water fills, where K_f follows from it [-]; empty: K_f is the user's own.
  std::optional<double> saturation = {};
  std::optional<PoreGasSpec> gas = {};  ///< empty: K_f stays that of the start
  bool operator==(const UndrainedSpec&) const = default;
};
/// Soil whose pore water is a body of its own: both move, see src/pores.
struct CoupledSpec {
  double porosity = 0;                ///< n0 at the start [-]
  double hydraulic_conductivity = 0;  ///< k0 at that porosity [m/s]
  enum class Permeability { kozeny_carman, constant } permeability = Permeability::kozeny_carman;
  double forchheimer_coefficient = 0;  ///< b in i = q / k + b q^2 at that porosity [s2/m2]; 0: Darcy's law
  double saturation = 1;               ///< share of the pores that water fills at the pressure of the gas [-]
  PoreGasSpec gas = {};

  /// Volume of the gas at zero pressure over that of the water [-].
  double gas_ratio() const {
    return saturation < 1 ? (1 - saturation) / saturation * gas.gas_pressure / gas.atmospheric_pressure : 0;
  }
  bool operator==(const CoupledSpec&) const = default;
};
/// Soil that dilates or contracts until it has its critical porosity, see materials/critical_state.
struct CriticalStateSpec {
  double porosity = 0;           ///< n0 at the start [-]
  double critical_porosity = 0;  ///< n_c [-]
  double dilatancy_slope = 0;    ///< K in tan(psi) = K (n_c - n) [-]
  bool operator==(const CriticalStateSpec&) const = default;
};
/// Elastic, perfectly plastic Mohr-Coulomb in effective stress.
struct MohrCoulombSpec {
  double density =
      0;  ///< of the mixture [kg/m3], coupled: without the water; the scene may give that of the grains instead
  double youngs_modulus = 0;       ///< [Pa]
  double poissons_ratio = 0;       ///< [-]
  double cohesion = 0;             ///< [Pa]
  double friction_angle_deg = 0;   ///< [degree]
  double dilatancy_angle_deg = 0;  ///< [degree]
  double tension_cutoff = 0;       ///< largest principal effective stress [Pa], at most c cot(phi)
  std::variant<std::monostate, UndrainedSpec, CoupledSpec> pores;  ///< none: drained
  bool void_memory = false;  ///< what opens at the cut-off closes again without stress
  /// Dilatancy that follows the porosity, in the place of the angle; friction_angle_deg is that of the critical state.
  std::optional<CriticalStateSpec> critical_state = {};

  /// Null if the soil is of another kind.
  const UndrainedSpec* undrained() const { return std::get_if<UndrainedSpec>(&pores); }
  const CoupledSpec* coupled() const { return std::get_if<CoupledSpec>(&pores); }
  bool operator==(const MohrCoulombSpec&) const = default;
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

  void state(auto& points, auto f) const {
    f(points.stress);
    f(points.deviatoric_strain);
    if (pore_stiffness > 0) f(points.pore_pressure);
  }
};

/// The same without dilatancy, where what opens at the cut-off closes again without stress; see materials/void_memory.
struct MohrCoulombWithVoids : MohrCoulomb {
  /// Whether soil with open voids can be pressed or sheared: a cut-off at the apex leaves it one stress alone. A
  /// cut-off typed in with a few digits is that, too.
  bool bears_while_open() const {
    constexpr double digits = 0.999;
    return tension_cutoff * sin_phi < digits * cohesion * cos_phi;
  }

  void state(auto& points, auto f) const {
    MohrCoulomb::state(points, f);
    f(points.gap);
  }
};

/// The same with tan(psi) = K (n_c - n), tan(phi) = tan(phi_c) + tan(psi), 1 - n = (1 - n0) / J; see
/// materials/critical_state. The angles of the base are those of the critical state.
struct CriticalStateSoil : MohrCoulomb {
  double solid_fraction;     ///< 1 - n0 [-]
  double critical_porosity;  ///< n_c [-]
  double dilatancy_slope;    ///< K [-]
  double tan_phi;            ///< of the critical state [-]
};

/// Mohr-Coulomb whose pores have water and gas that cannot leave; see materials/pore_gas. pore_stiffness is that of
/// small changes about the pressure at which the gas has its share.
struct MohrCoulombWithGas : MohrCoulomb {
  double water_compliance;  ///< n S / K_w [1/Pa]
  double gas;               ///< n (1 - S) p_g, volume of the gas times its pressure per volume of soil at J = 1 [Pa]
  double atmosphere;        ///< absolute pressure where the pore pressure is 0 [Pa]
};

/// Compressible neo-Hookean solid: sigma = (mu / J) (F F^T - I) + (lambda ln J / J) I.
struct NeoHookeanSpec {
  double density = 0;         ///< unstrained [kg/m3]
  double youngs_modulus = 0;  ///< at small strain [Pa]
  double poissons_ratio = 0;  ///< [-]
  bool operator==(const NeoHookeanSpec&) const = default;
};
/// Compressible neo-Hookean solid at finite strain; needs the deformation gradient.
struct NeoHookean {
  double density;        ///< unstrained [kg/m3]
  double lame_lambda;    ///< [Pa]
  double shear_modulus;  ///< mu [Pa]

  void state(auto& points, auto f) const {
    f(points.stress);
    f(points.deformation);
  }
};

/// The list of laws. A checkpoint holds their numbers: new ones come last.
using Material = std::variant<Newtonian, LinearElastic, MohrCoulomb, NeoHookean, MohrCoulombWithVoids,
                              CriticalStateSoil, MohrCoulombWithGas>;

struct MaterialSpec {
  std::string name;
  std::variant<NewtonianSpec, LinearElasticSpec, MohrCoulombSpec, NeoHookeanSpec> model;
  SourceRef at;
  bool operator==(const MaterialSpec&) const = default;
};

/// The constants of a law as plain numbers, for checkpoints.
template <class Law>
auto constants_of(const Law& law) {
  return std::bit_cast<std::array<double, sizeof(Law) / sizeof(double)>>(law);
}

/// Converts to a double and to nothing else.
struct OnlyDouble {
  template <std::same_as<double> T>
  operator T() const;
};

/// Whether a law consists of doubles and nothing else: can be made of as many of them as fill its memory.
template <class Law>
inline constexpr bool only_doubles = []<std::size_t... i>(std::index_sequence<i...>) {
  return sizeof(Law) == sizeof...(i) * sizeof(double) && requires { Law{(static_cast<void>(i), OnlyDouble{})...}; };
}
(std::make_index_sequence<sizeof(Law) / sizeof(double)>{});

template <class... Law>
constexpr bool all_only_doubles(std::type_identity<std::variant<Law...>>) {
  return (only_doubles<Law> && ...);
}
static_assert(all_only_doubles(std::type_identity<Material>{}), "the constants of a law have to be doubles");

/// A law of number `index` in the list, all constants zero.
Material blank_law(std::size_t index);

Material make_material(const MaterialSpec& spec);

/// The law of a soil, with or without voids; null if the material is no soil.
const MohrCoulomb* soil_law(const Material& material);

/// Density at zero pressure (fluid) or at the start (soil) [kg/m3].
double reference_density(const Material& material);

/// Speed of elastic compression waves at zero strain, pore fluid included [m/s].
double wave_speed(const Material& material);

/// What elastic compression waves meet at zero strain, rho c [Pa s/m].
double impedance(const Material& material);

/// Of small elastic strain, pore water included [Pa].
struct ElasticModuli {
  double bulk, shear;  ///< K, G

  /// rho c^2 of compression waves.
  double of_waves() const;
};
ElasticModuli elastic_moduli(const Material& material);

/// rho c^2 of compression waves, pore water included [Pa].
double wave_modulus(const Material& material);

/// K_f / n of undrained soil, the share of its pore water in wave_modulus; 0 of others [Pa].
double pore_stiffness(const Material& material);

/// What acts at the end of the step with an implicit pore pressure: K_f / n of undrained soil, K of pore water, with
/// gas in it the largest at any pressure (fluid_stiffness has that of one) [Pa].
double implicit_modulus(const Material& material);

/// Speed of elastic shear waves at zero strain [m/s]; 0 in a fluid.
double shear_wave_speed(const Material& material);

/// Pressure of a fluid [Pa]. With g, the volume of gas at zero pressure over that of the water, both are under one
/// pressure (no menisci, nothing dissolves, constant temperature: Boyle's law), p_a the atmosphere's:
///   J = 1 / (1 + p / K) + g p_a / (p_a + p)
/// of_weight: what Newtonian::of_weight has at its height [Pa].
double fluid_pressure(const Newtonian& fluid, double J, double gas = 0, double of_weight = 0);
/// J at a pressure, less what is of_weight.
inline double fluid_volume_ratio(const Newtonian& fluid, double pressure, double gas = 0) {
  const double water = 1 / (1 + pressure / fluid.bulk_modulus);
  return gas > 0 ? water + gas * fluid.atmosphere / (fluid.atmosphere + pressure) : water;
}
/// -J dp/dJ at a pressure, of water with gas: that of the water where the gas is pressed away, p + p_a where there is
/// much of it [Pa].
double fluid_stiffness(const Newtonian& fluid, double pressure, double gas);
/// Energy per volume of the water at J = 1 [J/m3], 0 there; its slope -dW/dJ is the pressure.
double fluid_energy(const Newtonian& fluid, double J, double gas = 0, double of_weight = 0);

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
