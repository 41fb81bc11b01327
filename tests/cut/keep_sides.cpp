// Particles on the wrong side of a sharp membrane are put just beside it, on their own.
#include "cut/keep_sides.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/near.hpp"
#include "support/sharp_box.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double off = 1e-3;  // of a cell, 1 m

/// Where a particle of the water (field 0) or of the bag (field 1) ends up.
Vec<2> kept(int field, double x, double y, Sense sense = Sense::anticlockwise, double h_finer = 1) {
  SharpBox box({}, sense);
  for (Grid<2>& grid : box.grids) grid.layout.finest *= h_finer;
  Body<2>& body = box.state.bodies[field];
  const std::string name = body.name;
  body = blank_body<2>(body.material, 1);
  body.name = name;
  body.field = field;
  body.x = {Array<double>{x}, Array<double>{y}};
  body.v = {Array<double>{3}, Array<double>{4}};
  keep_sides(box.state, box.grids);
  CHECK(body.v[0][0] == 3);
  CHECK(body.v[1][0] == 4);
  return vector_at(body.x, 0);
}

void check_at(const Vec<2>& x, double at_x, double at_y) {
  CHECK(x[0] == near(at_x, 1e-14));
  CHECK(x[1] == near(at_y, 1e-14));
}

}  // namespace

TEST_CASE("Who is on the right side stays where he is") {
  for (const Sense sense : {Sense::anticlockwise, Sense::clockwise}) {
    check_at(kept(0, 2.74, 4, sense), 2.74, 4);
    check_at(kept(1, 2.76, 4, sense), 2.76, 4);
    check_at(kept(0, 5.8001, 4.2, sense), 5.8001, 4.2);
    check_at(kept(1, 4.1, 6.2499, sense), 4.1, 6.2499);
    check_at(kept(1, 4.5, 4.5, sense), 4.5, 4.5);
    check_at(kept(0, 9, 9, sense), 9, 9);
  }
}

TEST_CASE(
    "Water inside goes to the nearest point of the membrane and a thousandth of a cell out, a bag's particle in") {
  for (const Sense sense : {Sense::anticlockwise, Sense::clockwise}) {
    check_at(kept(0, 2.9, 4, sense), 2.75 - off, 4);
    check_at(kept(0, 5.6, 4, sense), 5.8 + off, 4);
    check_at(kept(0, 4, 3.1, sense), 4, 2.75 - off);
    check_at(kept(0, 4, 6.1, sense), 4, 6.25 + off);
    check_at(kept(1, 2.6, 4, sense), 2.75 + off, 4);
    check_at(kept(1, 6.2, 4, sense), 5.8 - off, 4);
    check_at(kept(1, 4, 2.6, sense), 4, 2.75 + off);
    check_at(kept(1, 4, 6.4, sense), 4, 6.25 - off);
  }
}

TEST_CASE("At a corner the mean of both normals tells the sides apart") {
  const double diagonal = off / std::sqrt(2.0);
  check_at(kept(1, 2.6, 2.6), 2.75 + diagonal, 2.75 + diagonal);
  check_at(kept(1, 6.0, 6.45), 5.8 - diagonal, 6.25 - diagonal);
  check_at(kept(0, 2.6, 2.6), 2.6, 2.6);
}

TEST_CASE("Near the edge of a narrow fold the way out does not lead through its other flank") {
  // A slit from above, 0.2 m wide at the top of the bag and 1 m deep; water has strayed through its right flank.
  const double deep = 1, half = 0.1, apex_x = 4.5, apex_y = 5.25;
  for (const double s : {1e-4, 1e-3, 0.5}) {  // height over the lowest point
    CAPTURE(s);
    SharpBox box;
    box.draw({{2.75, 2.75},
              {5.8, 2.75},
              {5.8, 6.25},
              {apex_x + half, 6.25},
              {apex_x, apex_y},
              {apex_x - half, 6.25},
              {2.75, 6.25}});
    cut_interface_cells(box.state, box.grids);
    Body<2>& water = box.state.bodies[0];
    water = blank_body<2>(water.material, 1);
    water.x = {Array<double>{apex_x + half / deep * s + 1e-6}, Array<double>{apex_y + s}};
    keep_sides(box.state, box.grids);
    CHECK(std::abs(water.x[0][0] - apex_x) < half / deep * (water.x[1][0] - apex_y));
    CHECK(water.x[1][0] == within(apex_y + s, 2 * off));
  }
}

TEST_CASE("On fine cells the distance is a thousandth of the finest") {
  check_at(kept(0, 2.9, 4, Sense::anticlockwise, 0.25), 2.75 - 0.25 * off, 4);
}

TEST_CASE("A membrane that waits to be placed moves nobody") {
  SharpBox box;
  box.skin().field = waiting;
  Body<2>& water = box.state.bodies[0];
  water = blank_body<2>(water.material, 1);
  water.x = {Array<double>{2.9}, Array<double>{4}};
  keep_sides(box.state, box.grids);
  CHECK(water.x[0][0] == 2.9);
}
