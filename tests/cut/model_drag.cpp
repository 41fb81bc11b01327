// The drag that an engineer adds, by hand: 1/2 rho C_d W |v| v on the wet faces that meet the motion.
#include "cut/model_drag.hpp"

#include <doctest/doctest.h>

#include <numeric>

#include "support/near.hpp"
#include "support/sharp_box.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double drag = 1.2, width = 3.05, height = 3.5;

/// The bag has two particles of 1 and 3 kg, with the mean velocity v.
SharpBox moving(double vx, double vy, Sense sense = Sense::anticlockwise) {
  SharpBox box({}, sense);
  Body<2> bag = blank_body<2>(LinearElastic{box_density, 2e6, 1e6}, 2);
  bag.name = "bag";
  bag.field = 1;
  bag.mass = {1, 3};
  bag.v = {Array<double>{vx + 3, vx - 1}, Array<double>{vy - 6, vy + 2}};
  box.state.bodies[1] = bag;
  box.skin().drag_coefficient = drag;
  box.skin().water_pressure.assign(box.skin().nodes(), 1.0);
  return box;
}

Vec<2> sum_of_loads(const Membrane<2>& m) {
  return {std::accumulate(m.load[0].begin(), m.load[0].end(), 0.0),
          std::accumulate(m.load[1].begin(), m.load[1].end(), 0.0)};
}

}  // namespace

TEST_CASE("A box that sinks is held up by 1/2 rho C_d W v^2, on its bottom alone, shared by the ends of each segment") {
  for (const Sense sense : {Sense::anticlockwise, Sense::clockwise}) {
    SharpBox box = moving(0, -2, sense);
    add_model_drag(box.state);
    const double traction = 0.5 * box_density * drag * 4;
    CHECK(sum_of_loads(box.skin())[1] == near(traction * width, 1e-12));
    CHECK(sum_of_loads(box.skin())[0] == near_zero(1e-9));
    const Membrane<2>& m = box.skin();
    for (std::size_t k = 0; k < m.nodes(); ++k) {
      if (m.x[1][k] > 3) CHECK(m.load[1][k] == 0);
      // The first segment from the left corner is 0.75 m long, the next one 1 m.
      if (m.x[1][k] < 3 && m.x[0][k] == 2.75) CHECK(m.load[1][k] == near(traction * 0.375, 1e-12));
      if (m.x[1][k] < 3 && m.x[0][k] == 3.5) CHECK(m.load[1][k] == near(traction * 0.875, 1e-12));
    }
  }
}

TEST_CASE("Across a slanting motion the width is that of the shadow, and the force is against the motion") {
  const Vec<2> v(1.5, -2);
  SharpBox box = moving(v[0], v[1]);
  add_model_drag(box.state);
  const double shadow = (height * 1.5 + width * 2) / 2.5;
  const Vec<2> expected = -0.5 * box_density * drag * shadow * v.norm() * v;
  for (int a = 0; a < 2; ++a) CHECK(sum_of_loads(box.skin())[a] == near(expected[a], 1e-12));
}

TEST_CASE("Drag adds to the loads that are there; dry parts, a waiting body and no coefficient have none") {
  SharpBox box = moving(0, -2);
  box.skin().load[1].assign(box.skin().nodes(), 7.0);
  add_model_drag(box.state);
  const double all = 0.5 * box_density * drag * 4 * width;
  CHECK(sum_of_loads(box.skin())[1] == near(all + 7.0 * static_cast<double>(box.skin().nodes()), 1e-12));
  SharpBox dry = moving(0, -2);
  dry.skin().water_pressure[dry.segment_at(4, 2.75)] = 0;  // 1 m of the bottom
  add_model_drag(dry.state);
  CHECK(sum_of_loads(dry.skin())[1] == near(all * (width - 1) / width, 1e-12));
  SharpBox waits = moving(0, -2), none = moving(0, -2);
  waits.skin().field = waiting;
  none.skin().drag_coefficient = 0;
  for (SharpBox* still : {&waits, &none}) {
    add_model_drag(still->state);
    CHECK(sum_of_loads(still->skin()).norm() == 0);
  }
}
