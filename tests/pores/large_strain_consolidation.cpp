// The reference of cases/verification/large_strain_consolidation.toml: the column in the coordinate Z of the skeleton
// at the start, by finite differences (Gibson, England & Hussey 1967, for a skeleton with sigma' = -E ln(lambda)).
//
//   dlambda/dt = d/dZ (k(n) / (gamma_w lambda) du/dZ),   u = q + E ln(lambda),   1 - n = (1 - n0) / lambda
//
// lambda is the stretch, u(top) = 0, no flow through the bottom. Water and grains do not change their volume.
#include <geodrop/reader/scene_reader.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double load_ratio = 0.2;  // q / E
constexpr double n0 = 0.4, c_v = 1e-3 * 1e6 / 9810, height = 1;

double kozeny_carman(double n) { return std::pow(n, 3) / std::pow(1 - n, 2) / (std::pow(n0, 3) / std::pow(1 - n0, 2)); }

/// Height of the centre of the skeleton at the times [m].
std::vector<double> centre_heights(int cells, const std::vector<double>& times, bool follows_porosity = true,
                                   double load = load_ratio) {
  const double dz = height / cells, dt_most = 0.1 * dz * dz / c_v;
  std::vector<double> stretch(cells, 1.0), flow(cells + 1, 0.0), heights;
  const auto excess = [&](int i) { return load + std::log(stretch[i]); };  // u / E
  const auto over_stretch = [&](double lambda) {
    return (follows_porosity ? kozeny_carman(1 - (1 - n0) / lambda) : 1.0) / lambda;
  };
  double t = 0;
  for (const double until : times) {
    const int steps = static_cast<int>(std::ceil((until - t) / dt_most));
    const double dt = (until - t) / steps;
    for (int s = 0; s < steps; ++s) {
      for (int i = 1; i < cells; ++i)
        flow[i] = over_stretch(0.5 * (stretch[i - 1] + stretch[i])) * (excess(i) - excess(i - 1)) / dz;
      const double at_top = std::exp(-load);  // u = 0
      flow[cells] = over_stretch(0.5 * (stretch[cells - 1] + at_top)) * (0 - excess(cells - 1)) / (dz / 2);
      for (int i = 0; i < cells; ++i) stretch[i] += dt * c_v * (flow[i + 1] - flow[i]) / dz;
    }
    t = until;
    double below = 0, moment = 0;
    for (const double lambda : stretch) {
      moment += (below + lambda * dz / 2) * dz;
      below += lambda * dz;
    }
    heights.push_back(moment / height);
  }
  return heights;
}

}  // namespace

TEST_CASE("The reference of large-strain consolidation: limits, order, and the numbers of the case") {
  CHECK(centre_heights(50, {200.0})[0] == near(0.5 * std::exp(-load_ratio), 1e-5));
  // Small load: Terzaghi's series, the centre sinks by q/E (1/2 - sum 2 sin(M)/M^3 exp(-M^2 T)).
  const double small = 1e-4, T = 0.2;
  double sinks = 0.5;
  for (int m = 0; m < 50; ++m) {
    const double M = (2 * m + 1) * std::acos(-1.0) / 2;
    sinks -= 2 * std::sin(M) / std::pow(M, 3) * std::exp(-M * M * T);
  }
  for (const bool follows_porosity : {false, true})
    CHECK(0.5 - centre_heights(100, {T / c_v}, follows_porosity, small)[0] == near(small * sinks, 1e-3));
  const Scene scene = read_scene(source_path("cases/verification/large_strain_consolidation.toml"));
  const ResultSpec& result = scene.results.at(0);
  const std::vector<double> exact = centre_heights(100, result.times), coarse = centre_heights(50, result.times);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    CHECK(coarse[i] == within(exact[i], 2e-5));
    CHECK(result.values[i] == within(exact[i], 2e-5));
  }
}
