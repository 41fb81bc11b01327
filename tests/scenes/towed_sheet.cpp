// The reference of towed_sheet: water of depth without end slides along a wall that rubs by tau = 1/2 rho C_f u^2, u
// its velocity there. Viscosity carries the loss away: u(t) = U - 1/rho int tau(s) / sqrt(pi nu (t - s)) ds (Carslaw &
// Jaeger 1959, 2.9). The tension of one face is tau times the length of water beyond a point; the water moves with U.
#include "support/near.hpp"
#include "support/scene_files.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace geodrop;
using geodrop::test::near;

namespace {

/// Water along a wall, at the start of unit velocity [m/s].
struct Rubbed {
  double friction, viscosity;  ///< C_f, nu [m2/s]
};

/// Velocity at the wall after each of the steps: the kernel exactly, u^2 constant over each step, from its ends.
std::vector<double> wall_velocity(const Rubbed& water, double dt, int steps) {
  std::vector<double> u{1.0};
  const double scale = 0.5 * water.friction / std::sqrt(std::numbers::pi * water.viscosity);
  for (int n = 1; n <= steps; ++n) {
    double sum = 0;
    for (int s = 0; s < n; ++s) {
      const double mean = s + 1 < n ? 0.5 * (u[s] + u[s + 1]) : u[s];
      sum += 2 * (std::sqrt((n - s) * dt) - std::sqrt((n - s - 1) * dt)) * mean * mean;
    }
    u.push_back(1 - scale * sum);
  }
  return u;
}

}  // namespace

TEST_CASE("Little friction: the water at the wall loses C_f sqrt(t / (pi nu)) of its velocity") {
  const Rubbed water{1e-6, 0.05};
  CHECK(1 - wall_velocity(water, 1e-3, 400).back() ==
        near(water.friction * std::sqrt(0.4 / (std::numbers::pi * water.viscosity)), 5e-6));
}

TEST_CASE("The tensions that towed_sheet is measured by") {
  const Scene scene = read_scene(source_path("cases/verification/towed_sheet.toml"));
  const double friction = scene.membranes[0].wall_friction, dt = 5e-4, from = 0.18;
  const auto& slab = std::get<BoxShape>(scene.bodies[0].shape);
  const std::vector<double> u = wall_velocity({friction, 0.05}, dt, 1000);
  const auto tension = [&](double x) {
    double sum = 0;
    int count = 0;
    for (std::size_t n = 0; n < u.size(); ++n) {
      const double t = dt * static_cast<double>(n), tau = 0.5 * 1000 * friction * u[n] * u[n];
      if (t < from - 0.5 * dt) continue;
      sum += tau * (slab.upper[0] + t - std::max(x, slab.lower[0] + t));
      ++count;
    }
    return sum / count;
  };
  for (const VerifySpec& verify : scene.verify) {
    const double x = verify.result == "middle_N_m" ? 1.0 : verify.result == "downstream_N_m" ? 1.5 : 0.25;
    CHECK(verify.expected == near(tension(x), 1e-4));
  }
}
