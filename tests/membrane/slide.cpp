// Cloth that slides: closed forms of stick, slip and slack, and random lines beside a minimiser of another kind.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "membrane/slide.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double stiffness = 1e6;  ///< [N/m]

/// Segments of 0.1 m with no tension.
Cloth unstrained(std::size_t segments, bool closed, double friction) {
  Cloth cloth;
  cloth.resize(segments, closed);
  cloth.stiffness = stiffness;
  std::fill(cloth.length.begin(), cloth.length.end(), 0.1);
  std::fill(cloth.rest.begin(), cloth.rest.end(), 0.1);
  std::fill(cloth.friction.begin(), cloth.friction.end(), friction);
  std::fill(cloth.drag.begin(), cloth.drag.end(), 0.02);  // next to none
  return cloth;
}

/// Lengths, friction and loads at random, with parts that are slack and nodes without friction.
Cloth random_cloth(std::size_t segments, bool closed, Random& random) {
  Cloth cloth = unstrained(segments, closed, 0);
  for (std::size_t s = 0; s < segments; ++s) {
    cloth.length[s] = random.uniform(0.05, 0.2);
    cloth.rest[s] = cloth.length[s] * random.uniform(0.97, 1.02);
  }
  for (std::size_t k = 0; k < cloth.nodes(); ++k) {
    cloth.friction[k] = std::max(0.0, random.uniform(-2000, 8000));
    cloth.load[k] = random.uniform(-1000, 1000);
    cloth.drag[k] = 1e4;
  }
  return cloth;
}

double tension_of(const Cloth& cloth, std::size_t s) {
  return std::max(0.0, cloth.stiffness * (cloth.length[s] / cloth.rest[s] - 1));
}

/// The same minimum by the multipliers: |T_k - T_(k-1) + g_k - z_k q_k| <= F_k is met by relaxation of q with a small
/// fixed step, as in a dynamic relaxation with friction. Slow and simple.
std::vector<double> tensions_by_relaxation(Cloth cloth) {
  const std::vector<double> old = cloth.rest;
  const std::size_t n = cloth.segments(), nodes = cloth.nodes();
  const auto behind = [&](std::size_t k) { return k == 0 ? n - 1 : k - 1; };
  const std::size_t first = cloth.closed ? 0 : 1, end = cloth.closed ? n : n - 1 + 1;
  std::vector<double> q(nodes, 0.0);
  const double step = 0.4 * 0.04 / (2 * stiffness * 0.2 * 2);  // of 1 / the largest curvature
  for (int round = 0; round < 300000; ++round) {
    for (std::size_t k = first; k < end && k < nodes; ++k) {
      if (!cloth.closed && k == n) continue;
      const double pull = tension_of(cloth, k) - tension_of(cloth, behind(k)) + cloth.load[k] - cloth.drag[k] * q[k];
      const double moved = q[k] + step * pull, limit = step * cloth.friction[k];
      q[k] = moved > limit ? moved - limit : moved < -limit ? moved + limit : 0;
    }
    for (std::size_t s = 0; s < n; ++s) cloth.rest[s] = old[s] + q[s] - q[cloth.closed && s + 1 == n ? 0 : s + 1];
  }
  std::vector<double> tension;
  for (std::size_t s = 0; s < n; ++s) tension.push_back(tension_of(cloth, s));
  return tension;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

TEST_CASE("Cloth below its friction sticks, to the bit") {
  Cloth cloth = unstrained(20, true, 600);
  for (std::size_t s = 0; s < 20; ++s) cloth.length[s] = s % 2 == 0 ? 0.1 : 0.10005;  // tension 0 and 500 N/m
  const std::vector<double> before = cloth.rest;
  CHECK(ClothSlide().solve(cloth));
  CHECK(cloth.rest == before);
  CHECK(*std::max_element(cloth.passed.begin(), cloth.passed.end()) == 0);
}

TEST_CASE("A pull at one node is handed to what is below at the rate of friction, node by node; ahead it is slack") {
  constexpr double friction = 300, pull = 2000;
  Cloth cloth = unstrained(30, false, friction);
  cloth.load[20] = pull;
  CHECK(ClothSlide().solve(cloth));
  double drawn = 0;  // rest length that has come from behind
  for (std::size_t s = 0; s < 30; ++s) {
    const double expected = s < 20 ? std::max(0.0, pull - friction * static_cast<double>(20 - s)) : 0.0;
    CHECK(tension_of(cloth, s) == within(expected, stiffness * 1e-9));
    if (s < 20) drawn += 0.1 - 0.1 / (1 + expected / stiffness);
  }
  CHECK(cloth.passed[20] == near(drawn, 1e-6));
  CHECK(cloth.rest[20] == near(0.1 + drawn, 1e-9));
  CHECK(cloth.passed[13] == 0);  // 2000 / 300: six nodes slide behind it
  CHECK(sum(cloth.rest) == near(3.0, 1e-15));
}

TEST_CASE("Slack cloth without a load does not move") {
  Cloth cloth = unstrained(12, true, 0);
  for (std::size_t s = 0; s < 12; ++s) cloth.rest[s] = 0.1 + 0.01 * static_cast<double>(s);
  const std::vector<double> before = cloth.rest;
  CHECK(ClothSlide().solve(cloth));
  CHECK(cloth.rest == before);
}

TEST_CASE("Random cloth: the tensions of a slow relaxation, the friction never exceeded, rest length kept") {
  Random random(3);
  for (const bool closed : {true, false})
    for (int trial = 0; trial < 4; ++trial) {
      CAPTURE(closed);
      CAPTURE(trial);
      Cloth cloth = random_cloth(14, closed, random);
      const std::vector<double> expected = tensions_by_relaxation(cloth);
      const double length = sum(cloth.rest);
      CHECK(ClothSlide().solve(cloth));
      CHECK(sum(cloth.rest) == near(length, 1e-14));
      std::size_t sliding = 0;
      for (std::size_t s = 0; s < 14; ++s) CHECK(tension_of(cloth, s) == within(expected[s], 0.05));
      for (std::size_t k = 1; k < 14; ++k) {
        const double handed = tension_of(cloth, k) - tension_of(cloth, k - 1) + cloth.load[k];
        CHECK(std::abs(handed) <= cloth.friction[k] + cloth.drag[k] * std::abs(cloth.passed[k]) + 0.01);
        sliding += cloth.passed[k] != 0;
      }
      CHECK(sliding > 3);
      CHECK(sliding < 14);
    }
}

TEST_CASE("Long lines with a little friction converge") {
  Random random(5);
  for (const std::size_t segments : {200, 1000}) {
    Cloth cloth = random_cloth(segments, true, random);
    for (double& friction : cloth.friction) friction *= 0.01;
    CHECK(ClothSlide().solve(cloth));
    for (std::size_t k = 1; k < segments; ++k) {
      const double handed = tension_of(cloth, k) - tension_of(cloth, k - 1) + cloth.load[k];
      REQUIRE(std::abs(handed) <= cloth.friction[k] + cloth.drag[k] * std::abs(cloth.passed[k]) + 0.1);
    }
  }
}

TEST_CASE("Lines of a falling bag, noisy and partly slack, are solved from any tensions that they had before") {
  Random random(23);
  for (int trial = 0; trial < 60; ++trial) {
    CAPTURE(trial);
    constexpr std::size_t segments = 220;
    Cloth cloth = unstrained(segments, true, 0);
    const double noise = std::pow(10, random.uniform(-4, -1.5));
    for (std::size_t s = 0; s < segments; ++s) {
      cloth.length[s] = 0.0625 * (1 + random.uniform(-noise, noise));
      cloth.rest[s] = 0.0625 * (1 + (random.uniform(0, 1) < 0.1 ? 0.3 : 0.0));
      cloth.friction[s] = std::max(0.0, random.uniform(-50, 250));
      cloth.load[s] = random.uniform(-1, 1);
      cloth.drag[s] = 1600;
      cloth.tension[s] = std::max(0.0, random.uniform(-5000, 10000));
    }
    const double length = sum(cloth.rest);
    CHECK(ClothSlide().solve(cloth));
    CHECK(sum(cloth.rest) == near(length, 1e-13));
    for (std::size_t k = 1; k < segments; ++k) {
      const double handed = tension_of(cloth, k) - tension_of(cloth, k - 1) + cloth.load[k];
      REQUIRE(std::abs(handed) <= cloth.friction[k] + cloth.drag[k] * std::abs(cloth.passed[k]) + 0.01);
    }
  }
}

TEST_CASE("Without friction and loads the tension is J (L / L0 - 1) of the whole line, or 0 everywhere") {
  Random random(7);
  for (const bool closed : {true, false})
    for (const double slack : {0.98, 1.02}) {
      Cloth cloth = random_cloth(50, closed, random);
      std::fill(cloth.load.begin(), cloth.load.end(), 0.0);
      for (double& rest : cloth.rest) rest *= slack;
      const double rest = sum(cloth.rest), whole = std::max(0.0, stiffness * (sum(cloth.length) / rest - 1));
      slide_freely(cloth);
      for (std::size_t s = 0; s < 50; ++s) CHECK(tension_of(cloth, s) == within(whole, 1e-5));
      CHECK(sum(cloth.rest) == near(rest, 1e-14));
      if (!closed) CHECK(cloth.passed[50] == 0);
    }
}

TEST_CASE("Without friction, with loads: the minimum with a vanishing drag") {
  Random random(9);
  for (const bool closed : {true, false})
    for (const double slack : {0.97, 1.0}) {
      CAPTURE(closed);
      CAPTURE(slack);
      Cloth cloth = random_cloth(20, closed, random);
      for (double& rest : cloth.rest) rest *= slack;
      std::fill(cloth.friction.begin(), cloth.friction.end(), 0.0);
      for (std::size_t k = 0; k < 20; ++k)  // a drag per length, as its even share of the loads asks for
        cloth.drag[k] = 5 * (cloth.length[k] + cloth.length[k == 0 ? 19 : k - 1]);
      if (closed) {  // what turns the whole line would slide far
        const double mean = sum(cloth.load) / 20;
        for (double& load : cloth.load) load -= mean;
      }
      Cloth free = cloth;
      CHECK(ClothSlide().solve(cloth));
      slide_freely(free);
      for (std::size_t s = 0; s < 20; ++s) CHECK(tension_of(free, s) == within(tension_of(cloth, s), 1));
    }
}
