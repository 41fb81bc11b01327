// Grids without a scene file, and particles with random everything, in 2D and 3D: material for identities that must
// hold whatever the numbers are.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/materials/materials.hpp>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "grid/sort_particles.hpp"

namespace geodrop::test {

/// The same numbers in every run.
class Random {
 public:
  explicit Random(unsigned seed = 7) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<>(low, high)(engine_); }

 private:
  std::mt19937 engine_;
};

/// A box of `cells` cells of size h from the origin, one body, one elastic material.
template <int Dim>
Scene box_scene(int cells, double h, WallKind wall, Transfer transfer = Transfer::tpic) {
  Scene scene;
  scene.dimension = Dim;
  scene.grid.lower.assign(Dim, 0.0);
  scene.grid.upper.assign(Dim, cells * h);
  scene.grid.spacing = h;
  scene.walls.lower.assign(Dim, wall);
  scene.walls.upper.assign(Dim, wall);
  scene.gravity.assign(Dim, 0.0);
  scene.solver.transfer = transfer;
  if (transfer == Transfer::blend) scene.solver.blend_rate = 10;
  scene.time.end = 1;
  scene.materials = {{"stuff", LinearElasticSpec{1000, 1e6, 0.25}, {}}};
  BodySpec body;
  body.name = "body";
  body.material = "stuff";
  scene.bodies = {body};
  return scene;
}

/// The same box with cells of another width along every axis, four times finer somewhere: the zones differ.
template <int Dim>
Scene graded_scene(int cells, double h, WallKind wall, Transfer transfer = Transfer::tpic) {
  Scene scene = box_scene<Dim>(cells, h, wall, transfer);
  for (int a = 0; a < Dim; ++a)
    scene.grid.refine.push_back(
        {a, (0.2 + 0.15 * a) * cells * h, (0.35 + 0.2 * a) * cells * h, h / 4, 1.3 - 0.1 * a, {}});
  return scene;
}

/// An empty body of `n` particles with all arrays that a law other than Newtonian needs.
template <int Dim>
Body<Dim> blank_body(const Material& material, std::size_t n) {
  Body<Dim> body;
  body.name = "body";
  body.material_name = "stuff";
  body.material = material;
  body.pressure = PressureSupport::particle;
  const auto fill = [n](auto& arrays, double value) {
    for (auto& values : arrays) values.assign(n, value);
  };
  fill(body.x, 0.0);
  fill(body.initial_x, 0.0);
  fill(body.v, 0.0);
  fill(body.affine, 0.0);
  fill(body.stress, 0.0);
  body.mass.assign(n, 1.0);
  body.J.assign(n, 1.0);
  body.layer.assign(n, 0);
  body.id.resize(n);
  std::iota(body.id.begin(), body.id.end(), 0U);
  return body;
}

/// Particles with random position (in [low, high] along every axis), velocity, affine rate, mass, volume and stress.
template <int Dim>
Body<Dim> random_body(std::size_t n, double low, double high, Random& random) {
  Body<Dim> body = blank_body<Dim>(LinearElastic{1000, 2e6, 1e6}, n);
  const auto scramble = [&](auto& arrays, double a, double b) {
    for (auto& values : arrays)
      for (double& value : values) value = random.uniform(a, b);
  };
  scramble(body.x, low, high);
  scramble(body.v, -3, 3);
  scramble(body.affine, -5, 5);
  scramble(body.stress, -1e4, 1e4);
  for (double& m : body.mass) m = random.uniform(0.1, 2);
  for (double& j : body.J) j = random.uniform(0.5, 1.5);
  return body;
}

/// Whole lattice of particles, `per_axis` a cell and axis, of density rho0 everywhere.
template <int Dim>
Body<Dim> lattice_body(const GridLayout<Dim>& layout, const Material& material, int per_axis) {
  std::array<int, Dim> count;
  std::size_t n = 1;
  for (int a = 0; a < Dim; ++a) n *= count[a] = layout.cells[a] * per_axis;
  Body<Dim> body = blank_body<Dim>(material, n);
  const double width = layout.h / per_axis;
  for (std::size_t p = 0; p < n; ++p) {
    std::size_t rest = p;
    for (int a = 0; a < Dim; ++a) {
      body.x[a][p] = layout.lower[a] + (static_cast<double>(rest % count[a]) + 0.5) * width;
      rest /= count[a];
    }
    body.mass[p] = reference_density(material) * std::pow(width, Dim);
  }
  return body;
}

/// Sorts particles that share one velocity field.
template <int Dim>
void sort_particles(State<Dim>& state, Grid<Dim>& grid) {
  Grids<Dim> only(1);
  std::swap(only.front(), grid);
  sort_particles_if_due(state, only);
  std::swap(only.front(), grid);
}

template <int Dim>
void activate_all_blocks(Grid<Dim>& grid) {
  grid.active_blocks.resize(grid.layout.block_count());
  std::iota(grid.active_blocks.begin(), grid.active_blocks.end(), 0U);
}

/// f(flat index, integer coordinates) for every node of the domain; with `ghosts` > 0 for that many beyond it, too.
template <int Dim, class F>
void for_each_node(const GridLayout<Dim>& layout, int ghosts, F&& f) {
  std::array<int, Dim> i;
  std::size_t total = 1;
  for (int a = 0; a < Dim; ++a) total *= layout.cells[a] + 1 + 2 * ghosts;
  for (std::size_t k = 0; k < total; ++k) {
    std::size_t rest = k;
    for (int a = 0; a < Dim; ++a) {
      const int width = layout.cells[a] + 1 + 2 * ghosts;
      i[a] = static_cast<int>(rest % width) - ghosts;
      rest /= width;
    }
    f(layout.index(i), i);
  }
}

/// Power of the forces on nodes, and the sum of its parts without sign [W].
struct Power {
  double sum = 0, size = 0;
};

/// Gives the nodes that `for_each_node` visits random velocities.
template <int Dim>
Power power_of_random_velocity(Grid<Dim>& grid, int ghosts, Random& random) {
  Power power;
  for_each_node(grid.layout, ghosts, [&](int flat, const auto&) {
    for (int a = 0; a < Dim; ++a) {
      grid.velocity[flat][a] = random.uniform(-1, 1);
      power.sum += grid.force[flat][a] * grid.velocity[flat][a];
      power.size += std::abs(grid.force[flat][a] * grid.velocity[flat][a]);
    }
  });
  return power;
}

/// Largest component of a node record, without sign.
inline double largest_component(const Vec4& v) {
  return std::max(std::max(std::abs(v[0]), std::abs(v[1])), std::max(std::abs(v[2]), std::abs(v[3])));
}

/// What an elastic solid that moves with x += dL x grows by beside tr(dL), as its spin takes it along tangents: the
/// trace of W^T W / 2, W = skew(dL).
template <int Dim>
double growth_of_spin(const Eigen::Matrix<double, Dim, Dim>& dL) {
  return (0.5 * (dL - dL.transpose())).squaredNorm() / 2;
}

}  // namespace geodrop::test
