// The filter of checkerboards in the pore pressure: linear pressures stay, alternating ones fade, sums are kept.
#include "grid/checkerboard.hpp"

#include <doctest/doctest.h>

#include <set>

#include "grid/blocks.hpp"
#include "grid/neighbourhood.hpp"
#include "grid/seams.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// A scene of undrained soil in a box.
template <int Dim>
Scene undrained(Scene scene) {
  MohrCoulombSpec soil;
  soil.density = 2000;
  soil.youngs_modulus = 1e7;
  soil.poissons_ratio = 0.25;
  soil.pores = UndrainedSpec{.porosity = 0.5, .fluid_bulk_modulus = 8e7};
  scene.materials = {{"stuff", soil, {}}};
  return scene;
}

/// A particle of undrained soil in the middle of every cell, which it fills.
template <int Dim>
struct Bed {
  Grid<Dim> grid;
  State<Dim> state;
  std::vector<int> cells;  ///< of the particles
  double h;

  explicit Bed(const Scene& scene) : grid(make_grid<Dim>(undrained<Dim>(scene))), h(grid.layout.h) {
    activate_all_blocks(grid);
    state.bodies.resize(1);
    Body<Dim>& soil = state.bodies.front();
    soil.material = make_material(undrained<Dim>(scene).materials.front());
    for_each_node(grid.layout, 0, [&](int flat, const std::array<int, Dim>& i) {
      double volume = 1;
      for (int a = 0; a < Dim; ++a) {
        if (grid.layout.periodic(a) && i[a] == grid.layout.cells[a]) return;  // another name of the first one
        volume *= width(a, i[a]) * h;
      }
      for (int a = 0; a < Dim; ++a) soil.x[a].push_back(centre(a, i[a]));
      cells.push_back(flat);
      grid.cell_volume[flat] = grid.pore_volume[flat] = volume;
      grid.cell_flags[flat] = cell_filled;
    });
    soil.mass.assign(cells.size(), 1);
    soil.J.assign(cells.size(), 1);
    soil.pore_pressure.assign(cells.size(), 0);
  }

  double width(int axis, int i) const { return grid.integrals[axis].width[i + GridLayout<Dim>::pad]; }
  /// Of a cell along one axis [m]; cells stand side by side from the lower wall on, or half a cell below a seam.
  double centre(int axis, int i) const {
    double x = grid.layout.lower[axis] - (grid.layout.periodic(axis) ? width(axis, 0) * h / 2 : 0);
    for (int k = 0; k < i; ++k) x += width(axis, k) * h;
    return x + width(axis, i) * h / 2;
  }
  Vec<Dim> place(std::size_t p) const { return vector_at(state.bodies.front().x, p); }

  /// The change of the pore pressure of each particle, for pressures of the cells by particle; in units of the share of
  /// a checkerboard that goes in this step.
  template <class F>
  std::vector<double> change(F&& pressure) {
    Body<Dim>& soil = state.bodies.front();
    for (std::size_t p = 0; p < cells.size(); ++p) grid.cell_pressure[cells[p]] = pressure(p);
    for (int a = 0; a < Dim; ++a)
      if (grid.layout.periodic(a)) {
        copy_over_seam(grid.layout, a, grid.cell_pressure);
        copy_over_seam(grid.layout, a, grid.cell_volume);
        copy_over_seam(grid.layout, a, grid.pore_volume);
        copy_over_seam(grid.layout, a, grid.cell_flags);
      }
    std::fill(soil.pore_pressure.begin(), soil.pore_pressure.end(), 0.0);
    const double dt = 0.01 * h / wave_speed(soil.material);
    filter_checkerboard(state, grid, dt);
    std::vector<double> out(soil.pore_pressure.begin(), soil.pore_pressure.end());
    for (double& du : out) du /= 0.1 * 0.01;
    return out;
  }
};

template <int Dim>
std::vector<Scene> boxes() {
  return {box_scene<Dim>(9, 0.25, WallKind::slip), graded_scene<Dim>(9, 0.25, WallKind::no_slip)};
}

template <int Dim>
void check_linear() {
  for (const Scene& scene : boxes<Dim>()) {
    Bed<Dim> bed(scene);
    Vec<Dim> slope;
    for (int a = 0; a < Dim; ++a) slope[a] = 1000 * (a + 1);
    for (const double du : bed.change([&](std::size_t p) { return 5e4 - slope.dot(bed.place(p)); }))
      CHECK(du == near_zero(1e-9));
  }
}

/// + and - in turn along the first `axes` axes.
template <int Dim>
double alternating(const Bed<Dim>& bed, std::size_t p, int axes) {
  const auto cell = stored_cell(bed.grid.layout, bed.cells[p]);
  int sum = 0;
  for (int a = 0; a < axes; ++a) sum += cell[a];
  return sum % 2 == 0 ? 1.0 : -1.0;
}

template <int Dim>
void check_checkerboard() {
  Bed<Dim> bed(box_scene<Dim>(10, 0.25, WallKind::periodic));
  for (const int axes : {1, Dim}) {
    CAPTURE(axes);
    const auto pressure = [&](std::size_t p) { return 300 * alternating(bed, p, axes); };
    const std::vector<double> change = bed.change(pressure);
    for (std::size_t p = 0; p < change.size(); ++p) CHECK(change[p] == near(-pressure(p) * axes / Dim, 1e-12));
  }
}

/// Cells of any width, but for those at walls.
template <int Dim>
void check_stripe_on_graded_axes() {
  Bed<Dim> bed(graded_scene<Dim>(12, 0.25, WallKind::slip));
  const auto stripe = [&](std::size_t p) { return 300 * alternating(bed, p, 1); };
  const std::vector<double> change = bed.change(stripe);
  constexpr int pad = GridLayout<Dim>::pad, at_wall = 3;
  const int cells = bed.grid.layout.cells[0];
  std::set<double> widths;
  for (std::size_t p = 0; p < change.size(); ++p) {
    const int i = stored_cell(bed.grid.layout, bed.cells[p])[0] - pad;
    if (i < at_wall || i >= cells - at_wall) continue;
    widths.insert(bed.width(0, i));
    CHECK(change[p] == near(-stripe(p) / Dim, 0.2));
  }
  CHECK(*widths.rbegin() > 2.5 * *widths.begin());
}

/// Of random pressures in soil with holes.
template <int Dim>
void check_sums() {
  for (const Scene& scene : boxes<Dim>()) {
    Bed<Dim> bed(scene);
    Random random;
    for (const int cell : bed.cells) {
      const double which = random.uniform(0, 1);
      if (which < 0.05) bed.grid.cell_flags[cell] = 0;
      if (which > 0.95) bed.grid.pore_volume[cell] = 0.5 * bed.grid.cell_volume[cell];
    }
    std::vector<double> pressure;
    for (std::size_t p = 0; p < bed.cells.size(); ++p) pressure.push_back(random.uniform(-1, 1));
    const std::vector<double> change = bed.change([&](std::size_t p) { return pressure[p]; });
    double sum = 0, sizes = 0, work = 0, changed = 0;
    Vec<Dim> moment = Vec<Dim>::Zero();
    for (std::size_t p = 0; p < change.size(); ++p) {
      const double volume = bed.grid.cell_volume[bed.cells[p]];
      sum += volume * change[p];
      moment += volume * change[p] * bed.place(p);
      sizes += volume * std::abs(change[p]);
      work += volume * pressure[p] * change[p];
      changed += change[p] != 0;
    }
    CHECK(changed > 0.5 * change.size());
    CHECK(sum / sizes == near_zero(1e-14));
    for (int a = 0; a < Dim; ++a) CHECK(moment[a] / sizes == near_zero(1e-13));
    CHECK(work < -0.1 * sizes);
  }
}

}  // namespace

TEST_CASE("A pressure that is linear in space stays, beside walls and on graded axes too") {
  check_linear<2>();
  check_linear<3>();
}

TEST_CASE("A checkerboard fades at a tenth of the wave speed over h, a stripe at its share of the axes") {
  check_checkerboard<2>();
  check_checkerboard<3>();
}

TEST_CASE("A stripe on graded axes fades as fast in fine cells as in coarse ones") {
  check_stripe_on_graded_axes<2>();
  check_stripe_on_graded_axes<3>();
}

TEST_CASE("The filter keeps the sum of the pore pressure and its moment, and takes energy") {
  check_sums<2>();
  check_sums<3>();
}

TEST_CASE("Cells that are not filled, or hold something else or a part of a sharp interface, neither give nor take") {
  for (const int what : {0, 1, 2}) {
    CAPTURE(what);
    Bed<2> bed(box_scene<2>(9, 0.25, WallKind::slip));
    const int odd = bed.cells[bed.cells.size() / 2];
    if (what == 0) bed.grid.cell_flags[odd] = 0;
    if (what == 1) bed.grid.pore_volume[odd] = 0.8 * bed.grid.cell_volume[odd];
    if (what == 2) {
      bed.grid.taken.assign(bed.grid.cell_volume.size(), 0.0);
      bed.grid.taken[odd] = 0.1;
    }
    for (const double du : bed.change([&](std::size_t p) { return bed.cells[p] == odd ? 1e6 : 3e3; })) CHECK(du == 0);
  }
}

TEST_CASE(
    "Water, drained soil, and pore pressure by particle have no filter; pore pressure at the end of the step has") {
  Scene scene = undrained<2>(box_scene<2>(4, 0.25, WallKind::slip));
  CHECK(has_checkerboard(scene, scene.bodies.front()));
  CHECK_FALSE(make_grid<2>(scene).pore_volume.empty());
  scene.bodies.front().implicit_pore_pressure = true;
  CHECK(has_checkerboard(scene, scene.bodies.front()));
  scene.bodies.front().implicit_pore_pressure = false;
  scene.bodies.front().pressure = PressureSupport::particle;
  CHECK_FALSE(has_checkerboard(scene, scene.bodies.front()));
  CHECK(make_grid<2>(box_scene<2>(4, 0.25, WallKind::slip)).pore_volume.empty());
}
