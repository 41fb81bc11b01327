// The membrane alone: tension of hand-made lines, and forces that are the derivative of its elastic energy.
#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>

#include "membrane/membrane_force.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double stiffness = 1e5;  ///< [N/m]

/// Nodes at `x`, rest length of every segment `rest`.
Membrane<2> membrane_at(const std::vector<std::array<double, 2>>& x, double rest, bool closed) {
  Membrane<2> m;
  m.closed = closed;
  m.axial_stiffness = stiffness;
  for (const auto& node : x)
    for (int a = 0; a < 2; ++a) m.x[a].push_back(node[a]);
  for (auto& v : m.v) v.assign(x.size(), 0.0);
  m.mass.assign(x.size(), 1.0);
  m.rest_length.assign(closed ? x.size() : x.size() - 1, rest);
  m.strain.assign(m.rest_length.size(), 0.0);
  m.tension.assign(m.rest_length.size(), 0.0);
  return m;
}

Membrane<2> straight(double stretch) {
  std::vector<std::array<double, 2>> x;
  for (int k = 0; k <= 10; ++k) x.push_back({0.6 * stretch * k, 0.8 * stretch * k});
  return membrane_at(x, 1, false);
}

Membrane<2> circle(int n, double radius, double strain) {
  std::vector<std::array<double, 2>> x;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    x.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  const double chord = 2 * radius * std::sin(std::numbers::pi / n);
  return membrane_at(x, chord / (1 + strain), true);
}

/// Energy that is stored: sum over segments of L0 J e^2 / 2 where the strain e is positive.
double energy(Membrane<2> m) {
  update_tension(m);
  double sum = 0;
  for (std::size_t s = 0; s < m.segments(); ++s)
    sum += m.rest_length[s] * m.axial_stiffness * std::pow(std::max(0.0, m.strain[s]), 2) / 2;
  return sum;
}

/// A crumpled line: some segments stretched, some slack, all rest lengths different.
Membrane<2> crumpled(bool closed, Random& random) {
  Membrane<2> m = circle(23, 2, 0.02);
  if (!closed) {
    m.closed = false;
    m.rest_length.pop_back();
    m.strain.pop_back();
    m.tension.pop_back();
  }
  for (auto& coordinates : m.x)
    for (double& c : coordinates) c += random.uniform(-0.05, 0.05);
  for (double& rest : m.rest_length) rest *= random.uniform(0.9, 1.1);
  return m;
}

}  // namespace

TEST_CASE("A straight stretched line has the tension J e, and only its ends are pulled, inwards") {
  Membrane<2> m = straight(1.03);
  update_tension(m);
  for (const double T : m.tension) CHECK(T == near(0.03 * stiffness, 1e-12));
  for (const double e : m.strain) CHECK(e == near(0.03, 1e-12));
  const auto force = membrane_forces(m);
  CHECK(force[0][0] == near(0.6 * 3000, 1e-12));
  CHECK(force[1][0] == near(0.8 * 3000, 1e-12));
  CHECK(force[0][10] == near(-0.6 * 3000, 1e-12));
  for (int k = 1; k < 10; ++k) CHECK(std::abs(force[0][k]) + std::abs(force[1][k]) < 1e-8);
}

TEST_CASE("A slack line has no tension and pulls nowhere, but its strain is told") {
  Membrane<2> m = straight(0.95);
  update_tension(m);
  for (const double T : m.tension) CHECK(T == 0);
  for (const double e : m.strain) CHECK(e == near(-0.05, 1e-12));
  for (const auto& component : membrane_forces(m))
    for (const double f : component) CHECK(f == 0);
}

TEST_CASE("The forces are the derivative of the elastic energy, slack or not") {
  Random random;
  for (const bool closed : {true, false})
    for (int trial = 0; trial < 4; ++trial) {
      CAPTURE(closed);
      Membrane<2> m = crumpled(closed, random);
      update_tension(m);
      const auto force = membrane_forces(m);
      constexpr double delta = 1e-7;  // of lengths of 0.5 m: truncation 1e-13, round-off 1e-9 of the energy's change
      double power = 0;
      Membrane<2> before = m, after = m;
      for (std::size_t k = 0; k < m.nodes(); ++k)
        for (int a = 0; a < 2; ++a) {
          const double v = random.uniform(-1, 1);
          power += force[a][k] * v;
          before.x[a][k] -= delta * v;
          after.x[a][k] += delta * v;
        }
      const double rate = (energy(after) - energy(before)) / (2 * delta);
      REQUIRE(std::abs(rate) > 100);
      CHECK(power == near(-rate, 1.5e-8));
    }
}

TEST_CASE("Forces of any membrane have no resultant and no torque") {
  Random random;
  Membrane<2> m = crumpled(true, random);
  update_tension(m);
  const auto f = membrane_forces(m);
  double fx = 0, fy = 0, torque = 0, size = 0;
  for (std::size_t k = 0; k < m.nodes(); ++k) {
    fx += f[0][k];
    fy += f[1][k];
    torque += m.x[0][k] * f[1][k] - m.x[1][k] * f[0][k];
    size += std::hypot(f[0][k], f[1][k]);
  }
  CHECK(std::abs(fx) < 1e-13 * size);
  CHECK(std::abs(fy) < 1e-13 * size);
  CHECK(std::abs(torque) < 1e-12 * size);
}

TEST_CASE("A circle under tension T presses inwards with T / R") {
  // Chords of a regular polygon: the resultant of two sides is 2 T sin(pi/n), exactly; T / R per length in the limit.
  const int n = 64;
  const double radius = 1.5;
  Membrane<2> m = circle(n, radius, 0.01);
  update_tension(m);
  const auto force = membrane_forces(m);
  const double T = 0.01 * stiffness, chord = 2 * radius * std::sin(std::numbers::pi / n);
  for (int k = 0; k < n; ++k) {
    const double radial = (force[0][k] * m.x[0][k] + force[1][k] * m.x[1][k]) / radius;
    const double tangential = (force[1][k] * m.x[0][k] - force[0][k] * m.x[1][k]) / radius;
    CHECK(radial == near(-2 * T * std::sin(std::numbers::pi / n), 1e-11));
    CHECK(radial / chord == near(-T / radius, 1e-11));
    CHECK(std::abs(tangential) < 1e-11 * T);
  }
}

TEST_CASE("A circle pressed inwards evenly loses its tension where it is slack only: nothing pushes outwards") {
  Membrane<2> m = circle(40, 1, -0.01);
  update_tension(m);
  for (const auto& component : membrane_forces(m))
    for (const double f : component) CHECK(f == 0);
}
