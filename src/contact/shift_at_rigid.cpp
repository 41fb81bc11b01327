#include "shift_at_rigid.hpp"

#include <geodrop/base/find_named.hpp>

#include <algorithm>
#include <cmath>

#include "grid/point_support.hpp"
#include "near_surface.hpp"
#include "rigid_surface.hpp"

namespace geodrop {
namespace {

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

void find_held_shifts(const State<2>& state, Grid<2>& grid, double dt) {
  grid.held_shifts.clear();
  for (const RigidContact<2>& contact : state.rigid_contacts) {
    if (!contact.bare || contact.points.empty()) continue;
    const Body<2>& body = find_named(state.bodies, contact.touching);
    if (body.field != grid.field || !body.shift) continue;
    const auto index = static_cast<std::size_t>(&body - state.bodies.data());
    const RigidSurface surface(find_named(state.rigid, contact.rigid));
    std::vector<std::vector<HeldShift<2>>> of_slab(body.slab_begin.size());
    for_each_near(surface, grid.layout, body, contact.half_width, [&](std::size_t p, std::ptrdiff_t slab) {
      const auto known = std::lower_bound(contact.points.begin(), contact.points.end(), body.id[p]);
      if (known == contact.points.end() || *known != body.id[p]) return;
      const double width = contact.half_width[body.id[p]];
      const Vec<2> whole = shift_of(grid, body, p, dt);
      Vec<2> shift = whole;
      const auto touch = surface.touch(vector_at(body.x, p), contact.side[known - contact.points.begin()], width);
      for (const SurfaceGap& face : touch)
        shift -= touch_share(face.size, width) * face.normal.dot(shift) * face.normal;
      const Vec<2> held = whole - shift;
      of_slab[slab].push_back({index, p, {held[0], held[1]}});
    });
    for (const auto& some : of_slab) grid.held_shifts.insert(grid.held_shifts.end(), some.begin(), some.end());
  }
}

void hold_shifts(State<2>& state, const Grid<2>& grid) {
  for (const HeldShift<2>& held : grid.held_shifts) {
    Body<2>& body = state.bodies[held.body];
    for (int a = 0; a < 2; ++a) {
      body.x[a][held.particle] -= held.shift[a];
      for (int b = 0; b < 2; ++b) body.v[a][held.particle] -= body.affine[a * 2 + b][held.particle] * held.shift[b];
    }
  }
}

}  // namespace geodrop
