#include "fluid_load.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/polygon.hpp"

namespace geodrop {
namespace {

/// The part of an edge below a level, empty (from = to) if none is.
EdgePressure wet_part(double start, double end, double surface, double unit_weight) {
  const auto pressure = [&](double share) { return unit_weight * (surface - (start + share * (end - start))); };
  double from = 0, to = 1;
  if (start > surface && end > surface) return {0, 0, 0, 0};
  if (start > surface) from = (start - surface) / (start - end);
  if (end > surface) to = (surface - start) / (end - start);
  return {from, to, pressure(from), pressure(to)};
}

}  // namespace

double sense_of(const Membrane<2>& membrane) { return signed_area(membrane.x[0], membrane.x[1]) > 0 ? 1 : -1; }

void add_pressure(const EdgePressure& pressure, double sense, std::size_t k, Membrane<2>& membrane) {
  const std::size_t end = end_of_edge(k, membrane.nodes());
  const double normal[] = {sense * (membrane.x[1][end] - membrane.x[1][k]),
                           sense * (membrane.x[0][k] - membrane.x[0][end])};
  const double middle = 0.5 * (pressure.from + pressure.to), width = pressure.to - pressure.from;
  double at_start = 0, at_end = 0;
  for (const double off : {-0.5 / std::sqrt(3.0), 0.5 / std::sqrt(3.0)}) {  // Gauss points: exact to degree 3
    const double share = middle + off * width;
    const double p = 0.5 * (pressure.at_from + pressure.at_to) + off * (pressure.at_to - pressure.at_from);
    at_start += 0.5 * width * p * (1 - share);
    at_end += 0.5 * width * p * share;
  }
  for (int a = 0; a < 2; ++a) {
    membrane.load[a][k] += at_start * normal[a];
    membrane.load[a][end] += at_end * normal[a];
  }
}

std::vector<StillFluid> still_fluids(const Scene& scene) {
  std::vector<StillFluid> fluids;
  for (const StillFluidSpec& spec : scene.still_fluids) {
    const double weight = -scene.gravity.back() * reference_density(make_material(*find_material(scene, spec.fluid)));
    const double sense = spec.side == StillFluidSpec::Side::inside ? 1 : -1;
    fluids.push_back({spec.membrane, sense * weight, spec.surface});
  }
  return fluids;
}

void add_still_fluids(const std::vector<StillFluid>& fluids, State<2>& state) {
  for (const StillFluid& fluid : fluids)
    for (Membrane<2>& membrane : state.membranes) {
      if (membrane.name != fluid.membrane) continue;
      const double sense = sense_of(membrane);
      for (std::size_t k = 0; k < membrane.segments(); ++k) {
        const double start = membrane.x[1][k], end = membrane.x[1][end_of_edge(k, membrane.nodes())];
        add_pressure(wet_part(start, end, fluid.surface, fluid.unit_weight), sense, k, membrane);
      }
    }
}

}  // namespace geodrop
