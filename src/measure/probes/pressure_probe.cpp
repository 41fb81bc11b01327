#include "pressure_probe.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/grid/graded_axis.hpp>
#include <geodrop/measure/measure.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace geodrop {
namespace {

/// The lowest and the highest node of a membrane.
template <int Dim>
std::vector<Vec<Dim>> tips_of(const State<Dim>& state, const std::string& name) {
  if (name.empty()) return {};
  const Membrane<Dim>& membrane = find_named(state.membranes, name);
  const Array<double>& height = membrane.x[vertical_axis<Dim>];
  const auto [low, high] = std::minmax_element(height.begin(), height.end());
  return {vector_at(membrane.x, low - height.begin()), vector_at(membrane.x, high - height.begin())};
}

}  // namespace

template <int Dim>
PressureSpread pressure_spread(const Scene& scene, const HydrostaticProbeSpec& probe, const State<Dim>& state) {
  const Material material = make_material(*find_material(scene, probe.still.fluid));
  const auto& fluid = std::get<Newtonian>(material);
  const double gravity = -scene.gravity[vertical_axis<Dim>], near = 2 * finest_spacing(scene.grid), percent = 99.9;
  const std::vector<Vec<Dim>> tips = tips_of(state, probe.tips_of);
  const Body<Dim>& body = find_named(state.bodies, probe.body);
  std::vector<double> errors(body.size()), elsewhere, at_tips;
#pragma omp parallel for schedule(static)
  for (std::size_t p = 0; p < body.size(); ++p) {
    const double depth = probe.still.surface - body.x[vertical_axis<Dim>][p];
    errors[p] = std::abs(mean_pressure(body, p) - still_pressure(fluid, gravity, depth));
  }
  for (std::size_t p = 0; p < body.size(); ++p) {
    const auto close = [&, x = vector_at(body.x, p)](const Vec<Dim>& tip) { return (x - tip).norm() < near; };
    (std::ranges::any_of(tips, close) ? at_tips : elsewhere).push_back(errors[p]);
  }
  return {percentile(std::move(elsewhere), percent), percentile(std::move(at_tips), percent)};
}

template PressureSpread pressure_spread(const Scene&, const HydrostaticProbeSpec&, const State<2>&);
template PressureSpread pressure_spread(const Scene&, const HydrostaticProbeSpec&, const State<3>&);

}  // namespace geodrop
