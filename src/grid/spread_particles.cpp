#include "spread_particles.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/fixed_order_sum.hpp"
#include "neighbourhood.hpp"
#include "within_walls.hpp"

namespace geodrop {
namespace {

constexpr int passes = 2;
constexpr double share_of_overlap = 0.25;  // that a pass takes from each of two particles
constexpr double longest_push = 0.1;       // of the size of a particle
constexpr double least_part = 1e-9;        // of a cell: less is round-off

/// Points in grid coordinates: the particles of a body, then their images.
template <int Dim>
struct Points {
  std::array<Array<double>, Dim> q;  ///< [cells]
  Array<double> size;                ///< [cells]

  std::size_t count() const { return size.size(); }
  void resize(std::size_t n) {
    for (Array<double>& coordinate : q) coordinate.resize(n);
    size.resize(n);
  }
};

/// An image of a point or of an earlier image along one axis: q = offset + sense q_source.
struct Image {
  std::uint32_t source;
  int axis;
  double sense, offset;
};

/// Width of the span of a node [m].
template <int Dim>
double width(const GridLayout<Dim>& layout, int axis, int node) {
  return layout.span_width(axis, node) * layout.h;
}

/// Whether particles of a cell stay where they are: within two cells of a surface, beside a rigid body, whose contact
/// force they would be pushed against, and where another body has a part of the cell.
template <int Dim>
bool is_held(const Grid<Dim>& grid, const std::array<int, Dim>& node) {
  std::array<int, Dim> cell = node;
  for (int& coordinate : cell) coordinate += GridLayout<Dim>::pad;
  bool held = false;
  for_neighbourhood(grid.layout, 0, [&](int, const std::array<int, Dim>& a) {
    const int other = mirrored<Dim>(grid.layout, cell, a);
    held = held || !(grid.cell_flags[other] & cell_shiftable) ||
           (!grid.rigid_cells.empty() && grid.rigid_cells[other] > least_part);
  });
  const int flat = grid.layout.index(node);
  return held || (!grid.taken.empty() && grid.taken[flat] > least_part) ||
         (!grid.occupied.empty() && grid.occupied[flat] > 0);
}

/// Places and sizes of the particles of a body; returns which of them may move.
template <int Dim>
Array<std::uint8_t> find_points(const Grid<Dim>& grid, const Body<Dim>& body, Points<Dim>& points) {
  const GridLayout<Dim>& layout = grid.layout;
  const auto n = static_cast<std::ptrdiff_t>(body.size());
  Array<std::uint8_t> free(body.size());
  points.resize(body.size());
  const double density = reference_density(body.material);
  int last = -1;  // the cell of the particle before
  bool held = true;
#pragma omp parallel for schedule(static) firstprivate(last, held)
  for (std::ptrdiff_t p = 0; p < n; ++p) {
    std::array<int, Dim> cell;
    double measure = 1;
    for (int a = 0; a < Dim; ++a) {
      const double x = layout.wrapped(a, body.x[a][p]);
      cell[a] = layout.base(a, x);
      const double w = width(layout, a, cell[a]);
      points.q[a][p] = cell[a] + (x - layout.node(a, cell[a])) / w;
      measure *= w;
    }
    const double share = body.mass[p] * body.J[p] / (density * measure);
    points.size[p] = Dim == 2 ? std::sqrt(share) : std::cbrt(share);
    if (const int flat = layout.index(cell); flat != last) {
      last = flat;
      held = is_held<Dim>(grid, cell);
    }
    free[p] = !held;
  }
  return free;
}

/// Brings an image to where its source has gone.
template <int Dim>
void follow_source(const Image& image, std::size_t at, Points<Dim>& points) {
  for (int a = 0; a < Dim; ++a) points.q[a][at] = points.q[a][image.source];
  points.q[image.axis][at] = image.offset + image.sense * points.q[image.axis][image.source];
}

/// Adds the images of points closer than `reach` to a wall or a seam.
template <int Dim>
std::vector<Image> add_images(const GridLayout<Dim>& layout, double reach, Points<Dim>& points) {
  std::vector<Image> images;
  for (int axis = 0; axis < Dim; ++axis) {
    const double last = layout.cells[axis];
    const auto n = static_cast<std::uint32_t>(points.count());
    for (std::uint32_t p = 0; p < n; ++p)
      for (const double side : {0.0, last}) {
        if (std::abs(points.q[axis][p] - side) >= reach) continue;
        images.push_back(layout.periodic(axis) ? Image{p, axis, 1, side == 0 ? last : -last}
                                               : Image{p, axis, -1, 2 * side});
        points.resize(points.count() + 1);
        points.size.back() = points.size[p];
        follow_source(images.back(), points.count() - 1, points);
      }
  }
  return images;
}

/// Points sorted into bins, in rows along x and with empty ones around.
template <int Dim>
class Bins {
 public:
  Bins(const Points<Dim>& points, double per_cell) {
    std::array<int, Dim> first;
    std::ptrdiff_t bins = 1;
    const auto bin_of = [&](double q) { return static_cast<int>(std::floor(q * per_cell)); };
    for (int a = 0; a < Dim; ++a) {
      const auto [least, most] = std::minmax_element(points.q[a].begin(), points.q[a].end());
      first[a] = bin_of(*least) - 1;
      stride_[a] = bins;
      bins *= bin_of(*most) - first[a] + 2;
    }
    const std::size_t n = points.count();
    Array<std::uint32_t> keys(n);
    begin_.assign(bins + 1, 0);
#pragma omp parallel for schedule(static)
    for (std::size_t p = 0; p < n; ++p) {
      std::ptrdiff_t key = 0;
      for (int a = 0; a < Dim; ++a) key += (bin_of(points.q[a][p]) - first[a]) * stride_[a];
      keys[p] = static_cast<std::uint32_t>(key);
    }
    for (const std::uint32_t key : keys) ++begin_[key + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    Array<std::uint32_t> next(begin_);
    id_.resize(n);
    for (std::size_t p = 0; p < n; ++p) id_[next[keys[p]]++] = static_cast<std::uint32_t>(p);
    sorted_.resize(n);
    for (std::size_t k = 0; k < n; ++k) sorted_.size[k] = points.size[id_[k]];
  }

  std::ptrdiff_t count() const { return static_cast<std::ptrdiff_t>(begin_.size()) - 1; }
  std::size_t begin(std::ptrdiff_t bin) const { return begin_[bin]; }
  std::size_t end(std::ptrdiff_t bin) const { return begin_[bin + 1]; }
  std::uint32_t id(std::size_t k) const { return id_[k]; }  ///< of the sorted point k
  const Points<Dim>& sorted() const { return sorted_; }

  /// Takes the present places of the points; they stay in their bins.
  void take_places(const Points<Dim>& points) {
    const auto n = static_cast<std::ptrdiff_t>(id_.size());
    for (int a = 0; a < Dim; ++a)
#pragma omp parallel for schedule(static)
      for (std::ptrdiff_t k = 0; k < n; ++k) sorted_.q[a][k] = points.q[a][id_[k]];
  }

  /// f(begin, end) for the sorted points of each row of the bins around one that is not at the margin.
  template <class F>
  void for_rows_around(std::ptrdiff_t bin, F&& f) const {
    for (int z = Dim == 3 ? -1 : 0; z <= (Dim == 3 ? 1 : 0); ++z)
      for (int y = -1; y <= 1; ++y) {
        const std::ptrdiff_t row = bin + y * stride_[1] + (Dim == 3 ? z * stride_[Dim - 1] : 0);
        f(begin(row - 1), end(row + 1));
      }
  }

 private:
  std::array<std::ptrdiff_t, Dim> stride_{};
  Array<std::uint32_t> begin_, id_;
  Points<Dim> sorted_;
};

/// What pushes the sorted point k of a bin [cells].
template <int Dim>
std::array<double, Dim> push_on(const Bins<Dim>& bins, std::ptrdiff_t bin, std::size_t k) {
  const Points<Dim>& points = bins.sorted();
  std::array<double, Dim> at, push{};
  for (int a = 0; a < Dim; ++a) at[a] = points.q[a][k];
  const double size = points.size[k];
  bins.for_rows_around(bin, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      std::array<double, Dim> r;
      double square = 0;
      for (int a = 0; a < Dim; ++a) {
        r[a] = at[a] - points.q[a][j];
        square += r[a] * r[a];
      }
      const double range = 0.5 * (size + points.size[j]);
      if (square >= range * range || square == 0) continue;
      const double share = share_of_overlap * (range / std::sqrt(square) - 1);
      for (int a = 0; a < Dim; ++a) push[a] += share * r[a];
    }
  });
  double square = 0;
  for (const double component : push) square += component * component;
  const double longest = longest_push * size;
  if (square > longest * longest)
    for (double& component : push) component *= longest / std::sqrt(square);
  return push;
}

/// Moves the free points by what pushes them.
template <int Dim>
void push_once(const Array<std::uint8_t>& free, const std::vector<Image>& images, Bins<Dim>& bins,
               Points<Dim>& points) {
  bins.take_places(points);
  const std::ptrdiff_t n = bins.count();
#pragma omp parallel for schedule(dynamic, 256)
  for (std::ptrdiff_t bin = 0; bin < n; ++bin)
    for (std::size_t k = bins.begin(bin); k < bins.end(bin); ++k) {
      const std::uint32_t p = bins.id(k);
      if (p >= free.size() || !free[p]) continue;
      const std::array<double, Dim> push = push_on(bins, bin, k);
      for (int a = 0; a < Dim; ++a) points.q[a][p] += push[a];
    }
  for (std::size_t i = 0; i < images.size(); ++i) follow_source(images[i], free.size() + i, points);
}

/// x += w dq, not beyond a wall, and v += C dx.
template <int Dim>
void move_particle(const GridLayout<Dim>& layout, const std::array<double, Dim>& dq, std::size_t p, Body<Dim>& body) {
  std::array<double, Dim> dx;
  for (int a = 0; a < Dim; ++a) {
    const double x = body.x[a][p];
    const double to = within_walls(layout, a, x + dq[a] * width(layout, a, layout.base(a, layout.wrapped(a, x))));
    dx[a] = to - x;
    body.x[a][p] = to;
  }
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) body.v[a][p] += body.affine[a * Dim + b][p] * dx[b];
}

}  // namespace

template <int Dim>
void spread_particles(const Grid<Dim>& grid, Body<Dim>& body) {
  if (body.size() == 0) return;
  Points<Dim> points;
  const Array<std::uint8_t> free = find_points(grid, body, points);
  const std::array<Array<double>, Dim> start = points.q;
  const double sizes = fixed_order_sum<double>(body.size(), [&](double& sum, std::size_t p) { sum += points.size[p]; });
  // A cell has a whole number of bins; what is larger than a bin pushes as if it were as large.
  const double per_cell = std::max(1.0, std::round(body.size() / sizes));
  for (double& size : points.size) size = std::min(size, 1 / per_cell);
  const std::vector<Image> images = add_images(grid.layout, 1 / per_cell, points);
  Bins<Dim> bins(points, per_cell);
  for (int pass = 0; pass < passes; ++pass) push_once(free, images, bins, points);

  const auto n = static_cast<std::ptrdiff_t>(body.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t p = 0; p < n; ++p) {
    if (!free[p]) continue;
    std::array<double, Dim> dq;
    for (int a = 0; a < Dim; ++a) dq[a] = points.q[a][p] - start[a][p];
    move_particle<Dim>(grid.layout, dq, p, body);
  }
}

template <int Dim>
void spread_particles_if_due(State<Dim>& state, const Grids<Dim>& grids) {
  if (!(state.drift >= spread_every_cells * grids.front().layout.finest) || !std::isfinite(state.drift)) return;
  for (Body<Dim>& body : state.bodies)
    if (body.shift && body.field != waiting) spread_particles(grids[body.field], body);
  state.drift = -1;
}

#define GEODROP_INSTANTIATE(D)                                 \
  template void spread_particles<D>(const Grid<D>&, Body<D>&); \
  template void spread_particles_if_due<D>(State<D>&, const Grids<D>&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
