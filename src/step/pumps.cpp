#include "pumps.hpp"

#include <algorithm>
#include <numeric>

#include "base/fixed_order_sum.hpp"
#include "state/energy_gain.hpp"

namespace geodrop {
namespace {

/// m (v^2 / 2 + (W + J p) / rho0) of a body of fluid [J]: its motion, and what presses as much again in.
template <int Dim>
double enthalpy(const Body<Dim>& body) {
  const auto& fluid = std::get<Newtonian>(body.material);
  return fixed_order_sum<double>(body.size(), [&](double& sum, std::size_t p) {
    const double J = body.J[p], gas = body.gas_at(p);
    const double pressing = fluid_energy(fluid, J, gas) + J * fluid_pressure(fluid, J, gas);
    double square = 0;
    for (const auto& component : body.v) square += component[p] * component[p];
    sum += body.mass[p] * (0.5 * square + pressing / fluid.density);
  });
}

}  // namespace

template <int Dim>
void pump_fluid(const std::vector<PumpSpec>& pumps, const Point& g, const StepContext& step, State<Dim>& state) {
  for (const PumpSpec& pump : pumps) {
    const double time = std::min(step.t + step.dt, pump.to) - std::max(step.t, pump.from);
    if (time <= 0) continue;
    for (Body<Dim>& body : state.bodies) {
      if (body.name != pump.body || body.field == waiting) continue;
      const double mass = std::accumulate(body.mass.begin(), body.mass.end(), 0.0);
      const double growth = 1 + pump.rate * time * reference_density(body.material) / mass;
      double height = 0;
      for (int a = 0; a < Dim; ++a) {
        const double fall =
            (growth - 1) * g[a] * std::inner_product(body.mass.begin(), body.mass.end(), body.x[a].begin(), 0.0);
        state.relaxation.initial_potential -= fall;
        height -= fall;
      }
      for (double& m : body.mass) m *= growth;
      for (double& J : body.J) J /= growth;
      for (double& gas : body.gas) gas /= growth;
      // At the pressure after it, which moves the nodes of the next step: the mean of both would be 15 % too little
      // for a tube whose pressure one step of pumping doubles (pressurised_tube).
      give({(1 - 1 / growth) * enthalpy(body), height}, state.energy_budget);
    }
  }
}

template void pump_fluid<2>(const std::vector<PumpSpec>&, const Point&, const StepContext&, State<2>&);
template void pump_fluid<3>(const std::vector<PumpSpec>&, const Point&, const StepContext&, State<3>&);

}  // namespace geodrop
