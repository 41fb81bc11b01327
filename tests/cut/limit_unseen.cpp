// Fluids in cells that a sharp membrane cuts keep no velocity that their nodes do not see.
#include "cut/limit_unseen.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/near.hpp"
#include "support/sharp_box.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

const double sound = std::sqrt(box_bulk_modulus / box_density), most = 0.03 * sound;

/// Two particles of a body at a place, that part along x with `apart` from the grid, which moves with (2, -1) m/s.
struct Parting : SharpBox {
  Body<2>& body;

  Parting(int field, double x, double y, double apart) : body(state.bodies[field]) {
    for (Grid<2>& grid : grids) std::fill(grid.velocity.begin(), grid.velocity.end(), Vec4{2, -1, 0, 0});
    body = blank_body<2>(body.material, 2);
    body.field = field;
    body.x = {Array<double>{x, x}, Array<double>{y, y}};
    body.v = {Array<double>{2 + apart, 2 - apart}, Array<double>{-1, -1}};
    limit_unseen(state, grids);
  }
  void check(double apart) const {
    CHECK(body.v[0][0] == near(2 + apart, 1e-13));
    CHECK(body.v[0][1] == near(2 - apart, 1e-13));
    CHECK(body.v[1][0] == near(-1, 1e-13));
  }
};

}  // namespace

TEST_CASE("What parts faster than 0.03 of the speed of sound in a cut cell is slowed down to it") {
  Parting(0, 2.7, 4, 20).check(most);
  Parting(0, 6.1, 6.3, 20).check(most);
}

TEST_CASE("What the grid sees, what is slower, and who is in a cell of its own keep their velocities") {
  Parting(0, 2.7, 4, 0.99 * most).check(0.99 * most);
  Parting(0, 1.2, 4, 20).check(20);
  Parting(0, 9, 9, 20).check(20);
}

TEST_CASE("Soil is not slowed down: what its particles part with strains it") { Parting(1, 2.8, 4, 20).check(20); }

TEST_CASE("A fluid inside is slowed down in the cells of its membrane as one around") {
  SharpBox box;
  Body<2>& body = box.state.bodies[1];
  body = blank_body<2>(Newtonian{box_density, box_bulk_modulus, 0}, 1);
  body.field = 1;
  body.x = {Array<double>{2.8}, Array<double>{4}};
  body.v = {Array<double>{0}, Array<double>{-20}};
  limit_unseen(box.state, box.grids);
  CHECK(body.v[1][0] == near(-most, 1e-13));
}
