#include "patch_probe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/mean_and_deviation.hpp"
#include "membrane/triangles.hpp"

namespace geodrop {
PatchMeasures measure_patch(const PatchProbeSpec& probe, const Membrane<3>& membrane) {
  const Vec<3> low(probe.lower.data()), high(probe.upper.data());
  const MembraneTriangles<3>& triangles = membrane.triangles;
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  PatchMeasures patch{nothing, nothing, nothing, nothing, Vec<3>::Constant(nothing), Vec<3>::Constant(nothing)};
  MeanAndDeviation tension, cross;  // over the cloth at rest
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Vec<3> middle = middle_of(membrane, t);
    if ((middle.array() < low.array()).any() || (middle.array() > high.array()).any()) continue;
    if (tension.weight == 0) patch.lower = patch.upper = middle;
    tension.add(triangles.rest_area[t], membrane.tension[t]);
    cross.add(triangles.rest_area[t], triangles.cross_tension[t]);
    patch.plan_area += 0.25 * std::abs(normal_of(membrane, t)[2]);
    for (const auto& corner : triangles.corner) {
      patch.lower = patch.lower.cwiseMin(vector_at(membrane.x, corner[t]));
      patch.upper = patch.upper.cwiseMax(vector_at(membrane.x, corner[t]));
    }
  }
  if (tension.weight == 0) return patch;
  patch.tension_mean = tension.mean();
  patch.tension_std = tension.deviation();
  patch.cross_mean = cross.mean();
  patch.cross_std = cross.deviation();
  return patch;
}

}  // namespace geodrop
