#include "stable_dt.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <geodrop/base/error.hpp>
#include <geodrop/base/find_named.hpp>
#include <limits>

#include "contact/space_surface.hpp"
#include "contact/surface_contact.hpp"
#include "materials/neo_hookean.hpp"
#include "materials/pore_gas.hpp"
#include "materials/strain.hpp"
#include "pores/pores.hpp"
#include "stiffest_mode.hpp"

namespace geodrop {
namespace {

/// Share of rho c^2 that counts where cells bear the pressure of water in pores: omega^2 <= 1.1 c^2 / h^2 with full
/// cells in place of the 6 d c^2 / h^2 of particles; 1 / 6 keeps full cells from being softened.
constexpr double cells_to_particles = 1.0 / 6;

/// That of K where cells bear the mean stress of a solid. Light cells at the edges of a body swing together: a panel of
/// nu = 0.4999 breaks with 1 / 6, and bears 0.18.
constexpr double solid_cells_to_particles = 1.0 / 3;

/// Density of the material that a membrane's mass and stiffness share a node with [kg/m3].
template <int Dim>
double density_beside(const State<Dim>& state, const Membrane<Dim>& membrane) {
  for (const Body<Dim>& body : state.bodies)
    if (body.name == membrane.body) return reference_density(body.material);
  return 0;
}

/// Stiffness over mass of a membrane in a cell [m2/s2], of that of its body beside it or, without a body, its own.
template <int Dim>
double membrane_speed_squared(const State<Dim>& state, const Membrane<Dim>& membrane, double h) {
  const double beside = density_beside(state, membrane) * h;
  if constexpr (Dim == 2) {
    return membrane.axial_stiffness / beside;
  } else {
    const auto& cloth = membrane.triangles;
    const double stiffness = std::max(membrane.axial_stiffness / (1 - cloth.poisson_ratio), cloth.weft_stiffness);
    return stiffness / std::max(beside, cloth.mass_per_area);
  }
}

/// Of the stiffest membrane of a velocity field.
template <int Dim>
double membranes2(const State<Dim>& state, int field, double h) {
  double square = 0;
  for (const Membrane<Dim>& membrane : state.membranes)
    if (membrane.field == field) square = std::max(square, membrane_speed_squared(state, membrane, h));
  return square;
}

/// Stiffness of the pore gas at the largest pore pressure of its particles in place of that at the start [Pa].
template <int Dim>
double pore_stiffness_now(const Body<Dim>& body, const MohrCoulombWithGas& soil) {
  const auto n = static_cast<std::ptrdiff_t>(body.size());
  double stiffness = soil.pore_stiffness;
#pragma omp parallel for schedule(static) reduction(max : stiffness)
  for (std::ptrdiff_t p = 0; p < n; ++p)
    stiffness = std::max(stiffness, gas_pore_stiffness(soil, body.pore_pressure[p], body.J[p]));
  return stiffness;
}

/// Moduli that the next step follows explicitly, of pore gas as it is now.
template <int Dim>
ElasticModuli present_moduli(const Body<Dim>& body) {
  ElasticModuli moduli = explicit_moduli(body);
  if (const auto* soil = std::get_if<MohrCoulombWithGas>(&body.material))
    moduli.bulk += pore_stiffness_now(body, *soil) - soil->pore_stiffness;
  return moduli;
}

/// Largest over the particles of a neo-Hookean body, which stiffens where it is stretched or squeezed [Pa]; a NaN is
/// left to v_max, which shows it a step later.
template <int Dim>
double most_strained(const Body<Dim>& body, const auto& modulus_at) {
  const auto n = static_cast<std::ptrdiff_t>(body.size());
  double modulus = 0;
#pragma omp parallel for schedule(static) reduction(max : modulus)
  for (std::ptrdiff_t p = 0; p < n; ++p) {
    Gradient<Dim, double> F;
    for (int c = 0; c < Dim * Dim; ++c) F[c] = body.deformation[c][p];
    modulus = std::max(modulus, modulus_at(F, body.J[p]));
  }
  return modulus;
}

/// c_eff^2 of a body with the membranes of its field, without the water that flows through it [m2/s2]. Where no bound
/// of the basis is known, waves and membranes in one sum.
template <int Dim>
double speed_squared(const Body<Dim>& body, bool bounded, double membranes) {
  const double density = reference_density(body.material);
  if (const auto* solid = std::get_if<NeoHookean>(&body.material)) {
    const auto waves = [&](const auto& F, double J) { return neo_hookean_wave_modulus<Dim>(*solid, F, J); };
    if (!bounded) return most_strained(body, waves) / density + membranes;
    const auto stiffest = [&](const auto& F, double J) { return neo_hookean_stiffest_mode<Dim>(*solid, F, J); };
    return most_strained(body, stiffest) / density + stiffest_mode<Dim>({0, 0, membranes});
  }
  const ElasticModuli moduli = present_moduli(body);
  // Fluids keep the sum, too: splashing water bears no longer steps (docs/verification.md), and a bag of water at rest
  // circulates more with them.
  if (!bounded || moduli.shear == 0) return moduli.of_waves() / density + membranes;
  const bool by_cells = body.pressure == PressureSupport::cell;
  const double bulk = moduli.bulk / density, of_cells = by_cells ? solid_cells_to_particles * bulk : 0;
  return of_cells + stiffest_mode<Dim>({by_cells ? 0 : bulk, moduli.shear / density, membranes});
}

/// The largest [m2/s]. Eddies of a mixing length l mix with at most l sqrt(tau / rho), tau the shear stress of the step
/// before.
template <int Dim>
double viscosity_in(const Body<Dim>& body) {
  const double laminar = kinematic_viscosity(body.material);
  const auto* fluid = std::get_if<Newtonian>(&body.material);
  if (!fluid || fluid->mixing_length == 0) return laminar;
  const auto n = static_cast<std::ptrdiff_t>(body.size());
  double square = 0;
#pragma omp parallel for schedule(static) reduction(max : square)
  for (std::ptrdiff_t p = 0; p < n; ++p) {
    Stress<Dim, double> s;
    for (int c = 0; c < stress_components<Dim>; ++c) s[c] = body.stress[c][p];
    square = std::max(square, 0.5 * norm_squared<Dim, double>(s));
  }
  return laminar + fluid->mixing_length * std::sqrt(std::sqrt(square) / fluid->density);
}

/// A mass-proportional damping beta leaves (2/omega)(sqrt(1 + xi^2) - xi) of the step, xi = beta / (2 omega).
double damped(double dt, double rate) {
  const double xi = rate * dt / 4;
  constexpr double square_is_all = 1e8;  // 1 is beyond the last digit of xi^2, and the difference would cancel
  return xi < square_is_all ? dt * (std::sqrt(1 + xi * xi) - xi) : dt / (2 * xi);
}

/// Mass per area that a penalty moves [kg/m2].
template <int Dim>
double mass_on(const State<Dim>& state, const RigidContact<Dim>& contact, double h) {
  if constexpr (Dim == 2) {
    return reference_density(touching_body(state, contact).material) * h;
  } else {
    const Membrane<3>& membrane = find_named(state.membranes, contact.touching);
    return std::max(density_beside(state, membrane) * h, membrane.triangles.mass_per_area);
  }
}

/// Largest step that penalties allow: k dt^2 / (rho h) = stiffness (c dt / h)^2 <= 1/2, and of their damping
/// z dt / (rho h) = damping c dt / h <= 1/2.
template <int Dim>
double contact_dt(const State<Dim>& state, double h) {
  constexpr double most = 0.5;  // of springs on mass that moves with its cell; beyond it contact gains energy
  double dt = std::numeric_limits<double>::infinity();
  const auto limit = [&](const auto& contact, double mass) {
    dt = std::min({dt, std::sqrt(most * mass / contact.stiffness), most * mass / contact.damping});
  };
  for (const RigidContact<Dim>& contact : state.rigid_contacts) limit(contact, mass_on(state, contact, h));
  for (const MembraneContact<Dim>& contact : state.membrane_contacts) {
    double of_both = 0;  // 1 / m + 1 / m, as two bodies on one spring have it
    for (const std::string& name : contact.between)
      of_both += 1 / (density_beside(state, find_named(state.membranes, name)) * h);
    limit(contact, 1 / of_both);
  }
  return dt;
}

/// Largest speed of rigid bodies that something may touch [m/s]; a half-plane that turns has no largest one.
template <int Dim>
double surface_speed(const State<Dim>& state) {
  double speed = 0;
  using Surface = std::conditional_t<Dim == 2, RigidSurface, SpaceSurface>;
  for (const RigidBody<Dim>& body : state.rigid)
    if (body.present) speed = std::max(speed, Surface(body).speed());
  return speed;
}

/// Says where the first velocity is that is not finite.
template <int Dim>
[[noreturn]] void throw_not_finite(const State<Dim>& state) {
  const auto broken = [](const Body<Dim>& body, std::size_t p) {
    return std::any_of(body.v.begin(), body.v.end(), [&](const auto& v) { return !std::isfinite(v[p]); });
  };
  const auto first = [&]() -> std::string {
    for (const Body<Dim>& body : state.bodies)
      for (std::size_t p = 0; p < body.size(); ++p) {
        if (!broken(body, p)) continue;
        std::string place;
        for (int a = 0; a < Dim; ++a) place += fmt::format(" {:g}", body.x[a][p]);
        return fmt::format(": body '{}', particle id {} (J = {:g}, x ={})", body.name, body.id[p], body.J[p], place);
      }
    return {};
  };
  throw RunError(fmt::format("a velocity is not finite after step {}, t = {:g} s{}; the last frame is kept", state.step,
                             state.t, first()));
}

}  // namespace

StepLimits::StepLimits(const Scene& scene)
    : courant(scene.solver.courant),
      end(scene.time.end),
      bounded(scene.grid.basis == Basis::bspline2 && scene.solver.mass_matrix == MassMatrix::lumped),
      pore_waves(geodrop::pore_waves(scene)) {}

/// dt = C h / (c_eff + |v|max), c_eff^2 the largest of bodies, each with the membranes of its velocity field (in one
/// mode: safe) and the water that flows through it; viscosity: C times h^2 / (2 d nu), the limit of an explicit step
/// (safe); h is the finest cell's.
template <int Dim>
double stable_dt(const StepLimits& limits, const State<Dim>& state, const GridLayout<Dim>& layout) {
  if (!std::isfinite(state.v_max)) throw_not_finite(state);
  double c2 = 0, nu = 0;
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const Body<Dim>& body = state.bodies[b];
    const auto pores = limits.pore_waves.find(b);
    const bool explicit_pores =
        pores != limits.pore_waves.end() && !implicit_pores_now(state.bodies[pores->second.water]);
    const double pores2 = explicit_pores ? cells_to_particles * pores->second.speed_squared : 0;
    const double membranes = membranes2(state, body.field, layout.finest);
    c2 = std::max(c2, pores2 + speed_squared(body, limits.bounded, membranes));
    nu = std::max(nu, viscosity_in(body));
  }
  for (const Membrane<Dim>& membrane : state.membranes) {  // of a field without bodies, too
    const double alone = membranes2(state, membrane.field, layout.finest);
    c2 = std::max(c2, limits.bounded ? stiffest_mode<Dim>({0, 0, alone}) : alone);
  }
  double dt = limits.courant * layout.finest / (std::sqrt(c2) + std::max(state.v_max, surface_speed(state)));
  dt = std::min(dt, contact_dt(state, layout.finest));
  if (nu > 0) dt = std::min(dt, limits.courant * layout.finest * layout.finest / (2 * Dim * nu));
  dt = damped(dt, state.damping_rate);
  constexpr double smallest_share = 1e-12;  // of the simulated time: the run would never end
  if (dt < smallest_share * limits.end) {
    throw RunError(fmt::format(
        "the time step collapsed: at {:g} s more than 1e12 steps are needed to time.end = {:g} s (step {}, t = {:g} s, "
        "|v|max = {:g} m/s)",
        dt, limits.end, state.step, state.t, state.v_max));
  }
  return dt;
}

template double stable_dt(const StepLimits&, const State<2>&, const GridLayout<2>&);
template double stable_dt(const StepLimits&, const State<3>&, const GridLayout<3>&);

}  // namespace geodrop
