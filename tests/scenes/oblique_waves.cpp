// Plane waves of compression that meet a viscous boundary at an angle: what comes back as compression (P) and as shear
// (S), against the equations of the boundary (Lysmer & Kuhlemeyer 1969 with a = b = 1).
//
// A P wave of velocity 1 comes down along (sin theta, -cos theta). P goes back along (sin theta, cos theta) with p, S
// along (sin phi, cos phi), sin phi = (c_s / c_p) sin theta, with s along (cos phi, -sin phi). The displacement
// gradient of a plane wave v(t - n.x / c) is -v n^T / c; its stress follows.
#include <doctest/doctest.h>
#include <geodrop/step/pipeline.hpp>

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double first_y = 4, last_y = 52;  // where the waves are at the start [m]
constexpr double spread = 18;               // of the three by then: they go down at different speeds [m]

struct Reflected {
  double p, s;  ///< velocity over the incident one [-]
};

/// The ground of the scene.
struct Ground {
  LinearElastic law;
  double c_p = std::sqrt((law.bulk_modulus + 4 * law.shear_modulus / 3) / law.density);
  double c_s = std::sqrt(law.shear_modulus / law.density);
  double phi(double theta) const { return std::asin(c_s / c_p * std::sin(theta)); }
};

/// sigma_yy = rho c_p v_y and sigma_xy = rho c_s v_x at the edge, over rho c_p and rho c_s.
Reflected from_dashpots(const Ground& ground, double theta) {
  const double k = ground.c_s / ground.c_p, phi = ground.phi(theta);
  Eigen::Matrix2d of_reflected;
  of_reflected << std::cos(theta) + std::cos(2 * phi), -std::sin(phi) - k * std::sin(2 * phi),
      std::sin(theta) + k * std::sin(2 * theta), std::cos(phi) + std::cos(2 * phi);
  const Vec<2> of_incident(std::cos(theta) - std::cos(2 * phi), k * std::sin(2 * theta) - std::sin(theta));
  const Vec<2> solution = of_reflected.inverse() * of_incident;
  return {std::abs(solution[0]), std::abs(solution[1])};
}

/// v = 0 at the edge.
Reflected from_fixed_base(const Ground& ground, double theta) {
  const double phi = ground.phi(theta);
  return {std::abs(std::cos(theta + phi) / std::cos(theta - phi)),
          std::abs(std::sin(2 * theta) / std::cos(theta - phi))};
}

/// Three waves of the same period along x that go down at slightly different angles: together they fade to nothing at
/// `first_y` and `last_y`, while each is an exact solution.
struct Packet {
  static constexpr std::array<double, 3> amplitude{0.25e-3, 0.5e-3, 0.25e-3};  // [m/s]
  double across;                                                               ///< wave number along x [1/m]
  std::array<double, 3> down;                                                  ///< along y [1/m]

  Packet(double width, double theta) : across(2 * pi / width) {
    for (int j = 0; j < 3; ++j) down[j] = across / std::tan(theta) + (j - 1) * 2 * pi / (last_y - first_y);
  }
  double angle(int j) const { return std::atan2(across, down[j]); }
  /// What a law says of each wave, rms weighted by its divergence.
  Reflected mean(const Ground& ground, Reflected (*law)(const Ground&, double)) const {
    double p = 0, s = 0, all = 0;
    for (int j = 0; j < 3; ++j) {
      const Reflected one = law(ground, angle(j));
      const double weight = std::pow(amplitude[j] * std::hypot(across, down[j]), 2);
      p += weight * one.p * one.p;
      s += weight * one.s * one.s;
      all += weight;
    }
    return {std::sqrt(p / all), std::sqrt(s / all)};
  }
};

/// Velocity, its gradient and stress of the waves at one particle.
void add_wave(const Packet& packet, int j, const Ground& ground, std::size_t p, Body<2>& body) {
  const double middle = (first_y + last_y) / 2, length = std::hypot(packet.across, packet.down[j]);
  const Vec<2> k(packet.across, -packet.down[j]), n = k / length;
  const double phase = k.dot(vector_at(body.x, p) - Vec<2>(0, middle)), v = packet.amplitude[j] * std::cos(phase);
  const double lambda = ground.law.bulk_modulus - 2 * ground.law.shear_modulus / 3, mu = ground.law.shear_modulus;
  for (int a = 0; a < 2; ++a) {
    body.v[a][p] += v * n[a];
    for (int b = 0; b < 2; ++b) body.affine[2 * a + b][p] -= packet.amplitude[j] * std::sin(phase) * n[a] * k[b];
    body.stress[a][p] -= v / ground.c_p * (lambda + 2 * mu * n[a] * n[a]);
  }
  body.stress[2][p] -= v / ground.c_p * lambda;
  body.stress[3][p] -= v / ground.c_p * 2 * mu * n[0] * n[1];
}

struct Squares {
  double divergence = 0, rotation = 0;  ///< sums over the particles [1/s2]
  explicit Squares(const Body<2>& body) {
    for (std::size_t p = 0; p < body.size(); ++p) {
      divergence += std::pow(body.affine[0][p] + body.affine[3][p], 2);
      rotation += std::pow(body.affine[1][p] - body.affine[2][p], 2);
    }
  }
};

/// The waves after all of them have met the edge. P has divergence only, S rotation; S of the same frequency is c_p /
/// c_s shorter along its way, and as slower fills less of the height.
Reflected measure(const Ground& ground, const Packet& packet, State<2> state, const Scene& scene) {
  Body<2>& body = state.bodies[0];
  for (std::size_t p = 0; p < body.size(); ++p)
    for (int j = 0; j < 3; ++j)
      if (body.x[1][p] > first_y && body.x[1][p] < last_y) add_wave(packet, j, ground, p, body);
  const Squares before(body);
  const double theta = packet.angle(1), end = (last_y + spread) / (ground.c_p * std::cos(theta));
  Grids<2> grids = make_grids<2>(scene);
  Pipeline<2> pipeline = build_pipeline<2>(scene);
  while (state.t < end) advance(pipeline, state, grids);
  const Squares after(body);
  const double shorter = ground.c_p * std::cos(theta) / (ground.c_s * std::cos(ground.phi(theta)));
  return {std::sqrt(after.divergence / before.divergence),
          ground.c_s / ground.c_p * std::sqrt(shorter * after.rotation / before.divergence)};
}

struct Found {
  Reflected measured, expected;
};

/// `width` is a period along x [m]; waves about 12 m long along y.
Found waves(double degrees, const std::string& width, Reflected (*law)(const Ground&, double),
            std::vector<std::string> changes = {}) {
  for (const char* key : {"grid.upper.0=", "bodies.ground.shape.upper.0="}) changes.push_back(key + width);
  const Scene scene = read_scene(source_path("tests/scenes/oblique_waves.toml"), changes);
  const State<2> state = build_state<2>(scene);
  const Ground ground{std::get<LinearElastic>(state.bodies[0].material)};
  const Packet packet(std::stod(width), degrees * pi / 180);
  const Found found{measure(ground, packet, state, scene), packet.mean(ground, law)};
  MESSAGE(degrees, " degrees: P ", found.measured.p, " (", found.expected.p, "), S ", found.measured.s, " (",
          found.expected.s, ")");
  return found;
}

}  // namespace

TEST_CASE("Waves of compression at an angle leave through a viscous boundary but for what its equations say") {
  const std::vector<std::pair<double, std::string>> angles{{30, "21"}, {45, "12"}, {60, "7"}};
  for (const auto& [degrees, width] : angles) {
    const Found found = waves(degrees, width, from_dashpots, {"viscous_boundaries.base.to.0=" + width});
    CHECK(std::abs(found.measured.p - found.expected.p) < 0.012);  // at most 0.005; with h = 0.125 m 0.003
    CHECK(std::abs(found.measured.s - found.expected.s) < 0.012);  // at most 0.009; with h = 0.125 m 0.004
  }
}

TEST_CASE("A fixed base sends all of them back, as two waves") {
  const Found found = waves(45, "12", from_fixed_base, {"viscous_boundaries=[]", "grid.lower.1=0"});
  CHECK(found.measured.p == near(found.expected.p, 0.03));
  CHECK(found.measured.s == near(found.expected.s, 0.01));
}
