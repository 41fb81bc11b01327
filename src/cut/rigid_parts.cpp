#include "rigid_parts.hpp"

#include <geodrop/base/find_named.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cell_slopes.hpp"
#include "contact/rigid_surface.hpp"
#include "geometry/triangle_rule.hpp"
#include "grid/blocks.hpp"
#include "grid/seams.hpp"
#include "outline_pieces.hpp"

namespace geodrop {
namespace {

/// Parts of a cell per axis, in each of which a surface counts as straight.
constexpr int parts = 4;

/// int N [m] and int N' of the nodes below, at and above a span over one of its parts.
struct PartOfSpan {
  std::array<double, 3> value, slope;
};
PartOfSpan part_of_span(const SpanShape& span, int part) {
  const double from = part / double(parts) - 0.5, to = from + 1.0 / parts;
  const std::array<double, 3> before = integrals_to(span, from), after = integrals_to(span, to);
  const auto below = [&](double z) { return span.below * (0.5 - z) * (0.5 - z); };
  const auto above = [&](double z) { return span.above * (0.5 + z) * (0.5 + z); };
  const double down = below(to) - below(from), up = above(to) - above(from);
  PartOfSpan of{{}, {down, -down - up, up}};
  for (int n = 0; n < 3; ++n) of.value[n] = span.width * (after[n] - before[n]);
  return of;
}

/// The corners of a box that are below a surface, and where that cuts its edges.
std::vector<Vec<2>> below_surface(const Vec<2>& middle, const Vec<2>& width, const RigidSurface::Gap& gap) {
  constexpr std::array<std::array<double, 2>, 4> corners{{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}};
  std::vector<Vec<2>> polygon;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec<2> from = width.cwiseProduct(Vec<2>(corners[k].data()));
    const Vec<2> to = width.cwiseProduct(Vec<2>(corners[(k + 1) % 4].data()));
    const double at_from = gap.size + gap.normal.dot(from), at_to = gap.size + gap.normal.dot(to);
    if (at_from < 0) polygon.push_back(middle + from);
    if ((at_from < 0) != (at_to < 0)) polygon.push_back(middle + from + at_from / (at_from - at_to) * (to - from));
  }
  return polygon;
}

/// What rigid bodies have of one cell after the other.
class CellParts {
 public:
  CellParts(const std::vector<RigidSurface>& surfaces, Grid<2>& grid) : surfaces_(surfaces), grid_(grid) {}

  void add(int flat, const std::array<int, 2>& cell) {
    const GridLayout<2>& layout = grid_.layout;
    const std::array<SpanShape, 2> spans{layout.span_shape(0, cell[0]), layout.span_shape(1, cell[1])};
    const Vec<2> width(spans[0].width, spans[1].width);
    const Vec<2> middle(middle_of(0, cell[0]), middle_of(1, cell[1]));
    find_near(middle, width);
    if (near_.empty()) return;
    part_ = {flat, {}, {}, {outward_[0], outward_[1]}};
    area_ = 0;
    std::array<std::array<PartOfSpan, parts>, 2> along;
    for (int a = 0; a < 2; ++a)
      for (int k = 0; k < parts; ++k) along[a][k] = part_of_span(spans[a], k);
    for (int j = 0; j < parts; ++j)
      for (int i = 0; i < parts; ++i) {
        const Vec<2> x = middle + width.cwiseProduct(Vec<2>(i + 0.5, j + 0.5) / parts - Vec<2>(0.5, 0.5));
        if (in_domain(x)) add_box({along[0][i], along[1][j]}, cell, x, width / parts);
      }
    if (area_ == 0) return;
    grid_.rigid_cells[flat] = std::min(1.0, area_ / size_in_domain(layout, flat));
    for (int n = 0; n < nodes_around<2>; ++n)
      grid_.rigid_splines[mirrored<2>(layout, cell, {n % 3, n / 3})] += part_.value[n];
    fold_at_walls(layout, flat, part_.slope);
    grid_.rigid_parts.push_back(part_);
  }

 private:
  double middle_of(int axis, int stored) const {
    const GridLayout<2>& layout = grid_.layout;
    if (!layout.graded()) return layout.node(axis, stored - layout.pad);
    return layout.knots[axis][stored].left + 0.5 * layout.knots[axis][stored].width;
  }
  void find_near(const Vec<2>& middle, const Vec<2>& width) {
    near_.clear();
    double nearest = std::numeric_limits<double>::infinity();
    for (const RigidSurface& surface : surfaces_) {
      if (!surface.may_touch(middle, middle, 0.5 * width.norm())) continue;
      near_.push_back(&surface);
      const auto gap = surface.gap(middle, 0);
      if (!gap || !(gap->size < nearest)) continue;
      nearest = gap->size;
      outward_ = gap->normal;
    }
  }
  bool in_domain(const Vec<2>& x) const {
    for (int a = 0; a < 2; ++a)
      if (x[a] < grid_.layout.lower[a] || x[a] > grid_.layout.upper[a]) return false;
    return true;
  }
  /// Of the surface that is deepest there; deep in a capsule there is none.
  std::optional<RigidSurface::Gap> deepest(const Vec<2>& x) const {
    std::optional<RigidSurface::Gap> deepest;
    for (const RigidSurface* surface : near_) {
      const auto gap = surface->gap(x, 0);
      if (!gap) return std::nullopt;
      if (!deepest || gap->size < deepest->size) deepest = gap;
    }
    return deepest;
  }
  void add_box(const std::array<PartOfSpan, 2>& box, const std::array<int, 2>& cell, const Vec<2>& middle,
               const Vec<2>& width) {
    const auto gap = deepest(middle);
    const double reach = gap ? 0.5 * gap->normal.cwiseAbs().dot(width) : 0.0;
    if (gap && gap->size >= reach) return;
    if (gap && gap->size > -reach) return add_polygon(cell, below_surface(middle, width, *gap));
    area_ += width.prod();
    for (int n = 0; n < nodes_around<2>; ++n) {
      part_.value[n] += box[0].value[n % 3] * box[1].value[n / 3];
      part_.slope[n][0] += box[0].slope[n % 3] * box[1].value[n / 3];
      part_.slope[n][1] += box[0].value[n % 3] * box[1].slope[n / 3];
    }
  }
  void add_polygon(const std::array<int, 2>& cell, const std::vector<Vec<2>>& corners) {
    for (std::size_t k = 2; k < corners.size(); ++k) {
      const Vec<2> u = corners[k - 1] - corners[0], v = corners[k] - corners[0];
      const double area = 0.5 * (u[0] * v[1] - u[1] * v[0]);
      area_ += area;
      for (const TrianglePoint& q : triangle_degree_4)
        add_point(cell, corners[0] + q.share[1] * u + q.share[2] * v, q.weight * area);
    }
  }
  void add_point(const std::array<int, 2>& cell, const Vec<2>& x, double area) {
    const GridLayout<2>& layout = grid_.layout;
    const ThreeWeights u = weights_in(layout, 0, cell[0], x[0]), v = weights_in(layout, 1, cell[1], x[1]);
    const double per_metre = layout.graded() ? 1.0 : layout.inv_h;
    const double value_x[] = {u.w0, u.w1, u.w2}, value_y[] = {v.w0, v.w1, v.w2};
    const double slope_x[] = {u.g0, u.g1, u.g2}, slope_y[] = {v.g0, v.g1, v.g2};
    for (int n = 0; n < nodes_around<2>; ++n) {
      part_.value[n] += area * value_x[n % 3] * value_y[n / 3];
      part_.slope[n][0] += area * per_metre * slope_x[n % 3] * value_y[n / 3];
      part_.slope[n][1] += area * per_metre * value_x[n % 3] * slope_y[n / 3];
    }
  }

  const std::vector<RigidSurface>& surfaces_;
  Grid<2>& grid_;
  std::vector<const RigidSurface*> near_;
  Vec<2> outward_ = Vec<2>::Zero();
  RigidPart<2> part_;
  double area_ = 0;
};

/// Whether a contact is of a fluid of this grid whose cells have a pressure.
bool of_fluid(const State<2>& state, const Grid<2>& grid, const RigidContact<2>& contact) {
  if (!contact.bare) return false;
  const Body<2>& body = find_named(state.bodies, contact.touching);
  return body.field == grid.field && body.pressure == PressureSupport::cell &&
         std::holds_alternative<Newtonian>(body.material);
}

/// Of the rigid bodies that are there and that fluids of a grid may touch, each once.
std::vector<RigidSurface> surfaces_of(const State<2>& state, const Grid<2>& grid) {
  std::vector<std::string> done;
  std::vector<RigidSurface> surfaces;
  for (const RigidContact<2>& contact : state.rigid_contacts) {
    if (!of_fluid(state, grid, contact)) continue;
    if (std::find(done.begin(), done.end(), contact.rigid) != done.end()) continue;
    done.push_back(contact.rigid);
    if (const RigidBody<2>& rigid = find_named(state.rigid, contact.rigid); rigid.present) surfaces.emplace_back(rigid);
  }
  return surfaces;
}

}  // namespace

void find_rigid_parts(const State<2>& state, Grid<2>& grid) {
  if (grid.rigid_cells.empty()) return;
  grid.rigid_parts.clear();
  for (Array<double>* values : {&grid.rigid_cells, &grid.rigid_splines, &grid.rigid_filled})
    std::fill(values->begin(), values->end(), 0.0);
  const std::vector<RigidSurface> surfaces = surfaces_of(state, grid);
  const GridLayout<2>& layout = grid.layout;
  CellParts cells(surfaces, grid);
  // Rows one after the other: cells share splines.
  for (const std::uint32_t block : grid.active_blocks)
    for_each_real_row_of_block(layout, block, [&](int begin, int count, std::array<int, 2> cell) {
      const auto place = [&](int k) {
        return Vec<2>(layout.node(0, cell[0] + k - layout.pad), layout.node(1, cell[1] - layout.pad));
      };
      const bool near = std::any_of(surfaces.begin(), surfaces.end(), [&](const RigidSurface& surface) {
        return surface.may_touch(place(0), place(count - 1), layout.h);
      });
      for (int k = 0; near && k < count; ++k, ++cell[0]) cells.add(begin + k, cell);
    });
  for_each_seam(layout, [&](int axis) {
    copy_over_seam(layout, axis, grid.rigid_cells);
    sum_over_seam(layout, axis, grid.rigid_splines);
  });
}

}  // namespace geodrop
