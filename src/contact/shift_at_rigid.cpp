#include "shift_at_rigid.hpp"

#include <geodrop/base/find_named.hpp>

#include <algorithm>
#include <cmath>

#include "grid/blocks.hpp"
#include "grid/point_support.hpp"
#include "grid/seams.hpp"
#include "near_surface.hpp"
#include "rigid_surface.hpp"

namespace geodrop {
namespace {

/// Parts of a cell per axis. A part that the surface crosses counts by the depth of its middle: the share of a plane
/// along the grid is exact, and that of one that moves does not jump.
constexpr int parts = 4;

/// Share of a part of the width w whose middle is `gap` above the surface.
double share_below(const RigidSurface::Gap& gap, const Vec<2>& width) {
  return std::clamp(0.5 - gap.size / gap.normal.cwiseAbs().dot(width), 0.0, 1.0);
}

/// Adds what the rigid body has of one cell.
class CellShare {
 public:
  CellShare(const RigidSurface& surface, Grid<2>& grid) : surface_(surface), grid_(grid) {}

  void add(int flat, const std::array<int, 2>& cell) {
    const GridLayout<2>& layout = grid_.layout;
    constexpr int pad = GridLayout<2>::pad;
    const Vec<2> width = Vec<2>(layout.span_width(0, cell[0] - pad), layout.span_width(1, cell[1] - pad)) * layout.h;
    const Vec<2> middle(layout.node(0, cell[0] - pad), layout.node(1, cell[1] - pad));
    const auto there = surface_.gap(middle, 0);
    if (!there || there->size > 0.5 * width.norm()) return;
    double inside = 0;
    int of_domain = 0;
    for (int j = 0; j < parts; ++j)
      for (int i = 0; i < parts; ++i) {
        const Vec<2> x = middle + width.cwiseProduct(Vec<2>(i + 0.5, j + 0.5) / parts - Vec<2>(0.5, 0.5));
        if (!in_domain(x)) continue;
        ++of_domain;
        const double share = share_at(x, width / parts);
        inside += share;
        if (share > 0) add_to_splines(x, share * width.prod() / (parts * parts));
      }
    if (of_domain > 0) grid_.rigid_cells[flat] = std::min(1.0, grid_.rigid_cells[flat] + inside / of_domain);
  }

 private:
  bool in_domain(const Vec<2>& x) const {
    for (int a = 0; a < 2; ++a)
      if (x[a] < grid_.layout.lower[a] || x[a] > grid_.layout.upper[a]) return false;
    return true;
  }
  /// Deep in a capsule there is no gap.
  double share_at(const Vec<2>& x, const Vec<2>& width) const {
    const auto gap = surface_.gap(x, 0);
    return gap ? share_below(*gap, width) : 1.0;
  }
  void add_to_splines(const Vec<2>& x, double area) {
    constexpr double no_width = 0;
    const PointSupport<2> support(grid_.layout, {x[0], x[1]}, no_width);
    support.for_each_node(grid_.layout,
                          [&](int node, double weight) { grid_.rigid_splines[image(node)] += weight * area; });
  }
  /// Ghosts beyond walls stand for their mirror images.
  int image(int flat) const {
    const GridLayout<2>& layout = grid_.layout;
    std::array<int, 2> node{flat % layout.stride[1] - layout.pad, flat / layout.stride[1] - layout.pad};
    for (int a = 0; a < 2; ++a) {
      if (layout.periodic(a)) continue;
      if (node[a] < 0) node[a] = -node[a];
      if (node[a] > layout.cells[a]) node[a] = 2 * layout.cells[a] - node[a];
    }
    return layout.index(node);
  }

  const RigidSurface& surface_;
  Grid<2>& grid_;
};

void add_share(const RigidSurface& surface, Grid<2>& grid) {
  const GridLayout<2>& layout = grid.layout;
  CellShare share(surface, grid);
  // Rows one after the other: cells share splines.
  for (const std::uint32_t block : grid.active_blocks)
    for_each_real_row_of_block(layout, block, [&](int begin, int count, std::array<int, 2> cell) {
      const auto place = [&](int k) {
        return Vec<2>(layout.node(0, cell[0] + k - layout.pad), layout.node(1, cell[1] - layout.pad));
      };
      if (!surface.may_touch(place(0), place(count - 1), layout.h)) return;
      for (int k = 0; k < count; ++k, ++cell[0]) share.add(begin + k, cell);
    });
}

/// dx = -w dt (|v| + v0) grad phi in shiftable cells, as in transfer/gather; w the width of the span.
Vec<2> shift_of(const Grid<2>& grid, const Body<2>& body, std::size_t p, double dt) {
  const GridLayout<2>& layout = grid.layout;
  const AxisSupport x = support_along(layout, 0, body.x[0][p], body.half_size);
  const AxisSupport y = support_along(layout, 1, body.x[1][p], body.half_size);
  const int base = layout.index({x.base, y.base});
  if (!(grid.cell_flags[base] & cell_shiftable)) return Vec<2>::Zero();
  const double wx[3] = {x.n.w0, x.n.w1, x.n.w2}, gx[3] = {x.n.g0, x.n.g1, x.n.g2};
  const double wy[3] = {y.n.w0, y.n.w1, y.n.w2}, gy[3] = {y.n.g0, y.n.g1, y.n.g2};
  Vec<2> slope = Vec<2>::Zero();
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      slope += grid.velocity[base + i - 1 + (j - 1) * layout.stride[1]][3] * Vec<2>(gx[i] * wy[j], wx[i] * gy[j]);
  if (!layout.graded()) slope *= layout.inv_h;
  const Vec<2> width = Vec<2>(layout.span_width(0, x.base), layout.span_width(1, y.base)) * layout.h;
  return -dt * (vector_at(body.v, p).norm() + body.shift_speed) * width.cwiseProduct(slope);
}

}  // namespace

void find_rigid_share(const State<2>& state, Grid<2>& grid) {
  if (grid.rigid_cells.empty()) return;
  for (Array<double>* values : {&grid.rigid_cells, &grid.rigid_splines}) std::fill(values->begin(), values->end(), 0.0);
  std::vector<std::string> done;
  for (const RigidContact<2>& contact : state.rigid_contacts) {
    if (!contact.bare || find_named(state.bodies, contact.touching).field != grid.field) continue;
    if (std::find(done.begin(), done.end(), contact.rigid) != done.end()) continue;
    done.push_back(contact.rigid);
    if (const RigidBody<2>& rigid = find_named(state.rigid, contact.rigid); rigid.present)
      add_share(RigidSurface(rigid), grid);
  }
  for_each_seam(grid.layout, [&](int axis) {
    copy_over_seam(grid.layout, axis, grid.rigid_cells);
    sum_over_seam(grid.layout, axis, grid.rigid_splines);
  });
}

void hold_shift(State<2>& state, const Grid<2>& grid, double dt) {
  for (const RigidContact<2>& contact : state.rigid_contacts) {
    if (!contact.bare || contact.points.empty()) continue;
    Body<2>& body = find_named(state.bodies, contact.touching);
    if (body.field != grid.field || !body.shift) continue;
    const RigidSurface surface(find_named(state.rigid, contact.rigid));
    for_each_near(surface, grid.layout, body, contact.half_width, [&](std::size_t p, std::ptrdiff_t) {
      const auto known = std::lower_bound(contact.points.begin(), contact.points.end(), body.id[p]);
      if (known == contact.points.end() || *known != body.id[p]) return;
      const double width = contact.half_width[body.id[p]];
      Vec<2> shift = shift_of(grid, body, p, dt);
      const auto touch = surface.touch(vector_at(body.x, p), contact.side[known - contact.points.begin()], width);
      for (const SurfaceGap& face : touch) {
        const double out = touch_share(face.size, width) * face.normal.dot(shift);
        shift -= out * face.normal;
        for (int a = 0; a < 2; ++a) body.x[a][p] -= out * face.normal[a];
      }
    });
  }
}

}  // namespace geodrop
