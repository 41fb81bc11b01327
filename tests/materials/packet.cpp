// Packets: each lane gives what the scalar gives.
#include "element.hpp"

#include <doctest/doctest.h>

#include "support/near.hpp"

namespace {

using namespace geodrop;
using namespace geodrop::test;

using Lanes = std::array<double, packet_width>;

Packet pack(const Lanes& lanes) { return load<Packet>(lanes.data()); }
Lanes unpack(const Packet& packet) {
  Lanes lanes;
  store(lanes.data(), packet);
  return lanes;
}

/// Applies `update(dL, dvol, stress)` to a packet of random states and to its lanes one by one, and returns the
/// largest difference [Pa].
template <int Dim, class Law>
double lane_difference(const Law& law, Dice& dice) {
  constexpr int N = stress_components<Dim>;
  std::array<Lanes, Dim * Dim> dL;
  std::array<Lanes, N> stress;
  Lanes dvol;
  for (int lane = 0; lane < packet_width; ++lane) {
    for (auto& component : dL) component[lane] = 0.02 * dice.normal();
    for (auto& component : stress) component[lane] = 8e3 * (dice.normal() - 0.3);
    dvol[lane] = 0.01 * dice.normal();
  }
  Gradient<Dim, Packet> wide_dL;
  Stress<Dim, Packet> wide;
  for (int k = 0; k < Dim * Dim; ++k) wide_dL[k] = pack(dL[k]);
  for (int k = 0; k < N; ++k) wide[k] = pack(stress[k]);
  update_stress<Dim, Packet>(law, wide_dL, pack(dvol), wide);
  double worst = 0;
  for (int lane = 0; lane < packet_width; ++lane) {
    Gradient<Dim, double> one_dL;
    Stress<Dim, double> one;
    for (int k = 0; k < Dim * Dim; ++k) one_dL[k] = dL[k][lane];
    for (int k = 0; k < N; ++k) one[k] = stress[k][lane];
    update_stress<Dim, double>(law, one_dL, dvol[lane], one);
    for (int k = 0; k < N; ++k) worst = std::max(worst, std::abs(unpack(wide[k])[lane] - one[k]));
  }
  return worst;
}

}  // namespace

TEST_CASE("Packet functions do lane by lane what the scalar functions do") {
  const Lanes a{-2, -1, -0.5, 0, 0.25, 1, 4, 9}, b{1, -3, 2, 0, 0.5, -1, 3, 10};
  const Lanes sum = unpack(pack(a) + 2.0 * pack(b)), product = unpack(pack(a) * pack(b) - pack(b));
  const Lanes quotient = unpack(1.0 / pack(a)), negative = unpack(-pack(a));
  const Lanes lesser = unpack(min(pack(a), pack(b))), greater = unpack(max(pack(a), pack(b)));
  const Lanes size = unpack(abs(pack(a))), root = unpack(sqrt(abs(pack(a))));
  const Lanes chosen = unpack(select((pack(a) < pack(b)) & (pack(a) >= 0.0), pack(a), 7.0));
  const Lanes either = unpack(select((pack(a) > 1.0) | (pack(a) <= -1.0), 1.0, 0.0));
  for (int k = 0; k < packet_width; ++k) {
    CAPTURE(k);
    CHECK(sum[k] == a[k] + 2 * b[k]);
    CHECK(product[k] == a[k] * b[k] - b[k]);
    CHECK(quotient[k] == 1 / a[k]);
    CHECK(negative[k] == -a[k]);
    CHECK(lesser[k] == std::min(a[k], b[k]));
    CHECK(greater[k] == std::max(a[k], b[k]));
    CHECK(size[k] == std::abs(a[k]));
    CHECK(root[k] == std::sqrt(std::abs(a[k])));
    CHECK(chosen[k] == (a[k] < b[k] && a[k] >= 0 ? a[k] : 7));
    CHECK(either[k] == (a[k] > 1 || a[k] <= -1 ? 1 : 0));
  }
}

TEST_CASE("The logarithm of a packet is that of each lane, over all magnitudes") {
  Dice dice;
  for (int repeat = 0; repeat < 2000; ++repeat) {
    Lanes a;
    for (double& value : a)
      value = repeat % 2 ? std::exp(dice.uniform(-700, 700)) : 1 + dice.normal() * std::pow(10, -dice.uniform(1, 16));
    const Lanes logarithm = unpack(log(pack(a)));
    for (int k = 0; k < packet_width; ++k) {
      CAPTURE(a[k]);
      const double expected = std::log(a[k]);
      CHECK(std::abs(logarithm[k] - expected) <= 4e-16 * std::max(std::abs(expected), std::abs(a[k] - 1)));
    }
  }
  const Lanes edge = unpack(log(pack({1.0, 0.0, -2.0, std::nan(""), 2.0, 0.5, 4.0, 1e300})));
  CHECK(edge[0] == 0);
  for (const int k : {1, 2, 3}) CHECK(std::isnan(edge[k]));
  CHECK(edge[4] == near(std::log(2.0), 1e-12));
  CHECK(std::isnan(geodrop::log(-1.0)));
}

TEST_CASE("A mask is true somewhere if one lane is, whichever") {
  for (int lane = 0; lane < packet_width; ++lane) {
    Lanes values{};
    values[lane] = 1;
    CHECK(any_lane(pack(values) > 0.5));
    CHECK_FALSE(any_lane(pack(values) > 1.5));
  }
}

TEST_CASE("The laws give each lane the scalar stress") {
  Dice dice;
  // Only fused multiply-add may differ between packet and scalar: none in the baseline build, so mostly 0.
  const double round_off = 1e-9;  // of 1e4 Pa: 1e-13
  const LinearElastic elastic{1000, 1e6, 6e5};
  const MohrCoulomb yielding = soil({1e6, 0.3, 1000, 30, 10, 500});
  for (int repeat = 0; repeat < 300; ++repeat) {
    CHECK(lane_difference<2>(elastic, dice) < round_off);
    CHECK(lane_difference<3>(elastic, dice) < round_off);
    CHECK(lane_difference<2>(yielding, dice) < round_off);
    CHECK(lane_difference<3>(yielding, dice) < round_off);
  }
}
