// Particles on the wrong side of a sharp membrane are put just beside it, on their own.
#include "cut/keep_sides.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "support/near.hpp"
#include "support/sharp_box.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double off = 1e-3;  // of a cell, 1 m

constexpr double dt = 0.1;

/// One particle of the water (field 0) or of the bag (field 1).
struct OneParticle : SharpBox {
  Body<2>& body;

  OneParticle(int field, double x, double y, Sense sense = Sense::anticlockwise)
      : SharpBox({}, sense), body(state.bodies[field]) {
    const std::string name = body.name;
    body = blank_body<2>(body.material, 1);
    body.name = name;
    body.field = field;
    body.mass[0] = 7;
    body.x = {Array<double>{x}, Array<double>{y}};
  }
};

/// Where it ends up.
Vec<2> kept(int field, double x, double y, Sense sense = Sense::anticlockwise, double h_finer = 1) {
  OneParticle box(field, x, y, sense);
  for (Grid<2>& grid : box.grids) grid.layout.finest *= h_finer;
  keep_sides(box.state, box.grids, dt);
  return vector_at(box.body.x, 0);
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

TEST_CASE("What shifted, and is put back, has the velocity of its field there") {
  OneParticle box(0, 2.9, 4);
  box.body.shift = true;
  box.body.v = {Array<double>{-0.5}, Array<double>{0.25}};
  box.body.affine = {Array<double>{0}, Array<double>{0}, Array<double>{3}, Array<double>{100}};  // 3 /s: dv_y/dx
  keep_sides(box.state, box.grids, dt);
  CHECK(box.body.v[0][0] == -0.5);
  CHECK(box.body.v[1][0] == near(0.25 + 3 * (2.75 - off - 2.9), 1e-14));
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
    keep_sides(box.state, box.grids, dt);
    CHECK(std::abs(water.x[0][0] - apex_x) < half / deep * (water.x[1][0] - apex_y));
    CHECK(water.x[1][0] == within(apex_y + s, 2 * off));
  }
}

TEST_CASE("On fine cells the distance is a thousandth of the finest") {
  check_at(kept(0, 2.9, 4, Sense::anticlockwise, 0.25), 2.75 - 0.25 * off, 4);
}

TEST_CASE("Nobody is put back beyond a wall that the membrane leans on") {
  OneParticle box(0, 5.6, 4);
  for (Grid<2>& grid : box.grids) grid.layout.upper[0] = 5.8 + off / 2;
  keep_sides(box.state, box.grids, dt);
  check_at(vector_at(box.body.x, 0), 5.8 + off / 2, 4);
}

TEST_CASE("A membrane that waits to be placed moves nobody") {
  SharpBox box;
  box.skin().field = waiting;
  Body<2>& water = box.state.bodies[0];
  water = blank_body<2>(water.material, 1);
  water.x = {Array<double>{2.9}, Array<double>{4}};
  keep_sides(box.state, box.grids, dt);
  CHECK(water.x[0][0] == 2.9);
}

TEST_CASE("Where two bags touch, water between them stays in the middle of their overlap, and out of both elsewhere") {
  SharpBox box;  // to x = 5.8 m
  box.scene.bodies.push_back(box.scene.bodies[1]);
  box.scene.bodies[2].name = "other bag";
  box.scene.membranes.push_back(box.scene.membranes[0]);
  box.scene.membranes[1].name = "other skin";
  box.scene.membranes[1].body = "other bag";
  box.grids = make_grids<2>(box.scene);
  for (Grid<2>& grid : box.grids) activate_all_blocks(grid);
  box.state.bodies.push_back(box.state.bodies[1]);
  box.state.bodies[2].name = "other bag";
  box.state.bodies[2].field = 2;
  const Membrane<2> first = box.skin();
  box.draw({.left = 5.7, .right = 8.3}, Sense::anticlockwise);
  Membrane<2> second = box.skin();
  second.name = "other skin";
  second.body = "other bag";
  second.field = 2;
  Body<2>& water = box.state.bodies[0];
  for (const bool swapped : {false, true}) {
    CAPTURE(swapped);
    box.state.membranes = {first, second};
    if (swapped) std::swap(box.state.membranes[0], box.state.membranes[1]);
    cut_interface_cells(box.state, box.grids);
    water = blank_body<2>(water.material, 5);
    const Array<double> at{5.77, 5.72, 5.6, 5.9, 2.8};
    water.x = {at, Array<double>(5, 4.5)};
    keep_sides(box.state, box.grids, dt);
    const double middle = (5.7 + 5.8) / 2;
    for (int p = 0; p < 4; ++p) {
      CAPTURE(at[p]);
      CHECK(water.x[0][p] == within(middle, 2 * off));
    }
    CHECK(water.x[0][4] == near(2.75 - off, 1e-14));
    CHECK(water.x[1] == Array<double>(5, 4.5));
  }
}

TEST_CASE("What has moved a particle through the membrane is taken from it and left to the nodes there") {
  struct Example {
    int field;
    double x;            ///< 0.15 m behind the left side of the bag, at x = 2.75 m
    double v, of_cloth;  ///< across it
    double dt;           ///< [s]
    double after;        ///< v then
  };
  const std::vector<Example> examples{
      {0, 2.90, 3, 0, 0.1, 1.5},                             // all that leads back in a step
      {0, 2.90, 3, 0, 0.01, 0},                              // not more than what leads to the membrane
      {0, 2.90, 3, 1, 0.01, 1},                              // which moves, too
      {0, 2.90, 3, 4, 0.01, 3},                              // and faster than the particle
      {0, 2.90, -3, 0, 0.01, -3},                            // on its way back
      {1, 2.60, -3, 0, 0.1, -1.5},                           // soil, outwards
      {1, 2.60, -3, -2, 0.01, -2}, {0, 2.70, 3, 0, 0.1, 3},  // on its side
  };
  for (const Sense sense : {Sense::anticlockwise, Sense::clockwise})
    for (const Example& example : examples) {
      CAPTURE(example.x);
      CAPTURE(example.v);
      CAPTURE(example.of_cloth);
      OneParticle box(example.field, example.x, 3.75, sense);
      Membrane<2>& skin = box.skin();
      std::fill(skin.v[0].begin(), skin.v[0].end(), example.of_cloth);
      skin.caught[0].assign(skin.nodes(), 5.0);  // of the step before
      box.set_mass(box.inside(), 1e15);
      box.body.v = {Array<double>{example.v}, Array<double>{4}};
      keep_sides(box.state, box.grids, example.dt);
      CHECK(box.body.v[0][0] == within(example.after, 1e-12));
      CHECK(box.body.v[1][0] == 4);
      const double given = box.body.mass[0] * (example.v - example.after);
      CHECK(std::accumulate(skin.caught[0].begin(), skin.caught[0].end(), 0.0) == within(given, 1e-12));
      CHECK(skin.caught[1] == Array<double>(skin.nodes(), 0.0));
      for (std::size_t k = 0; k < skin.nodes(); ++k)  // nodes at y = 3.5 m and 4.5 m, the particle between them
        if (skin.caught[0][k] != 0)
          CHECK(skin.caught[0][k] == near((skin.x[1][k] == 3.5 ? 0.75 : 0.25) * given, 1e-12));
    }
}

TEST_CASE("Light cloth, the water around that goes with it and what hits it go on as one, with the momentum of all") {
  for (const auto& [node_mass, of_water] : {std::pair{0.5, 0.0}, {20.0, 0.0}, {0.5, 3.0}}) {
    CAPTURE(node_mass);
    CAPTURE(of_water);
    OneParticle box(0, 2.9, 3.75);
    Membrane<2>& skin = box.skin();
    box.set_mass(box.inside(), node_mass);
    if (of_water > 0) {
      box.set_mass(box.around(), of_water);
      box.around().cell_volume.assign(box.around().cell_volume.size(), 1.0);
    }
    box.body.v = {Array<double>{3}, Array<double>{0}};
    keep_sides(box.state, box.grids, 0.01);
    // Splines over nodes of a metre at x = 2.75 m, a quarter off the node, and 3.75 m: sum N^2 = (sum of squares)^2.
    const double squares = 0.28125 * 0.28125 + 0.6875 * 0.6875 + 0.03125 * 0.03125;
    const double cloth = (node_mass + of_water) / (squares * squares), both = 7 * 3 / (7 + cloth);
    CHECK(box.body.v[0][0] == near(both, 1e-12));
    CHECK(std::accumulate(skin.caught[0].begin(), skin.caught[0].end(), 0.0) == near(cloth * both, 1e-11));
  }
}

TEST_CASE("Momentum of particles and membrane stays as it is put back, for many particles on any number of threads") {
  SharpBox box;
  box.set_mass(box.inside(), 100);
  constexpr int many = 9000;  // three parts of a body
  Body<2>& water = box.state.bodies[0];
  water = blank_body<2>(water.material, many);
  Random random(3);
  for (int p = 0; p < many; ++p) {
    water.mass[p] = random.uniform(1, 2);
    for (int a = 0; a < 2; ++a) {
      water.x[a][p] = random.uniform(2, 7);
      water.v[a][p] = random.uniform(-5, 5);
    }
  }
  const auto momentum = [&](int a) {
    return std::inner_product(water.mass.begin(), water.mass.end(), water.v[a].begin(), 0.0);
  };
  const Vec<2> before(momentum(0), momentum(1));
  keep_sides(box.state, box.grids, dt);
  double taken = 0;
  for (int a = 0; a < 2; ++a) {
    const Array<double>& caught = box.skin().caught[a];
    CHECK(momentum(a) + std::accumulate(caught.begin(), caught.end(), 0.0) == near(before[a], 1e-11));
    for (const double part : caught) taken += std::abs(part);
  }
  CHECK(taken > 100);
}
