// The sites that particles are put on: an even lattice, aligned with the cells of the grid.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <geodrop/geometry/shapes.hpp>
#include <geodrop/grid/graded_axis.hpp>
#include <geodrop/scene/scene.hpp>
#include <vector>

namespace geodrop {

/// The sites of the lattice that a body's bounds reach.
template <int Dim>
class Lattice {
 public:
  Lattice(const Scene& scene, const BodySpec& spec)
      : origin_(scene.grid.lower),
        width_(scene.grid.spacing / spec.particles_per_cell_axis),
        per_cell_(spec.particles_per_cell_axis) {
    for (int a = 0; a < Dim; ++a) {
      maps_.emplace_back(scene.grid, a);
      find_edges(a);
    }
    constexpr double rounding = 1e-9;
    const Bounds box = bounds(spec.shape);
    for (int a = 0; a < Dim; ++a) {
      const double low = std::max(box.lower[a], origin_[a]), high = std::min(box.upper[a], scene.grid.upper[a]);
      first_[a] = static_cast<std::int64_t>(std::floor(site_at(a, low) + rounding));
      const auto end = static_cast<std::int64_t>(std::ceil(site_at(a, high) - rounding));
      count_[a] = std::max<std::int64_t>(0, end - first_[a]);
    }
  }

  /// Widths of a site along the axes [m].
  std::array<double, Dim> widths(std::int64_t site) const {
    std::array<double, Dim> width;
    for (int a = 0; a < Dim; site /= count_[a], ++a) width[a] = width_of(a, first_[a] + site % count_[a]);
    return width;
  }
  double volume(std::int64_t site) const {
    if (uniform()) return std::pow(width_, Dim);
    double product = 1;
    for (const double width : widths(site)) product *= width;
    return product;
  }
  std::int64_t size() const {
    std::int64_t total = 1;
    for (const std::int64_t n : count_) total *= n;
    return total;
  }

  void get_site(std::int64_t site, Bounds& out) const {
    for (int a = 0; a < Dim; site /= count_[a], ++a) {
      const std::int64_t i = first_[a] + site % count_[a];
      const double centre = edges_[a].empty() ? origin_[a] + (static_cast<double>(i) + 0.5) * width_
                                              : (edges_[a][i] + edges_[a][i + 1]) / 2;
      out.lower[a] = centre - width_of(a, i) / 2;
      out.upper[a] = centre + width_of(a, i) / 2;
    }
  }

  /// Sites come in blocks of up to `block_width` along each axis.
  std::int64_t blocks() const {
    std::int64_t total = 1;
    for (const std::int64_t n : count_) total *= blocks_along(n);
    return total;
  }
  std::int64_t block_of(std::int64_t site) const {
    std::int64_t block = 0, stride = 1;
    for (int a = 0; a < Dim; site /= count_[a], stride *= blocks_along(count_[a]), ++a)
      block += site % count_[a] / block_width * stride;
    return block;
  }
  /// The box of a block; at the ends of the lattice it reaches beyond the sites.
  Bounds block_box(std::int64_t block) const {
    Bounds box{Point(Dim), Point(Dim)};
    for (int a = 0; a < Dim; block /= blocks_along(count_[a]), ++a) {
      const std::int64_t first = first_[a] + block % blocks_along(count_[a]) * block_width;
      box.lower[a] = edge(a, first);
      box.upper[a] = edge(a, first + block_width);
    }
    return box;
  }

  /// Calls f(neighbour) for the up to 3^Dim - 1 sites around one.
  template <class F>
  void for_each_neighbour(std::int64_t site, F&& f) const {
    constexpr int around = Dim == 2 ? 9 : 27;
    for (int k = 0; k < around; ++k) {
      std::int64_t other = 0, stride = 1, rest = site;
      bool exists = true;
      for (int a = 0, step = k; a < Dim; rest /= count_[a], stride *= count_[a], step /= 3, ++a) {
        const std::int64_t i = rest % count_[a] + step % 3 - 1;
        exists = exists && i >= 0 && i < count_[a];
        other += i * stride;
      }
      if (exists && other != site) f(other);
    }
  }

 private:
  static constexpr std::int64_t block_width = 8;
  static std::int64_t blocks_along(std::int64_t sites) { return (sites + block_width - 1) / block_width; }

  /// Along a graded axis sites are even in the grid coordinate: with an even number a cell, none crosses a knot.
  void find_edges(int axis) {
    const AxisMap& map = maps_[axis];
    if (!map.graded()) return;
    for (int i = 0; i <= map.cells() * per_cell_; ++i)
      edges_[axis].push_back(map.to_space(static_cast<double>(i) / per_cell_));
  }
  bool uniform() const {
    return std::all_of(edges_.begin(), edges_.end(), [](const auto& edges) { return edges.empty(); });
  }
  double site_at(int axis, double x) const {
    return edges_[axis].empty() ? (x - origin_[axis]) / width_ : maps_[axis].to_grid(x) * per_cell_;
  }
  double edge(int axis, std::int64_t i) const {
    if (edges_[axis].empty()) return origin_[axis] + static_cast<double>(i) * width_;
    return edges_[axis][std::min<std::size_t>(i, edges_[axis].size() - 1)];
  }
  double width_of(int axis, std::int64_t i) const {
    return edges_[axis].empty() ? width_ : edges_[axis][i + 1] - edges_[axis][i];
  }

  Point origin_;
  double width_;
  std::array<std::vector<double>, Dim> edges_;  ///< of the sites along graded axes [m]
  std::vector<AxisMap> maps_;
  int per_cell_;
  std::array<std::int64_t, Dim> first_, count_;
};

}  // namespace geodrop
