// A rectangular bag with a sharp interface on a grid whose nodes are whole metres: cells reach from i - 1/2 to i + 1/2,
// and what the bag cuts off each can be worked out on paper.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "cut/interface_cells.hpp"
#include "support/random_particles.hpp"

namespace geodrop::test {

inline constexpr double box_density = 1000, box_bulk_modulus = 1e6;
inline constexpr int box_cells = 12;

struct Corners {
  double left = 2.75, right = 5.8, bottom = 2.75, top = 6.25;  ///< [m]
};

enum class Sense { anticlockwise, clockwise };

/// Water (field 0) around a bag of elastic soil (field 1); the bodies have no particles unless a test gives them some.
/// The membrane has a node at each corner and where it crosses from cell to cell.
struct SharpBox {
  Scene scene;
  State<2> state;
  Grids<2> grids;

  explicit SharpBox(const Corners& at = {}, Sense sense = Sense::anticlockwise, WallKind wall = WallKind::slip) {
    scene = box_scene<2>(box_cells, 1.0, wall, Transfer::blend);
    scene.materials = {{"water", NewtonianSpec{box_density, box_bulk_modulus, 0}, {}},
                       {"stuff", LinearElasticSpec{box_density, 1e6, 0.25}, {}}};
    scene.bodies.resize(2);
    scene.bodies[0].name = "pool";
    scene.bodies[0].material = "water";
    scene.bodies[1].name = "bag";
    scene.bodies[1].material = "stuff";
    MembraneSpec skin;
    skin.name = "skin";
    skin.body = "bag";
    skin.interface = Interface::sharp;
    scene.membranes = {skin};
    grids = make_grids<2>(scene);
    for (Grid<2>& grid : grids) activate_all_blocks(grid);
    state.bodies = {blank_body<2>(Newtonian{box_density, box_bulk_modulus, 0}, 0),
                    blank_body<2>(LinearElastic{box_density, 2e6, 1e6}, 0)};
    for (int b = 0; b < 2; ++b) {
      state.bodies[b].name = scene.bodies[b].name;
      state.bodies[b].field = b;
      state.bodies[b].pressure = PressureSupport::cell;
    }
    draw(at, sense);
    cut_interface_cells(state, grids);
  }

  void draw(const Corners& at, Sense sense) {
    std::vector<std::array<double, 2>> points;
    add_side({at.left, at.bottom}, {at.right, at.bottom}, points);
    add_side({at.right, at.bottom}, {at.right, at.top}, points);
    add_side({at.right, at.top}, {at.left, at.top}, points);
    add_side({at.left, at.top}, {at.left, at.bottom}, points);
    if (sense == Sense::clockwise) std::reverse(points.begin(), points.end());
    draw(points);
  }

  /// Any closed outline.
  void draw(const std::vector<std::array<double, 2>>& points) {
    Membrane<2> m;
    m.name = "skin";
    m.body = "bag";
    m.field = 1;
    m.sharp = true;
    m.fluid_density = box_density;
    for (const auto& point : points)
      for (int a = 0; a < 2; ++a) m.x[a].push_back(point[a]);
    const std::size_t n = points.size();
    for (auto* values : {&m.v, &m.load, &m.caught})
      for (auto& component : *values) component.assign(n, 0.0);
    m.mass.assign(n, 1.0);
    m.rest_length.assign(n, 1.0);
    m.water_pressure.assign(n, 0.0);
    m.water_shear.assign(n, 0.0);
    state.membranes = {m};
  }

  Grid<2>& around() { return grids[0]; }
  Grid<2>& inside() { return grids[1]; }
  Membrane<2>& skin() { return state.membranes[0]; }
  int flat(int i, int j) const { return grids[0].layout.index({i, j}); }

  /// The same mass at every node of the domain [kg].
  void set_mass(Grid<2>& grid, double mass) {
    for_each_node(grid.layout, 0, [&](int node, const auto&) { grid.sum[node][3] = mass; });
  }

  /// Every cell is full of what it holds: of the part that it has; pressures are left to the test.
  void fill_cells() {
    for (Grid<2>& grid : grids)
      for_each_node(grid.layout, 0, [&](int cell, const auto&) {
        const bool of_bag = grid.field == 1 && grids[0].taken[cell] == 0;
        grid.cell_volume[cell] = of_bag ? 0.0 : 1 - grid.taken[cell];
        grid.cell_flags[cell] = grid.cell_volume[cell] > 0 ? cell_filled : 0;
      });
  }

  /// The part that a field has of a cell.
  const PartCell<2>& part(const Grid<2>& grid, int i, int j) const {
    const auto found = std::find_if(grid.part_cells.begin(), grid.part_cells.end(),
                                    [&](const PartCell<2>& p) { return p.flat == flat(i, j); });
    if (found == grid.part_cells.end()) throw std::runtime_error("the field has no part of this cell");
    return *found;
  }

  /// The segment whose middle is nearest to a place.
  std::size_t segment_at(double x, double y) const {
    const Membrane<2>& m = state.membranes[0];
    std::size_t best = 0;
    double nearest = 1e9;
    for (std::size_t k = 0; k < m.nodes(); ++k) {
      const std::size_t end = (k + 1) % m.nodes();
      const double away = std::hypot(0.5 * (m.x[0][k] + m.x[0][end]) - x, 0.5 * (m.x[1][k] + m.x[1][end]) - y);
      if (away < nearest) nearest = away, best = k;
    }
    return best;
  }

 private:
  /// The start of a side and its crossings from cell to cell.
  static void add_side(std::array<double, 2> from, std::array<double, 2> to,
                       std::vector<std::array<double, 2>>& points) {
    const int axis = from[0] == to[0] ? 1 : 0;
    points.push_back(from);
    const double low = std::min(from[axis], to[axis]), high = std::max(from[axis], to[axis]);
    std::vector<double> faces;
    for (double face = std::floor(low) - 0.5; face < high; ++face)
      if (face > low) faces.push_back(face);
    if (to[axis] < from[axis]) std::reverse(faces.begin(), faces.end());
    for (const double face : faces) {
      points.push_back(from);
      points.back()[axis] = face;
    }
  }
};

}  // namespace geodrop::test
