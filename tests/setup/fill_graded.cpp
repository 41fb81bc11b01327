// Bodies on graded axes: sites are even in the grid coordinate, and their particles hold the volume of the shape.
#include <doctest/doctest.h>
#include <geodrop/grid/grid.hpp>
#include <geodrop/step/pipeline.hpp>

#include <numbers>

#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

template <int Dim>
Scene filled(const Shape& shape, int per_axis) {
  Scene scene = graded_scene<Dim>(8, 0.5, WallKind::slip);
  BodySpec& body = scene.bodies[0];
  body.shape = shape;
  body.particles_per_cell_axis = per_axis;
  body.initial_velocity = UniformVelocitySpec{Point(Dim, 0.0)};
  body.initial_stress = ZeroStressSpec{};
  return scene;
}

template <int Dim>
double volume_of(const Body<Dim>& body) {
  double sum = 0;
  for (std::size_t p = 0; p < body.size(); ++p) sum += body.volume(p);
  return sum;
}

}  // namespace

TEST_CASE("Where particles are everywhere, each knot span holds its own width of them, two along an axis") {
  const Scene scene = filled<2>(BoxShape{{0, 0}, {4, 4}}, 2);
  const Body<2> body = build_state<2>(scene).bodies[0];
  const GridLayout<2> layout(scene.grid, scene.walls);
  CHECK(body.size() == 4u * layout.cells[0] * layout.cells[1]);
  std::vector<double> held(layout.nodes(), 0.0);
  for (std::size_t p = 0; p < body.size(); ++p)
    held[layout.index({layout.base(0, body.x[0][p]), layout.base(1, body.x[1][p])})] += body.volume(p);
  for_each_node(layout, 0, [&](int flat, const std::array<int, 2>& i) {
    double whole = layout.h * layout.h;
    for (int a = 0; a < 2; ++a)
      whole *= layout.span_width(a, i[a]) * (i[a] == 0 || i[a] == layout.cells[a] ? 0.5 : 1.0);
    CHECK(held[flat] == near(whole, 1e-12));
  });
}

TEST_CASE("A shape that cells cut has its volume, whatever their width") {
  const double area = std::numbers::pi * 1.1 * 0.7;
  for (const int per_axis : {1, 2, 3})
    CHECK(volume_of(build_state<2>(filled<2>(EllipseShape{{2.05, 1.9}, {1.1, 0.7}, 20}, per_axis)).bodies[0]) ==
          near(area, 3e-7));
  const double volume = 4 * std::numbers::pi / 3 * 1.1 * 0.7 * 0.9;
  CHECK(volume_of(build_state<3>(filled<3>(EllipseShape{{2.05, 1.9, 2.2}, {1.1, 0.7, 0.9}, 0}, 2)).bodies[0]) ==
        near(volume, 2e-7));
}

TEST_CASE("Jitter stays within the sites, however narrow they are") {
  Scene scene = filled<2>(BoxShape{{0, 0}, {4, 4}}, 2);
  const Body<2> lattice = build_state<2>(scene).bodies[0];
  scene.bodies[0].jitter = 0.5;
  const Body<2> jittered = build_state<2>(scene).bodies[0];
  const AxisMap map(scene.grid, 0);
  double largest = 0;
  for (std::size_t p = 0; p < lattice.size(); ++p) {
    const double site = std::floor(2 * map.to_grid(lattice.x[0][p]));
    CHECK(std::floor(2 * map.to_grid(jittered.x[0][p])) == site);
    largest = std::max(largest, std::abs(jittered.x[0][p] - lattice.x[0][p]));
  }
  CHECK(largest > 0.1);
}
