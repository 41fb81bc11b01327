// The reference of cases/verification/mandel.toml: a round bag in plane strain in the radius r, by finite differences
// (Biot 1941; de Leeuw 1965). With p over that around, eps the volumetric strain, u = (1/R) int eps r dr the
// displacement of the surface, and the effective pressure e at the start that ends as none:
//
//   d(eps + S p)/dt = (1/r) d/dr (r (k/gamma_w) dp/dr),   M eps = p + f(t),   f = p0 + 2 G u/R,   p(R) = 0
#include <geodrop/reader/scene_reader.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

struct Skeleton {
  double M, G;  ///< confined and shear modulus [Pa]
};

constexpr double R = 0.5, start = -5000, storage = 0.4 / (1000 * 200.0 * 200.0), mobility = 1e-3 / 9810;

Skeleton skeleton(double E, double nu) { return {E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))}; }

struct Instant {
  double t, centre, moved;  ///< [s], p at r = 0 [Pa], u [m]
};

/// Every 0.01 s up to `end`.
std::vector<Instant> consolidate(const Skeleton& of, int cells, double end, double S = storage) {
  const double dr = R / cells;
  std::vector<double> p(cells, start), strain(cells, 0.0), flow(cells + 1, 0.0);
  std::vector<Instant> out;
  const int samples = static_cast<int>(std::lround(end / 0.01));
  const int steps = static_cast<int>(std::ceil(0.01 / (0.2 * dr * dr / (mobility * of.M))));
  const double dt = 0.01 / steps;
  for (int s = 1; s <= samples; ++s) {
    double u = 0;
    for (int k = 0; k < steps; ++k) {
      for (int i = 1; i < cells; ++i) flow[i] = mobility * (p[i] - p[i - 1]) * i;
      flow[cells] = mobility * (0 - p[cells - 1]) * 2 * cells;
      double sum = 0;
      for (int i = 0; i < cells; ++i) {
        strain[i] += S * p[i] + dt * (flow[i + 1] - flow[i]) / ((i + 0.5) * dr * dr);  // eps + S p of the end
        sum += strain[i] * (i + 0.5) * dr * dr / R;
      }
      u = (sum - S * start * R / 2) / (1 + S * of.M - S * of.G);
      const double f = -start + 2 * of.G * u / R;
      for (int i = 0; i < cells; ++i) {
        strain[i] = (strain[i] + S * f) / (1 + S * of.M);
        p[i] = of.M * strain[i] - f;
      }
    }
    out.push_back({0.01 * s, p[0] + (p[0] - p[1]) / 8, u});
  }
  return out;
}

/// Slope of the line that fits best.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  double mean_x = 0, mean_y = 0, above = 0, below = 0;
  for (std::size_t i = 0; i < x.size(); ++i) mean_x += x[i] / x.size(), mean_y += y[i] / x.size();
  for (std::size_t i = 0; i < x.size(); ++i) {
    above += (x[i] - mean_x) * (y[i] - mean_y);
    below += (x[i] - mean_x) * (x[i] - mean_x);
  }
  return above / below;
}

}  // namespace

TEST_CASE("The reference of the Mandel-Cryer effect: its limits, and the numbers of the case") {
  // In the end the bag has swelled freely: M eps = f, eps = 2 u/R, so that u = -start R / (2 (M - G)).
  const Skeleton soft = skeleton(1e6, 0.1);
  CHECK(consolidate(soft, 20, 20).back().moved == near(-start * R / (2 * (soft.M - soft.G)), 1e-3));
  // A fluid skeleton, G = 0, has no such effect: p follows the diffusion equation alone, J0 (Carslaw & Jaeger 1959).
  const Skeleton fluid{1e6, 0};
  const double T = 0.2, b = 2.404825557695773, J1 = 0.5191474972894669, b2 = 5.520078110286311,
               J1_2 = -0.3402648065583682;
  const double exact = 2 / (b * J1) * std::exp(-b * b * T) + 2 / (b2 * J1_2) * std::exp(-b2 * b2 * T);
  const double at = T * R * R / (mobility * fluid.M);
  const auto free = consolidate(fluid, 100, std::ceil(at * 100) / 100, 1e-12);
  const double part = std::exp(-b * b * mobility * fluid.M / (R * R) * (free.back().t - at));
  CHECK(free.back().centre / start == near(exact * part, 2e-3));

  std::vector<double> time, area, centre;
  for (const auto& [t, p, u] : consolidate(soft, 100, 0.5)) {
    if (t > 0.095 && t < 0.305) centre.push_back(p);
    if (t < 0.195) continue;
    time.push_back(t);
    area.push_back(std::numbers::pi * (R + u) * (R + u));
  }
  double mean = 0;
  for (const double p : centre) mean += p / static_cast<double>(centre.size());
  CHECK(mean / start > 1.15);
  const Scene scene = read_scene(source_path("cases/verification/mandel.toml"));
  const double K = 1000 * 200.0 * 200.0, still = K * (std::exp(1000 * 9.81 * 1.4 / K) - 1);
  CHECK(scene.verify.at(0).expected == near(still + mean, 1e-4));
  CHECK(scene.verify.at(1).expected == near(slope(time, area), 1e-3));
}
