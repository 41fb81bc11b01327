#include "stable_dt.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <geodrop/base/error.hpp>
#include <geodrop/scene/velocity_fields.hpp>

#include "contact/contact_limits.hpp"
#include "grid/body_limits.hpp"
#include "membrane/membrane_limits.hpp"

namespace geodrop {
namespace {

/// A mass-proportional damping beta leaves (2/omega)(sqrt(1 + xi^2) - xi) of the step, xi = beta / (2 omega).
double damped(double dt, double rate) {
  const double xi = rate * dt / 4;
  constexpr double square_is_all = 1e8;  // 1 is beyond the last digit of xi^2, and the difference would cancel
  return xi < square_is_all ? dt * (std::sqrt(1 + xi * xi) - xi) : dt / (2 * xi);
}

/// Says where the first velocity is that is not finite.
template <int Dim>
[[noreturn]] void throw_not_finite(const State<Dim>& state) {
  std::string first;
  for (const Body<Dim>& body : state.bodies)
    for (std::size_t p = 0; first.empty() && p < body.size(); ++p) {
      if (std::all_of(body.v.begin(), body.v.end(), [&](const auto& v) { return std::isfinite(v[p]); })) continue;
      first = fmt::format(": body '{}', particle id {} (J = {:g}, x =", body.name, body.id[p], body.J[p]);
      for (int a = 0; a < Dim; ++a) first += fmt::format(" {:g}", body.x[a][p]);
      first += ")";
    }
  throw RunError(fmt::format("a velocity is not finite after step {}, t = {:g} s{}; the last frame is kept", state.step,
                             state.t, first));
}

/// By velocity field: I + (I - D^-1 M) has eigenvalues up to 2, as those of D^-1 M are 0 to 1 (mass_at_membranes).
std::vector<double> inverse_masses(const Scene& scene) {
  const bool corrected = scene.solver.mass_matrix == MassMatrix::consistent_at_membranes;
  std::vector<double> most(count_velocity_fields(scene), corrected ? 2.0 : 1.0);
  for (const PoreSoil& soil : pore_soils(scene)) most[soil.field] = most[soil.water] = 1;
  return most;
}

}  // namespace

StepLimits::StepLimits(const Scene& scene)
    : courant(scene.solver.courant),
      end(scene.time.end),
      bounded(scene.grid.basis == Basis::bspline2 && scene.solver.mass_matrix != MassMatrix::consistent),
      inverse_mass(inverse_masses(scene)),
      pore_waves(geodrop::pore_waves(scene)) {}

/// dt = C h / (c_eff + |v|max), c_eff^2 the largest of bodies, each with the membranes of its velocity field (in one
/// mode: safe) and the water that flows through it; viscosity: C times h^2 / (2 d nu), the limit of an explicit step
/// (safe); h is the finest cell's.
template <int Dim>
double stable_dt(const StepLimits& limits, const State<Dim>& state, const GridLayout<Dim>& layout) {
  if (!std::isfinite(state.v_max)) throw_not_finite(state);
  const double h = layout.finest;
  double c2 = 0, nu = 0;
  for (const Membrane<Dim>& membrane : state.membranes) {  // also of a field without bodies
    const double cloth = limits.inverse_mass_of(membrane.field) * membrane_speed_squared(state, membrane, h);
    c2 = std::max(c2, limits.bounded ? stiffest_mode<Dim>({0, 0, cloth}) : cloth);
  }
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const Body<Dim>& body = state.bodies[b];
    const double membranes = stiffest_membrane(state, h, body.field);
    const double waves = speed_squared(body, limits.bounded, membranes, limits.inverse_mass_of(body.field));
    c2 = std::max(c2, explicit_waves(limits.pore_waves, b, state) + waves);
    nu = std::max(nu, viscosity_in(body));
  }
  double dt = limits.courant * h / (std::sqrt(c2) + std::max(state.v_max, surface_speed(state)));
  dt = std::min(dt, contact_dt(state, h));
  if (nu > 0) dt = std::min(dt, limits.courant * h * h / (2 * Dim * nu));
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
