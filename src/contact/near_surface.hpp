// Particles near a rigid surface, slab by slab (2D).
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <algorithm>

#include "rigid_surface.hpp"

namespace geodrop {

/// 0 where a particle of half width `reach` [m] just touches, 1 from a depth of a hundredth of that on: what holds for
/// particles that touch sets in without a jump, which round-off would decide about.
inline double touch_share(double gap, double reach) {
  constexpr double all = 0.01;
  return std::clamp((reach - gap) / (all * reach), 0.0, 1.0);
}

/// Whether particles of a slab may be closer to the surface than a cell: a cell of motion since the sort is included.
inline bool slab_is_near(const RigidSurface& surface, const GridLayout<2>& layout, int slab) {
  const double reach = layout.h;  // no particle is wider
  const auto level = [&](int row) {
    return layout.node(1, std::clamp(row, -GridLayout<2>::pad, layout.cells[1] + GridLayout<2>::pad - 1));
  };
  const Vec<2> lower(layout.lower[0], level(slab * slab_width<2> - 2));
  const Vec<2> upper(layout.upper[0], level((slab + 1) * slab_width<2> + 1));
  return surface.may_touch(lower, upper, reach);
}

/// f(particle, slab) for those that are closer to the surface than `reach`, by id [m]; each slab on one thread.
template <class F>
void for_each_near(const RigidSurface& surface, const GridLayout<2>& layout, const Body<2>& body,
                   const Array<double>& reach, F&& f) {
  const auto slabs = static_cast<std::ptrdiff_t>(body.slab_begin.size()) - 1;
#pragma omp parallel for schedule(static) if (body.size() > 1000)
  for (std::ptrdiff_t s = 0; s < slabs; ++s) {
    const std::size_t begin = body.slab_begin[s], end = body.slab_begin[s + 1];
    if (begin == end || !slab_is_near(surface, layout, static_cast<int>(s))) continue;
    for (std::size_t p = begin; p < end; ++p)
      if (const Vec<2> x = vector_at(body.x, p); surface.may_touch(x, x, reach[body.id[p]])) f(p, s);
  }
}

}  // namespace geodrop
