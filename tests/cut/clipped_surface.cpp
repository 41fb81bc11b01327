// Cells clipped by sharp membranes of triangles: splines over the surface, flanks and patches fit to cells and faces.
#include <doctest/doctest.h>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "cut/cell_parts.hpp"
#include "cut/cell_slopes.hpp"
#include "cut/clipped_cells.hpp"
#include "cut/clipped_surface.hpp"
#include "cut/wet_cells.hpp"
#include "geometry/surface_ends.hpp"
#include "membrane/triangles.hpp"
#include "support/near.hpp"
#include "support/surfaces.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

ClippedSurface clipped(const GridLayout<3>& layout, const TriangleSurface& surface) {
  ClippedSurface cells;
  clip_surface(layout, membrane_of(surface), cells);
  return cells;
}

}  // namespace

TEST_CASE("Shares and faces are those of clipped cells") {
  for (const GridLayout<3>& layout : even_and_graded())
    for (const TriangleSurface& surface : surfaces()) {
      const ClippedSurface cells = clipped(layout, surface);
      ClippedCells plain;
      clip_cells(layout, membrane_of(surface), plain);
      REQUIRE(cells.count == plain.count);
      for (std::size_t c = 0; c < cells.size(); ++c) {
        CHECK(std::abs(cells.inside[c] - plain.inside[c]) < 1e-12);
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t m = 0; m < 9; ++m)
            CHECK(std::abs(cells.upper_face[a][c][m] - plain.upper_face[a][c][m]) < 1e-12);
      }
    }
}

namespace {

void check_volumes(const GridLayout<3>& layout, const TriangleSurface& surface) {
  // Quadratic splines carry linear functions exactly: sum x_i (int grad N_i)^T = V (identity), sum int N_i = V, and
  // sum x_i int N_i the first moment, here that of all cells together.
  Grid<3> grid;
  grid.layout = layout;
  grid.outline = clipped(layout, surface);
  std::vector<double> share(layout.nodes(), 0.0);
  for (std::size_t c = 0; c < grid.outline.size(); ++c)
    share[flat_of(layout, grid.outline, static_cast<int>(c))] = grid.outline.inside[c];
  int cells = 0;
  for (const CutCell<3>& cell : cut_cells_of(grid, membrane_of(surface))) {
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
    double volume = 0;
    for (int n = 0; n < 27; ++n) {
      const std::array<int, 3> node = stored_cell(layout, node_around(layout, cell.flat, n));
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) moment(a, b) += layout.node(a, node[a] - layout.pad) * cell.inside[n][b];
      volume += cell.value[n];
    }
    const double exact = share[cell.flat] * cell_size(layout, cell.flat);
    CHECK((moment - exact * Eigen::Matrix3d::Identity()).norm() < 1e-13);
    CHECK(std::abs(volume - exact) < 1e-14);
    ++cells;
  }
  CHECK(cells > 100);
}

}  // namespace

TEST_CASE("Splines over faces and surface of a cell reproduce its volume: int x grad N and int N") {
  for (const GridLayout<3>& layout : even_and_graded())
    for (const TriangleSurface& surface : surfaces()) check_volumes(layout, surface);
}

TEST_CASE("int N over the part of a cell below a plane, by hand") {
  // Of a box that ends a quarter of a cell above the middle of its upper cells, away from its edges: along z
  // int_(-1/2)^(1/4) N, along x and y the whole cell.
  const GridLayout<3> layout = small_grid(0.25);
  TriangleSurface box;
  for (int k = 0; k < 8; ++k) box.points.push_back({k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 0.5625 : -1.0});
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  Grid<3> grid;
  grid.layout = layout;
  grid.outline = clipped(layout, box);
  const int flat = layout.index({layout.base(0, 0.0), layout.base(1, 0.0), layout.base(2, 0.5)});
  const auto cut = cut_cells_of(grid, membrane_of(box));
  const auto cell = std::find_if(cut.begin(), cut.end(), [&](const auto& each) { return each.flat == flat; });
  REQUIRE(cell != cut.end());
  const double along[] = {1.0 / 6, 2.0 / 3, 1.0 / 6};
  const double up[] = {(1 - std::pow(0.25, 3)) / 6, 0.75 * 0.75 - (std::pow(0.25, 3) + 0.125) / 3,
                       std::pow(0.75, 3) / 6};
  for (int n = 0; n < 27; ++n)
    CHECK(cell->value[n] == near(std::pow(0.25, 3) * along[n % 3] * along[n / 3 % 3] * up[n / 9], 1e-12));
}

TEST_CASE("Patches: all of the surface, each flank once, none smaller than a quarter of a face unless alone") {
  for (const GridLayout<3>& layout : even_and_graded())
    for (const TriangleSurface& surface : surfaces()) {
      const ClippedSurface cells = clipped(layout, surface);
      const Membrane<3> membrane = membrane_of(surface);
      double area = 0, exact = 0;
      std::uint32_t flanks = 0, pieces = 0;
      for (const ClippedSurface::Patch& patch : cells.patches) {
        CHECK(patch.first_flank == flanks);
        flanks += patch.flanks;
        area += patch.area;
        if (patch.flanks > 1) CHECK(cells.flanks[patch.first_flank].faces > 0.25);
        for (std::uint32_t k = patch.first_flank + 1; k < flanks; ++k) CHECK(cells.flanks[k].faces < 0.25);
      }
      for (const ClippedSurface::Flank& flank : cells.flanks) {
        CHECK(flank.first_piece == pieces);
        for (std::uint32_t p = 0; p < flank.pieces; ++p) CHECK(cells.pieces[pieces + p].cell == flank.cell);
        pieces += flank.pieces;
      }
      for (std::size_t t = 0; t < membrane.triangles.size(); ++t) exact += 0.5 * normal_of(membrane, t).norm();
      CHECK(flanks == cells.flanks.size());
      CHECK(pieces == cells.pieces.size());
      CHECK(area * layout.h * layout.h == near(exact, 1e-12));
    }
}

TEST_CASE("The two sides of a thin bag in one cell are two patches") {
  const GridLayout<3> layout = small_grid(0.25);
  const ClippedSurface cells = clipped(layout, flat_bag());
  std::multiset<int> of_cell;
  for (const ClippedSurface::Flank& flank : cells.flanks) of_cell.insert(flank.cell);
  const auto twice = std::count_if(cells.flanks.begin(), cells.flanks.end(),
                                   [&](const auto& flank) { return of_cell.count(flank.cell) == 2; });
  CHECK(twice > 80);
  for (const ClippedSurface::Patch& patch : cells.patches) {
    const auto& way = cells.flanks[patch.first_flank].normal;
    for (std::uint32_t k = patch.first_flank; k < patch.first_flank + patch.flanks; ++k) {
      const auto& n = cells.flanks[k].normal;
      CHECK(way[0] * n[0] + way[1] * n[1] + way[2] * n[2] > 0);
    }
  }
}

TEST_CASE("The same bits for any number of threads") {
  const GridLayout<3> layout = small_grid(0.25);
  for (const TriangleSurface& surface : surfaces()) {
    omp_set_num_threads(1);
    const ClippedSurface one = clipped(layout, surface);
    for (const int threads : {2, 3}) {
      omp_set_num_threads(threads);
      const ClippedSurface some = clipped(layout, surface);
      CHECK(some.inside == one.inside);
      CHECK(some.upper_face == one.upper_face);
      REQUIRE(some.flanks.size() == one.flanks.size());
      for (std::size_t k = 0; k < one.flanks.size(); ++k) {
        CHECK(some.flanks[k].spline == one.flanks[k].spline);
        CHECK(some.flanks[k].beside == one.flanks[k].beside);
      }
    }
    omp_set_num_threads(1);
  }
}

namespace {

/// The walls of a half or a quarter of the small grid.
const std::vector<std::vector<SurfaceEnd>> parts_of_space{{{0, false, 0}},
                                                          {{0, true, 0}},
                                                          {{1, false, 0}},
                                                          {{1, true, 0}},
                                                          {{2, false, 0}},
                                                          {{2, true, 0}},
                                                          {{0, true, 0}, {1, true, 0}}};

TriangleSurface cut_at(TriangleSurface surface, const std::vector<SurfaceEnd>& ends) {
  for (const SurfaceEnd& end : ends) surface = cut_off(std::move(surface), end, 0);
  return surface;
}

/// int grad N over the part of a whole cell inside, as the half of the cell in the domain has it.
Slope<3> folded(const GridLayout<3>& half, int flat, Slope<3> whole) {
  const std::array<int, 3> place = stored_cell(half, flat);
  constexpr std::array<int, 3> step{1, 3, 9};
  for (int axis = 0; axis < 3; ++axis) {
    if (!on_wall(half, axis, place[axis])) continue;
    const int beyond = place[axis] == half.pad ? 0 : 2;
    for (int n = 0; n < 27; ++n)
      for (int a = 0; a < 3; ++a) {
        const int at = n / step[axis] % 3;
        whole[n][a] *= at == beyond ? 0.0 : at == 1 ? 0.5 : 1.0;
      }
  }
  for (int n = 0; n < 27; ++n) {
    const auto held = held_by_walls(half, node_around(half, flat, n));
    for (int a = 0; a < 3; ++a)
      if (held[a]) whole[n][a] = 0;
  }
  return whole;
}

}  // namespace

TEST_CASE("A half and a quarter of a ball that ends at walls cut cells as the whole ball does in their planes") {
  const TriangleSurface ball = ellipsoid_surface({0, 0, 0}, {1, 0.8, 1.2}, 0.15);
  Grid<3> whole;
  whole.layout = small_grid(0.25);
  whole.outline = clipped(whole.layout, ball);
  std::map<std::array<double, 3>, CutCell<3>> of_whole;  // by place
  const auto place_of = [](const GridLayout<3>& layout, int flat) {
    const std::array<int, 3> cell = stored_cell(layout, flat);
    std::array<double, 3> x;
    for (int a = 0; a < 3; ++a) x[a] = layout.node(a, cell[a] - layout.pad);
    return x;
  };
  for (const CutCell<3>& cell : cut_cells_of(whole, membrane_of(ball)))
    of_whole[place_of(whole.layout, cell.flat)] = cell;
  for (const std::vector<SurfaceEnd>& ends : parts_of_space) {
    Grid<3> grid;
    grid.layout = small_grid(0.25, {}, ends);
    const TriangleSurface part = cut_at(ball, ends);
    const Membrane<3> membrane = membrane_of(part, ends);
    clip_surface(grid.layout, membrane, grid.outline);
    int at_walls = 0;
    for (const CutCell<3>& cell : cut_cells_of(grid, membrane)) {
      const CutCell<3>& other = of_whole.at(place_of(grid.layout, cell.flat));
      const Slope<3> expected = folded(grid.layout, cell.flat, other.inside);
      for (int n = 0; n < 27; ++n) {
        CHECK(std::abs(cell.value[n] - other.value[n]) < 1e-14);
        for (int a = 0; a < 3; ++a) CHECK(std::abs(cell.inside[n][a] - expected[n][a]) < 1e-13);
      }
      at_walls += far_from_walls<3>(grid.layout, 1, stored_cell(grid.layout, cell.flat)) ? 0 : 1;
    }
    CHECK(at_walls > 20);
  }
}

TEST_CASE("Shares of cells up to the walls at which a surface ends add up to what is inside, foul surfaces too") {
  const std::vector<RefineSpec> zones{{0, -0.3, 0.2, 0.1, 1.5, {}}, {2, 0.1, 0.4, 0.2, 1.2, {}}};
  for (const TriangleSurface& surface : surfaces())
    for (const bool graded : {false, true})
      for (const std::vector<SurfaceEnd>& ends :
           {std::vector<SurfaceEnd>{{1, false, 0}}, {{1, true, 0}}, {{1, false, -0.4}, {1, true, 0.4}}}) {
        const GridLayout<3> layout = small_grid(graded ? 0.4 : 0.2, graded ? zones : std::vector<RefineSpec>{}, ends);
        const TriangleSurface part = cut_at(surface, ends);
        ClippedSurface cells;
        clip_surface(layout, membrane_of(part, ends), cells);
        double sum = 0;
        for (std::size_t c = 0; c < cells.size(); ++c) {
          const int flat = flat_of(layout, cells, static_cast<int>(c));
          if (in_domain(layout, flat)) sum += cells.inside[c] * size_in_domain(layout, flat);
        }
        CHECK(sum == near(volume(with_fans(part, ends)), 1e-12));
        CHECK(enclosed_volume(membrane_of(part, ends)) == near(volume(with_fans(part, ends)), 1e-12));
      }
}
