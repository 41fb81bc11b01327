// Implicit pore pressure: velocities and changes of pressure belong together, by the operators of the explicit scheme.
#include "grid/implicit_pressure.hpp"

#include <doctest/doctest.h>

#include "cut/interface_cells.hpp"
#include "grid/blocks.hpp"
#include "grid/cell_pressure.hpp"
#include "grid/momentum.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double density = 2000, dt = 1e-3;

/// Undrained soil of random density and fill everywhere, nodes with random velocities.
template <int Dim>
Grid<Dim> soil_in_motion(Scene scene, double stiffness) {
  scene.bodies[0].implicit_pore_pressure = true;
  Grid<Dim> grid = make_grid<Dim>(scene);
  activate_all_blocks(grid);
  Random random(5);
  for_each_node(grid.layout, 0, [&](int flat, const std::array<int, Dim>&) {
    const double volume = std::pow(grid.layout.h, Dim) * random.uniform(0.3, 1);
    grid.cell_flags[flat] = cell_filled;
    grid.cell_volume[flat] = volume;
    grid.pore_modulus[flat] = stiffness * random.uniform(0.5, 1) * volume;
    grid.volume_rate[flat] = 1;  // the share of soften_light_cells
    grid.sum[flat][3] = density * volume;
    for (int a = 0; a < Dim; ++a) grid.velocity[flat][a] = random.uniform(-1, 1);
  });
  impose_wall_velocity(grid);
  return grid;
}

/// Volume rates of all cells from the velocities of the nodes.
template <int Dim>
Array<double> rates_of(Grid<Dim> grid) {
  for_each_node(grid.layout, 0, [&](int flat, const auto&) { grid.volume_rate[flat] = 1; });
  cell_volume_rate(grid);
  return grid.volume_rate;
}

/// The largest of what the changes of pressure leave of m (v' - v) / dt, over the largest of it.
template <int Dim>
double residual(const Grid<Dim>& before, const Grid<Dim>& after) {
  Grid<Dim> pressed = after;
  const Array<double> rate = rates_of(after);
  for_each_node(after.layout, 0, [&](int flat, const auto&) {
    pressed.cell_pressure[flat] = -dt * after.pore_modulus[flat] / after.cell_volume[flat] * rate[flat];
  });
  double largest = 0, left = 0;
  for (const std::uint32_t block : after.active_blocks)
    for_each_real_row_of_block(after.layout, block, [&](int begin, int count, const std::array<int, Dim>& node) {
      const RowForce<Dim> force = cell_pressure_force<Dim>(pressed, begin, count, node);
      for (int k = 0; k < count; ++k) {
        const std::array<bool, Dim> held = held_by_walls(after.layout, begin + k);
        for (int a = 0; a < Dim; ++a) {
          if (held[a]) continue;
          const double change = after.velocity[begin + k][a] - before.velocity[begin + k][a];
          const double inertia = after.sum[begin + k][3] * change / dt;
          largest = std::max(largest, std::abs(inertia));
          left = std::max(left, std::abs(inertia - force[a][k]));
        }
      }
    });
  return left / largest;
}

template <int Dim>
void check_equations(const Scene& scene) {
  for (const double stiffness : {1e4, 2e9}) {
    const Grid<Dim> before = soil_in_motion<Dim>(scene, stiffness);
    Grid<Dim> after = before;
    press_cells(after, dt);
    CHECK(residual(before, after) < 1e-4);
  }
}

/// Parts of some cells of a sharp interface: pairs that share a pressure, and one alone; some of their nodes are light.
template <int Dim>
void cut_cells(Grid<Dim>& grid, Random& random) {
  grid.light_mass = 0.1 * density * std::pow(grid.layout.h, Dim);
  std::vector<int> inner;
  for_each_node(grid.layout, 0, [&](int flat, const std::array<int, Dim>& i) {
    const bool far = std::all_of(i.begin(), i.end(), [](int at) { return at >= 3 && at <= 6; });
    if (far) inner.push_back(flat);
    if (far && random.uniform(0, 1) < 0.3) grid.sum[flat][3] *= 0.02;
  });
  for (std::size_t k = 0; k < 5; ++k) {
    const int flat = inner[2 * k], host = inner[2 * (k / 2 * 2)];
    PartCell<Dim> part{flat, host};
    for (auto& slope : part.slope)
      for (double& g : slope) g = random.uniform(-0.1, 0.1) * std::pow(grid.layout.h, Dim - 1);
    grid.part_cells.push_back(part);
  }
}

/// Volume rates of cells and parts from the velocities of the nodes.
template <int Dim>
Array<double> rates_with_parts(Grid<Dim> grid) {
  for_each_node(grid.layout, 0, [&](int flat, const auto&) { grid.volume_rate[flat] = 1; });
  cell_volume_rate(grid);
  Grids<Dim> grids{std::move(grid)};
  update_interface_rates(grids);
  return grids.front().volume_rate;
}

/// sum V p D over the pressures p = -K dt D(v'), those of a group of parts once; D of w.
template <int Dim>
double work_of_pressures(const Grid<Dim>& after, const Array<double>& rate_after, const Array<double>& rate_w) {
  double work = 0;
  std::vector<int> done;
  for (const PartCell<Dim>& part : after.part_cells) {
    done.push_back(part.flat);
    if (part.flat != part.host) continue;
    double volume = 0, modulus = 0;
    for (const PartCell<Dim>& other : after.part_cells)
      if (other.host == part.host) {
        volume += after.cell_volume[other.flat];
        modulus += after.pore_modulus[other.flat];
      }
    work -= volume * dt * modulus / volume * rate_after[part.flat] * rate_w[part.flat];
  }
  for_each_node(after.layout, 0, [&](int flat, const auto&) {
    if (std::find(done.begin(), done.end(), flat) == done.end())
      work -= dt * after.pore_modulus[flat] * rate_after[flat] * rate_w[flat];
  });
  return work;
}

template <int Dim>
void check_work_with_parts(const Scene& scene) {
  Random random(11);
  for (const double stiffness : {1e4, 1e7}) {
    Grid<Dim> before = soil_in_motion<Dim>(scene, stiffness);
    cut_cells<Dim>(before, random);
    Grid<Dim> after = before, other = before;
    press_cells(after, dt);
    for_each_node(other.layout, 0, [&](int flat, const auto&) {
      for (int a = 0; a < Dim; ++a) other.velocity[flat][a] = random.uniform(-1, 1);
    });
    impose_wall_velocity(other);
    double inertia = 0;
    for_each_node(after.layout, 0, [&](int flat, const auto&) {
      for (int a = 0; a < Dim; ++a)
        inertia +=
            after.sum[flat][3] * (after.velocity[flat][a] - before.velocity[flat][a]) / dt * other.velocity[flat][a];
    });
    const double work = work_of_pressures(after, rates_with_parts(after), rates_with_parts(other));
    CHECK(inertia == near(work, 1e-4));
  }
}

double largest_of(const Array<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

TEST_CASE("Nodes change by the force of the pressures that follow from their new velocities") {
  for (const WallKind wall : {WallKind::slip, WallKind::no_slip}) {
    check_equations<2>(box_scene<2>(9, 0.25, wall));
    check_equations<2>(graded_scene<2>(7, 0.25, wall));
    check_equations<3>(box_scene<3>(5, 0.25, wall));
  }
}

TEST_CASE("Parts of cells that share a pressure act as one, on what nodes of small mass can take of it") {
  check_work_with_parts<2>(box_scene<2>(9, 0.25, WallKind::slip));
  check_work_with_parts<3>(box_scene<3>(9, 0.25, WallKind::slip));
}

TEST_CASE("Water in the pores that is nearly rigid lets no cell change its volume") {
  const Grid<2> before = soil_in_motion<2>(box_scene<2>(9, 0.25, WallKind::slip), 1e13);
  Grid<2> after = before;
  press_cells(after, dt);
  CHECK(largest_of(rates_of(after)) < 1e-3 * largest_of(rates_of(before)));
}

TEST_CASE("Small-mass nodes follow, and no momentum is lost") {
  Grid<2> grid = soil_in_motion<2>(box_scene<2>(12, 0.25, WallKind::slip), 2e9);
  // Soil in the middle only: nothing reaches the walls.
  for_each_node(grid.layout, 0, [&](int flat, const std::array<int, 2>& i) {
    const bool inside = std::min({i[0], i[1], 12 - i[0], 12 - i[1]}) >= 5;
    if (!inside) {
      grid.cell_volume[flat] = grid.pore_modulus[flat] = 0;
      grid.sum[flat][3] *= 1e-4;
    }
  });
  const auto momentum = [&] {
    std::array<double, 2> sum{};
    for_each_node(grid.layout, 0, [&](int flat, const auto&) {
      for (int a = 0; a < 2; ++a) sum[a] += grid.sum[flat][3] * grid.velocity[flat][a];
    });
    return sum;
  };
  const std::array<double, 2> before = momentum();
  const Array<double> rates = rates_of(grid);
  press_cells(grid, dt);
  const std::array<double, 2> after = momentum();
  CHECK(largest_of(rates_of(grid)) < 0.05 * largest_of(rates));
  for (int a = 0; a < 2; ++a) CHECK(after[a] == near(before[a], 1e-12));
}
