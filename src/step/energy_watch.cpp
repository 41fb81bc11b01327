#include "energy_watch.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/measure/measure.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/text.hpp"
#include "boundary/viscous_boundary.hpp"
#include "membrane/pressure_potential.hpp"

namespace geodrop {
namespace {

/// Done so far by the motion of rigid bodies on what touches them [J].
template <int Dim>
double driving_work(const State<Dim>& state) {
  double work = 0;
  for (const RigidContact<Dim>& contact : state.rigid_contacts) work += contact.driving_work;
  return work;
}

/// Soil without void memory bears on all of the volume that it has opened to, and gives back more than it took.
template <int Dim>
bool has_open_soil(const State<Dim>& state) {
  constexpr double twice = 2;
  const auto opens = [](const Body<Dim>& body) {
    return soil_law(body.material) && body.gap.empty() &&
           std::any_of(body.J.begin(), body.J.end(), [](double J) { return J > twice; });
  };
  return std::any_of(state.bodies.begin(), state.bodies.end(), opens);
}

double square(const Point& g) { return std::inner_product(g.begin(), g.end(), g.begin(), 0.0); }

[[noreturn]] void stop(double held, double budget, double t_before, const std::string& cure) {
  const auto energy = [](double joules) {
    return std::isfinite(joules) ? format_number(joules, 4) + " J" : std::string("more than any number");
  };
  throw RunError("energy grows without cause: motion and strain hold " + energy(held) +
                 ", but the start, gravity, loads, pumps and moving bodies gave " + energy(budget) +
                 "; in order until t = " + format_number(t_before, 6) + " s, frames up to then are good. " + cure +
                 " may cure it");
}

}  // namespace

EnergySources energy_sources(const Scene& scene) {
  EnergySources sources{scene.gravity, scene.grid.spacing, Point(scene.gravity.size(), 0.0), still_fluids(scene)};
  for (int a = 0; a < scene.dimension; ++a)
    if (scene.walls.lower[a] == WallKind::periodic) std::swap(sources.gravity[a], sources.endless_gravity[a]);
  return sources;
}

template <int Dim>
void watch_energy(const EnergySources& sources, const StepContext& step, State<Dim>& state) {
  if (step.step % energy_watch_interval != 0) return;
  EnergyBudget& budget = state.energy_budget;
  const Totals<Dim> totals = measure(state, sources.gravity);
  const double held = totals.energy() - totals.potential, driven = driving_work(state), t = step.t + step.dt;
  const double potential = totals.potential + pressure_potential(sources.fluids, state) + boundary_potential(state);
  if (!budget.begun || budget.stages != state.stages_entered)
    budget = {true, state.stages_entered, t, held, potential, 0, driven};
  for (std::size_t a = 0; a < sources.endless_gravity.size(); ++a)
    budget.potential += sources.endless_gravity[a] * totals.momentum[a] * (t - budget.t);
  budget.fallen = std::max(budget.fallen, budget.potential - potential);
  const double g = std::sqrt(square(sources.gravity) + square(sources.endless_gravity)), h = sources.h;
  const double lift = 0.1 * totals.mass * g * h;
  const double rest = 0.5 * totals.mass * std::pow(1e-6 * h / step.dt, 2);
  const double given = budget.held + budget.fallen + std::max(0.0, driven - budget.driven) + lift + rest;
  if (held <= energy_watch_limit * given) {
    budget.t = t;
    return;
  }
  stop(held, given, budget.t,
       has_open_soil(state) ? "Soil has opened to more than twice its volume: void_memory"
                            : "A smaller solver.courant, solver.transfer tpic or a larger solver.blend_rate");
}

template void watch_energy(const EnergySources&, const StepContext&, State<2>&);
template void watch_energy(const EnergySources&, const StepContext&, State<3>&);

}  // namespace geodrop
