// An enclosed fluid on the grid: identities between forces, loads and rates that must hold whatever the numbers are.
#include "cut/enclosed_fluid.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "grid/sort_particles.hpp"
#include "membrane/membrane_force.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "transfer/transfer_stages.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double h = 0.25, density = 1200, bulk_modulus = 1e6, dt = 1e-3;

/// A wavy tube full of particles, unless told otherwise with uniform volume ratio 1.
struct Tube {
  State<2> state;
  Grid<2> grid;

  explicit Tube(unsigned seed, Transfer transfer = Transfer::blend) {
    Scene scene = box_scene<2>(16, h, WallKind::slip, transfer);
    scene.materials = {{"stuff", NewtonianSpec{density, bulk_modulus, 0}, {}}};
    scene.bodies[0].pressure = PressureSupport::enclosed;
    grid = make_grid<2>(scene);
    draw_membrane(seed);
    fill();
    state.drift = -1;
    sort_particles(state, grid);
    update_enclosed_cells(state, grid);
  }

  void draw_membrane(unsigned seed) {
    Random random(seed);
    Membrane<2> m;
    m.name = "skin";
    m.body = "body";
    constexpr int corners = 70;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * k / corners;
      const double r = 1.2 + 0.3 * std::cos(3 * angle) + random.uniform(-0.02, 0.02);
      m.x[0].push_back(2.03 + r * std::cos(angle));
      m.x[1].push_back(1.96 + r * std::sin(angle));
    }
    for (auto* values : {&m.v, &m.load})
      for (auto& component : *values) component.assign(corners, 0.0);
    m.mass.assign(corners, 1.0);
    m.rest_length.assign(corners, 1.0);
    state.membranes = {m};
  }

  /// Three particles a cell and axis where the wavy outline without its noise is.
  void fill() {
    const Body<2> lattice = lattice_body<2>(grid.layout, Newtonian{density, bulk_modulus, 0}, 3);
    std::array<Array<double>, 2> inside;
    for (std::size_t p = 0; p < lattice.size(); ++p) {
      const double x = lattice.x[0][p] - 2.03, y = lattice.x[1][p] - 1.96;
      if (std::hypot(x, y) > 1.2 + 0.3 * std::cos(3 * std::atan2(y, x))) continue;
      for (int a = 0; a < 2; ++a) inside[a].push_back(lattice.x[a][p]);
    }
    Body<2> body = blank_body<2>(lattice.material, inside[0].size());
    body.x = inside;
    body.pressure = PressureSupport::enclosed;
    body.enclosed = 0;
    body.mass.assign(body.size(), lattice.mass[0]);
    state.bodies = {body};
  }

  Body<2>& body() { return state.bodies[0]; }
  Membrane<2>& membrane() { return state.membranes[0]; }
  EnclosedCells& cells() { return grid.enclosed[0]; }

  /// A pressure of its own in each particle.
  void scramble_pressure(unsigned seed) {
    Random random(seed);
    for (double& J : body().J) J = random.uniform(0.98, 1.005);
    update_enclosed_cells(state, grid);
  }

  void scramble_velocity(unsigned seed) {
    Random random(seed);
    for_each_node(grid.layout, 2, [&](int flat, const auto&) {
      for (int a = 0; a < 2; ++a) grid.velocity[flat][a] = random.uniform(-1, 1);
    });
  }

  const std::array<Array<double>, 2>& loads() {
    clear_membrane_loads(state);
    add_fluid_loads(state, grid);
    return membrane().load;
  }

  int flat(std::size_t c) {
    const int i = static_cast<int>(c) % cells().count[0], j = static_cast<int>(c) / cells().count[0];
    return cells().first[0] + i + (cells().first[1] + j) * grid.layout.stride[1];
  }

  /// V_c D_c of the hosts [m2/s].
  Array<double> volume_rates() {
    update_enclosed_rates(state, grid, dt);
    Array<double> out(cells().volume.size());
    for (std::size_t c = 0; c < out.size(); ++c) out[c] = cells().volume[c] * cells().rate[flat(c)];
    return out;
  }

  /// V_c D_c of the present velocities alone, without that of evening pressures.
  Array<double> volume_rates_of_motion() {
    Array<double> with = volume_rates();
    std::fill(grid.velocity.begin(), grid.velocity.end(), Vec4{});
    const Array<double> without = volume_rates();
    for (std::size_t c = 0; c < with.size(); ++c) with[c] -= without[c];
    return with;
  }
};

double sum(const Array<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

struct Moments {
  double area = 0, height = 0;  ///< int dA, int y dA
};

Moments moments(const Membrane<2>& m) {
  Moments out;
  for (std::size_t k = 0; k < m.nodes(); ++k) {
    const std::size_t next = (k + 1) % m.nodes();
    const double cross = m.x[0][k] * m.x[1][next] - m.x[0][next] * m.x[1][k];
    out.area += cross / 2;
    out.height += cross * (m.x[1][k] + m.x[1][next]) / 6;
  }
  return out;
}

double largest_force(const Grid<2>& grid) {
  double largest = 0;
  for (const Vec4& f : grid.force) largest = std::max(largest, largest_component(f));
  return largest;
}

void reverse_nodes(Membrane<2>& m) {
  for (auto& component : m.x) std::reverse(component.begin(), component.end());
}

}  // namespace

TEST_CASE("Power of forces and loads is the pressure times the rate of volume, in either sense of the outline") {
  for (const bool clockwise : {false, true}) {
    CAPTURE(clockwise);
    Tube tube(3);
    if (clockwise) reverse_nodes(tube.membrane());
    tube.scramble_pressure(4);
    tube.scramble_velocity(5);
    enclosed_force_to_grid(tube.state, tube.grid, {0, 0}, dt);
    double power = 0, size = 0, stored = 0;
    const auto add = [&](double part) {
      power += part;
      size += std::abs(part);
    };
    for (std::size_t n = 0; n < tube.grid.force.size(); ++n)
      for (int a = 0; a < 2; ++a) add(tube.grid.force[n][a] * tube.grid.velocity[n][a]);
    const auto v = node_velocities(tube.membrane(), tube.grid);
    const auto& load = tube.loads();
    for (std::size_t k = 0; k < tube.membrane().nodes(); ++k)
      for (int a = 0; a < 2; ++a) add(load[a][k] * v[a][k]);
    const Array<double> rates = tube.volume_rates_of_motion();
    for (std::size_t c = 0; c < rates.size(); ++c) stored += tube.cells().pressure[c] * rates[c];
    REQUIRE(size > 1);
    CHECK(std::abs(power - stored) < 1e-12 * size);
  }
}

TEST_CASE("Without a record of its own, dt times the force joins the momentum") {
  Tube apart(3), joined(3, Transfer::tpic);
  for (Tube* tube : {&apart, &joined}) {
    tube->scramble_pressure(4);
    particles_to_grid(tube->state, tube->grid, dt);
    enclosed_force_to_grid(tube->state, tube->grid, {0, -9.81}, dt);
  }
  REQUIRE(joined.grid.force.empty());
  double worst = 0;
  for (std::size_t n = 0; n < apart.grid.force.size(); ++n)
    for (int a = 0; a < 2; ++a) worst = std::max(worst, std::abs(dt * apart.grid.force[n][a] - joined.grid.sum[n][a]));
  CHECK(worst < 1e-13 * dt * largest_force(apart.grid));
}

TEST_CASE("A uniform pressure has no force on the grid, and loads the membrane by p n") {
  Tube tube(6);
  const double J = 0.99, p = bulk_modulus * (1 / J - 1);
  std::fill(tube.body().J.begin(), tube.body().J.end(), J);
  update_enclosed_cells(tube.state, tube.grid);
  enclosed_force_to_grid(tube.state, tube.grid, {0, 0}, dt);
  CHECK(largest_force(tube.grid) < 1e-12 * p * h);
  tube.scramble_pressure(7);
  enclosed_force_to_grid(tube.state, tube.grid, {0, 0}, dt);
  CHECK(largest_force(tube.grid) > 1e-3 * p * h);  // what the zero above is worth

  std::fill(tube.body().J.begin(), tube.body().J.end(), J);
  update_enclosed_cells(tube.state, tube.grid);
  const auto& load = tube.loads();
  const auto& [x, y] = tube.membrane().x;
  const std::size_t n = tube.membrane().nodes();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n, last = (k + n - 1) % n;
    CHECK(std::abs(load[0][k] - p * (y[next] - y[last]) / 2) < 1e-11 * p);
    CHECK(std::abs(load[1][k] - p * (x[last] - x[next]) / 2) < 1e-11 * p);
  }
}

TEST_CASE("Gravity is taken from the enclosed fluid, also where there are other bodies, but not from these") {
  for (const bool alone : {true, false}) {
    CAPTURE(alone);
    Tube tube(6);
    if (!alone) {
      Body<2> other = blank_body<2>(LinearElastic{1000, 2e6, 1e6}, 2 * tube.body().size());
      for (auto& component : other.x) component.assign(other.size(), 2.0);
      tube.state.bodies.push_back(other);
      tube.state.drift = -1;
      sort_particles(tube.state, tube.grid);
    }
    particles_to_grid(tube.state, tube.grid, dt);
    enclosed_force_to_grid(tube.state, tube.grid, {0, -9.81}, dt);
    double fx = 0, fy = 0;
    for (const Vec4& f : tube.grid.force) {
      fx += f[0];
      fy += f[1];
    }
    const double weight = 9.81 * sum(tube.body().mass);
    CHECK(std::abs(fx) < 1e-12 * weight);
    CHECK(fy == near(weight, 1e-12));
  }
}

TEST_CASE("The load of the weight is minus the derivative of gamma int (y - y0) dA; its resultant is gamma A down") {
  for (const bool clockwise : {false, true}) {
    CAPTURE(clockwise);
    Tube tube(8);
    if (clockwise) reverse_nodes(tube.membrane());
    update_enclosed_cells(tube.state, tube.grid);
    const double gamma = tube.body().unit_weight = 9.81 * density, y0 = tube.body().weightless_level = 3.1;
    const auto load = tube.loads();
    Membrane<2> m = tube.membrane();
    const auto energy = [&] {
      const Moments now = moments(m);
      return (clockwise ? -1 : 1) * gamma * (now.height - y0 * now.area);
    };
    constexpr double step = 1e-3;  // the energy is quadratic in each coordinate: any step is exact
    for (std::size_t k = 0; k < m.nodes(); ++k)
      for (int a = 0; a < 2; ++a) {
        const double at = m.x[a][k];
        m.x[a][k] = at + step;
        const double above = energy();
        m.x[a][k] = at - step;
        const double below = energy();
        m.x[a][k] = at;
        CHECK(std::abs(load[a][k] + (above - below) / (2 * step)) < 1e-9 * gamma);
      }
    const double weight = gamma * std::abs(moments(m).area);
    CHECK(std::abs(sum(load[0])) < 1e-11 * weight);
    CHECK(sum(load[1]) == near(-weight, 1e-12));
  }
}

TEST_CASE("The volumes of all cells grow together as the area of the polygon, whose nodes move with the grid") {
  Tube tube(9);
  tube.scramble_pressure(10);
  tube.scramble_velocity(11);
  const auto v = node_velocities(tube.membrane(), tube.grid);
  const auto& [x, y] = tube.membrane().x;
  double growth = 0, size = 0;
  const std::size_t n = tube.membrane().nodes();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n, last = (k + n - 1) % n;
    const double part = (v[0][k] * (y[next] - y[last]) - v[1][k] * (x[next] - x[last])) / 2;
    growth += part;
    size += std::abs(part);
  }
  REQUIRE(std::abs(growth) > 1e-3 * size);
  CHECK(std::abs(sum(tube.volume_rates_of_motion()) - growth) < 1e-13 * size);
}

TEST_CASE("Pressures even out from cell to cell: nothing is lost, and flow runs from high to low") {
  Tube tube(9);
  tube.scramble_pressure(10);
  std::fill(tube.grid.velocity.begin(), tube.grid.velocity.end(), Vec4{});
  const Array<double> rates = tube.volume_rates();
  double size = 0, released = 0;
  for (std::size_t c = 0; c < rates.size(); ++c) {
    size += std::abs(rates[c]);
    released += tube.cells().pressure[c] * rates[c];
  }
  REQUIRE(size > 0);
  CHECK(std::abs(sum(rates)) < 1e-13 * size);
  CHECK(released > 0);
}

TEST_CASE("Volume ratios even out within a cell, which keeps its volume") {
  Tube tube(12);
  tube.scramble_pressure(13);
  const Array<double> J = tube.body().J;
  const Array<double> volume_before = tube.cells().volume;
  update_enclosed_rates(tube.state, tube.grid, dt);
  update_enclosed_cells(tube.state, tube.grid);
  for (std::size_t c = 0; c < volume_before.size(); ++c)
    CHECK(std::abs(tube.cells().volume[c] - volume_before[c]) < 1e-14);
  // Differences of two particles with one host shrink by 0.1 c dt / h.
  const double kept = 1 - 0.1 * std::sqrt(bulk_modulus / density) * dt / h;
  const auto host = [&](std::size_t p) {
    const int i = tube.grid.layout.base(0, tube.body().x[0][p]) + GridLayout<2>::pad - tube.cells().first[0];
    const int j = tube.grid.layout.base(1, tube.body().x[1][p]) + GridLayout<2>::pad - tube.cells().first[1];
    return tube.cells().host[i + j * tube.cells().count[0]];
  };
  int pairs = 0;
  for (std::size_t p = 1; p < tube.body().size(); ++p) {
    if (host(p) != host(p - 1)) continue;
    const double now = tube.body().J[p] - tube.body().J[p - 1];
    CHECK(std::abs(now - kept * (J[p] - J[p - 1])) < 1e-14);
    ++pairs;
  }
  CHECK(pairs > 100);
}

TEST_CASE("Every cell with fluid shares the pressure of a cell that stands by itself") {
  Tube tube(14);
  tube.scramble_pressure(15);
  const EnclosedCells& cells = tube.cells();
  for (const EnclosedCells::Piece& piece : cells.pieces) CHECK(cells.volume[cells.host[piece.cell]] > 0.3 * h * h);
  CHECK(sum(cells.volume) == near(
                                 [&] {
                                   double all = 0;
                                   for (std::size_t p = 0; p < tube.body().size(); ++p) all += tube.body().volume(p);
                                   return all;
                                 }(),
                                 1e-13));
}
