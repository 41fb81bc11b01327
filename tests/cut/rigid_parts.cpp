// What rigid bodies have of cells and splines, and water that rests beside them.
#include "cut/rigid_parts.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "contact/rigid_surface.hpp"
#include "cut/cells_around.hpp"
#include "grid/cell_pressure.hpp"
#include "support/near.hpp"
#include "support/water_at_plane.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// The water to the right of a plane through (x, 0) whose foot leans by `lean` [m] over its depth of 1 m.
std::vector<std::string> leaning(double x, double lean) {
  const auto text = [](double value) { return std::to_string(value); };
  return {"rigid.paddle.shape.point=[" + text(x) + ",0]", "rigid.paddle.shape.normal=[1," + text(-lean) + "]",
          "bodies.water.shape={type=\"polygon\",points=[[" + text(x) + ",0],[6,0],[6,1],[" + text(x + lean) + ",1]]}"};
}

}  // namespace

TEST_CASE("A plane along the grid has its exact share of each cell, and shares of splines add up to its area") {
  for (const double x : {0.5, 0.53, 0.61}) {
    CAPTURE(x);
    const WaterAtPlane it(at(x));
    const double h = it.grid.layout.h;
    double cells = 0;
    for (int i = 3; i <= 6; ++i) {
      const double share = std::clamp(x / h - (i - 0.5), 0.0, 1.0);
      CHECK(it.cell(i, 4) == within(share, 1e-12));
      CHECK(it.cell(i, 0) == within(share, 1e-12));
      cells += share;
    }
    // All splines of a row hold the area of its cells: those of nodes 2 and 3, whole but for what nodes 4 to 6 have.
    double splines = 0;
    for (int i = 2; i <= 8; ++i) splines += it.spline(i, 4) / (h * h);
    CHECK(splines == near(1 + cells, 1e-9));
  }
}

TEST_CASE("Cells that the surface cuts have a pressure, and shift as their neighbours do") {
  WaterAtPlane it(at(0.53));
  it.run_until("particles_to_grid");
  const auto flags = [&](int i, int j) { return it.grid.cell_flags[it.grid.layout.index({i, j})]; };
  CHECK((flags(4, 3) & cell_filled) != 0);
  CHECK((flags(4, 3) & cell_shiftable) != 0);
  CHECK((flags(5, 3) & cell_filled) != 0);
  CHECK((flags(5, 3) & cell_shiftable) != 0);
  // Without the plane that is a free surface.
  std::fill(it.grid.rigid_cells.begin(), it.grid.rigid_cells.end(), 0.0);
  average_cell_pressure(it.state, it.grid, true);
  CHECK((flags(5, 3) & cell_shiftable) == 0);
}

TEST_CASE("Slopes over the parts of rigid bodies are those of polynomials that the splines reproduce") {
  // sum_i x_i grad N_i = I and sum_i x_i y_i grad N_i = (y, x): exact over the part of each cell, whose area and first
  // moments are known from a fine division of it.
  for (const auto& settings : {at(0.53), leaning(0.8, 0.37), leaning(1.3, -0.9)}) {
    const WaterAtPlane it(settings);
    const GridLayout<2>& layout = it.grid.layout;
    const RigidSurface surface(it.state.rigid[0]);
    REQUIRE(it.grid.rigid_parts.size() > 20);
    for (const RigidPart<2>& part : it.grid.rigid_parts) {
      const std::array<int, 2> cell = stored_cell(layout, part.flat);
      if (!far_from_walls<2>(layout, 1, cell)) continue;
      const Vec<2> middle(layout.node(0, cell[0] - layout.pad), layout.node(1, cell[1] - layout.pad));
      constexpr int n = 200;
      Vec<3> exact = Vec<3>::Zero();  // area, moments of x and y
      for (int k = 0; k < n * n; ++k) {
        const Vec<2> x = middle + layout.h * Vec<2>((k % n + 0.5) / n - 0.5, (k / n + 0.5) / n - 0.5);
        if (surface.gap(x, 0)->size < 0) exact += layout.h * layout.h / (n * n) * Vec<3>(1, x[0], x[1]);
      }
      const double tolerance = 0.004 * layout.h * layout.h;
      Vec<2> sum = Vec<2>::Zero(), of_xy = Vec<2>::Zero();
      Eigen::Matrix2d of_x = Eigen::Matrix2d::Zero();
      for (int k = 0; k < nodes_around<2>; ++k) {
        const std::array<int, 2> node = stored_cell(layout, node_around(layout, part.flat, k));
        const Vec<2> x(layout.node(0, node[0] - layout.pad), layout.node(1, node[1] - layout.pad));
        const Vec<2> slope(part.slope[k].data());
        sum += slope;
        of_x += x * slope.transpose();
        of_xy += x[0] * x[1] * slope;
      }
      CAPTURE(middle.transpose());
      CHECK(sum.norm() < 1e-13);
      CHECK((of_x - exact[0] * Eigen::Matrix2d::Identity()).norm() < tolerance);
      CHECK(std::abs(of_x(0, 1)) + std::abs(of_x(1, 0)) < 1e-13);
      CHECK((of_xy - Vec<2>(exact[2], exact[1])).norm() < 3 * tolerance);
      CHECK(it.grid.rigid_cells[part.flat] * layout.h * layout.h == near(of_x(0, 0), 1e-9));
    }
  }
}

TEST_CASE(
    "Water laid in beside a rigid plane starts in equilibrium: pressures of cut cells, contact and weight balance") {
  // With the weight of the particles nodes of small mass start with up to a tenth of g.
  for (const auto& settings : {at(0.5), at(0.53), at(0.61)}) {
    WaterAtPlane it(settings);
    constexpr double dt = 1e-4;
    it.run_until("volume_rate", dt);
    const GridLayout<2>& layout = it.grid.layout;
    const double light = 0.02 * 1000 * layout.h * layout.h;
    double most = 0;
    for (int j = 3; j <= 5; ++j)
      for (int i = 2; i <= 12; ++i) {
        const int node = layout.index({i, j});
        if (it.grid.sum[node][3] < 5 * light) continue;
        most = std::max(most, std::hypot(it.grid.velocity_change[node][0], it.grid.velocity_change[node][1]) / dt);
      }
    CHECK(most < 0.01 * 9.81);
  }
}

TEST_CASE(
    "Water that flattens against a soft surface keeps a width beside the depth that its pressure pressed it in by") {
  std::vector<std::string> settings = at(0.53);
  settings.push_back("contacts.0.stiffness=0.005");
  WaterAtPlane it(settings);
  RigidContact<2>& contact = it.state.rigid_contacts[0];
  int deep = 0;
  for (std::size_t id = 0; id < contact.reach.size(); ++id)
    if (contact.pressed_in[id] > 0.5 * contact.reach[id]) ++deep;
  REQUIRE(deep > 10);
  Body<2>& water = it.state.bodies[0];
  constexpr double dt = 1e-3;
  for (int step = 0; step < 100; ++step) {
    for (std::size_t p = 0; p < water.size(); ++p) water.v[0][p] = -100 * (water.x[0][p] - 0.53);
    it.run_until("interface_force", dt);
  }
  for (std::size_t id = 0; id < contact.reach.size(); ++id) CHECK(contact.half_width[id] > contact.pressed_in[id]);
}
