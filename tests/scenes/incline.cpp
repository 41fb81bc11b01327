// Blocks and discs on inclined rigid surfaces against rigid-body mechanics, bare and with a skin.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop::test;

namespace {

constexpr double g = 9.81, degree = std::numbers::pi / 180;

enum class Cover { skin, bare };

std::string to_toml(double x, double y) { return "[" + std::to_string(x) + "," + std::to_string(y) + "]"; }

/// The point `along` down a slope through the origin and `over` it [m].
std::string on_slope(double angle, double along, double over) {
  const double c = std::cos(angle * degree), s = std::sin(angle * degree);
  return to_toml(along * c + over * s, -along * s + over * c);
}

/// Settings that turn a case of a slope of 30 degrees; `shape` as the scene has it.
std::vector<std::string> turned(const std::string& body, double angle, double friction, const std::string& shape,
                                Cover cover) {
  const std::string touching = cover == Cover::skin ? "skin" : body;
  std::vector<std::string> settings{
      "results=[]",
      "expect=[]",
      "verify=[]",
      "variants=[]",
      "bodies." + body + ".shape=" + shape,
      "rigid.slope.shape.normal=" + to_toml(std::sin(angle * degree), std::cos(angle * degree)),
      "contacts=[{between=['slope','" + touching + "'],friction=" + std::to_string(friction) + "}]"};
  if (cover == Cover::bare) settings.push_back("membranes=[]");
  return settings;
}

std::string block_shape(double angle) {
  const auto corner = [&](double along, double over) { return on_slope(angle, along, over); };
  return "{type='polygon',points=[" + corner(-1, 0) + "," + corner(1, 0) + "," + corner(1, 0.5) + "," +
         corner(-1, 0.5) + "]}";
}

std::string disc_shape(double angle) {
  return "{type='ellipse',centre=" + on_slope(angle, 0, 0.5) + ",semi_axes=[0.5,0.5]}";
}

struct Slide {
  double acceleration = 0;  ///< down the slope, least squares from `from` on [m/s2]
  double velocity = 0;      ///< mean of the same rows [m/s]
  double chatter = 0;       ///< standard deviation of the normal force over its mean, the same rows [-]
  double weight = 0;        ///< mean of the normal force [N/m]
  double turn = 0;          ///< clockwise, at the end [rad]
};

Slide slide(const SceneRun& run, const std::string& body, double angle, Cover cover, double from) {
  const std::string touching = cover == Cover::skin ? "skin" : body;
  const auto t = run.column("time_s"), vx = run.column(body + ".velocity_x_m_s"),
             vy = run.column(body + ".velocity_y_m_s"), force = run.column(touching + ".slope.normal_force_N_m");
  double n = 0, st = 0, sv = 0, stt = 0, stv = 0, sf = 0, sff = 0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    if (t[k] < from) continue;
    const double v = vx[k] * std::cos(angle * degree) - vy[k] * std::sin(angle * degree);
    n += 1;
    st += t[k];
    sv += v;
    stt += t[k] * t[k];
    stv += t[k] * v;
    sf += force[k];
    sff += force[k] * force[k];
  }
  const double turn = -degree * run.column(body + ".rotation_deg").back();
  return {(n * stv - st * sv) / (n * stt - st * st), sv / n, std::sqrt(sff / n - sf * sf / n / n) / (sf / n), sf / n,
          turn};
}

Slide slide_block(double angle, double friction, Cover cover) {
  const SceneRun run("cases/block_on_incline.toml", turned("block", angle, friction, block_shape(angle), cover));
  REQUIRE(run.outcome().code == 0);
  return slide(run, "block", angle, cover, 0.4);
}

Slide roll_disc(double angle, Cover cover) {
  const SceneRun run("cases/disc_on_incline.toml", turned("disc", angle, 0.3, disc_shape(angle), cover));
  REQUIRE(run.outcome().code == 0);
  return slide(run, "disc", angle, cover, 0.2);
}

}  // namespace

TEST_CASE("A block on an incline slides and sticks as Coulomb says, bare and skinned, with an even normal force") {
  for (const Cover cover : {Cover::skin, Cover::bare})
    for (const double angle : {10.0, 20.0, 30.0, 45.0})
      for (const double friction : {0.3, 0.5}) {
        CAPTURE(static_cast<int>(cover));
        CAPTURE(angle);
        CAPTURE(friction);
        const double pull = g * (std::sin(angle * degree) - friction * std::cos(angle * degree));
        const Slide found = slide_block(angle, friction, cover);
        CHECK(std::abs(found.acceleration - std::max(0.0, pull)) < 0.0005 * g);  // asked for: 0.01 g
        if (pull < 0) CHECK(std::abs(found.velocity) < 2e-4);                    // asked for: 1e-3; 3e-5 measured
        CHECK(found.chatter < 0.15);  // asked for: 0.2; 0.093 measured at worst, at 45 degrees
        CHECK(found.weight == near(1600 * g * std::cos(angle * degree), 0.007));
      }
}

TEST_CASE("A disc rolls without sliding where tan(angle) is below 3 mu, and slides beyond") {
  for (const Cover cover : {Cover::skin, Cover::bare}) {
    CAPTURE(static_cast<int>(cover));
    for (const double angle : {10.0, 30.0}) {
      CAPTURE(angle);
      const double exact = g * std::sin(angle * degree) * 2 / 3;
      const Slide rolling = roll_disc(angle, cover);
      CHECK(std::abs(rolling.acceleration - exact) < 0.01 * g);
      // Without slip the turn is the way over the radius; 0.96 to 0.98 measured.
      CHECK(rolling.turn * 0.5 / (0.5 * exact * 0.8 * 0.8) == near(0.97, 0.02));
    }
    const double exact = g * (std::sin(50 * degree) - 0.3 * std::cos(50 * degree));
    const double spin = 2 * 0.3 * g * std::cos(50 * degree) / 0.5;  // mu m g cos R / (m R^2 / 2)
    const Slide sliding = roll_disc(50, cover);
    CHECK(std::abs(sliding.acceleration - exact) < 0.01 * g);
    CHECK(sliding.turn / (0.5 * spin * 0.8 * 0.8) == near(0.95, 0.02));  // of 1; the start takes some
  }
}

TEST_CASE("The shipped inclines meet what they expect") {
  for (const std::string scene : {"cases/block_on_incline.toml", "cases/disc_on_incline.toml"}) {
    const SceneRun run(scene, {}, {"--verify"});
    CAPTURE(run.outcome().out);
    CHECK(run.outcome().code == 0);
  }
}
