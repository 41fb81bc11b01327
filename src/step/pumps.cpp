#include "pumps.hpp"

#include <algorithm>
#include <numeric>

namespace geodrop {

template <int Dim>
void pump_fluid(const std::vector<PumpSpec>& pumps, const Point& g, const StepContext& step, State<Dim>& state) {
  for (const PumpSpec& pump : pumps) {
    const double time = std::min(step.t + step.dt, pump.to) - std::max(step.t, pump.from);
    if (time <= 0) continue;
    for (Body<Dim>& body : state.bodies) {
      if (body.name != pump.body || body.field == waiting) continue;
      const double mass = std::accumulate(body.mass.begin(), body.mass.end(), 0.0);
      const double growth = 1 + pump.rate * time * reference_density(body.material) / mass;
      for (int a = 0; a < Dim; ++a)
        state.relaxation.initial_potential -=
            (growth - 1) * g[a] * std::inner_product(body.mass.begin(), body.mass.end(), body.x[a].begin(), 0.0);
      for (double& m : body.mass) m *= growth;
      for (double& J : body.J) J /= growth;
      for (double& gas : body.gas) gas /= growth;
    }
  }
}

template void pump_fluid<2>(const std::vector<PumpSpec>&, const Point&, const StepContext&, State<2>&);
template void pump_fluid<3>(const std::vector<PumpSpec>&, const Point&, const StepContext&, State<3>&);

}  // namespace geodrop
