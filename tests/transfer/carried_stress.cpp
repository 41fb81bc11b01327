// What particles carry to the grid, by hand: minus volume times stress, of water that cavitates and of soil.
#include <doctest/doctest.h>

#include <cmath>

#include "materials/element.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "transfer/chunk_laws.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double density = 1000, K = 2e6, T = 1e5;

/// Four particles of 500 kg: squeezed, slightly opened, opened beyond the cut-off, opened far.
Body<2> water(double cutoff) {
  Body<2> body = blank_body<2>(Newtonian{density, K, 0, 0, cutoff}, 4);
  body.mass.assign(4, 500.0);
  body.J = {0.9, 1.04, 1.06, 2.0};
  return body;
}

ChunkStress<2> carried(const Body<2>& body, const std::array<double, 4>& own) {
  ChunkStress<2> out;
  carry_stress(body, 0, 4, own.data(), out);
  return out;
}

}  // namespace

TEST_CASE("Water carries V p, K (1/J - 1) or its tension cut-off") {
  const Body<2> body = water(T);
  const ChunkStress<2> out = carried(body, {1, 1, 1, 1});
  const double pressure[] = {K * (1 / 0.9 - 1), K * (1 / 1.04 - 1), -T, -T};
  for (int k = 0; k < 4; ++k) {
    const double volume = 0.5 * body.J[k];
    CHECK(out.volume[k] == near(volume, 1e-14));
    for (const int c : {0, 1}) CHECK(out.s[c][k] == near(volume * pressure[k], 1e-13));
    CHECK(out.s[3][k] == 0);
  }
}

TEST_CASE("Water without a cut-off pulls as far as it opens, and nothing where its cell carries the pressure") {
  const ChunkStress<2> out = carried(water(std::numeric_limits<double>::infinity()), {1, 1, 1, 0});
  CHECK(out.s[0][2] == near(0.5 * K * (1 - 1.06), 1e-13));
  CHECK(out.s[0][3] == 0);
  CHECK(carried(water(T), {1, 1, 0, 0}).s[1][2] == 0);
}

TEST_CASE("Soil carries its stress; where the cell has its mean, that of three components is taken out") {
  Body<2> body = blank_body<2>(LinearElastic{2000, K, 1e6}, 4);
  body.mass.assign(4, 500.0);
  for (auto& [c, value] : {std::pair{0, -3e3}, {1, -6e3}, {2, -9e3}, {3, 2e3}}) body.stress[c].assign(4, value);
  body.pore_pressure.assign(4, 700.0);
  const ChunkStress<2> out = carried(body, {1, 0, 1, 0});
  const double volume = 0.25;
  CHECK(out.s[0][0] == near(volume * (3e3 + 700), 1e-13));
  CHECK(out.s[1][0] == near(volume * (6e3 + 700), 1e-13));
  CHECK(out.s[0][1] == near(volume * (3e3 - 6e3), 1e-13));
  CHECK(out.s[1][1] == near_zero(1e-10 * volume));
  for (int k = 0; k < 4; ++k) CHECK(out.s[3][k] == near(-volume * 2e3, 1e-13));
}

TEST_CASE("Open voids bear nothing: soil that is pressed beside them carries what is between, on the volume of that") {
  const auto open_body = [](double cutoff) {
    Body<2> body = blank_body<2>(MohrCoulombWithVoids{soil({10e6, 0.3, 3e3, 30, 0, cutoff})}, 4);
    body.mass.assign(4, 800.0);  // of 1600 kg/m3: 0.5 m3 of soil
    body.J = {1, 2, 2, 4};
    body.gap = {0, std::log(2.0), std::log(2.0), std::log(4.0)};
    for (auto& [c, value] : {std::pair{0, 1e3}, {1, -6e3}, {2, -1e3}, {3, 500.0}}) body.stress[c].assign(4, value);
    body.pore_pressure.assign(4, 700.0);  // the water fills the voids
    return body;
  };
  const Body<2> cut = open_body(1e3);  // the apex is at 5196 Pa
  const ChunkStress<2> out = carried(cut, {1, 1, 0, 1});
  CHECK(out.s[1][0] == near(0.5 * (6e3 + 700), 1e-13));
  CHECK(out.s[1][1] == near(0.5 * 6e3 + 1.0 * 700, 1e-13));
  CHECK(out.s[0][1] == near(-0.5 * 1e3 + 1.0 * 700, 1e-13));
  CHECK(out.s[1][2] == near(0.5 * (6e3 - 2e3), 1e-13));
  CHECK(out.s[3][3] == near(-0.5 * 500, 1e-13));
  std::array<double, 4> volume, pressure;
  chunk_volumes(cut, 0, 4, volume.data(), pressure.data());
  CHECK(volume[1] == near(1, 1e-14));
  CHECK(pressure[0] == near(2e3 + 700, 1e-13));
  CHECK(pressure[1] == near(2e3 / 2 + 700, 1e-13));

  // At the apex there is one stress alone, the tensile strength of the whole; 5196 Pa are that, typed in.
  for (const double apex : {1e30, 5196.0})
    CHECK(carried(open_body(apex), {1, 1, 1, 1}).s[1][1] == near(1.0 * (6e3 + 700), 1e-13));
}
