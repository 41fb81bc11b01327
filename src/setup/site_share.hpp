// How much of a lattice site belongs to a body, and where that share has its centre.
#pragma once

#include <array>
#include <geodrop/geometry/shapes.hpp>
#include <geodrop/scene/scene.hpp>
#include <vector>

#include "geometry/polygon_in_box.hpp"

namespace geodrop {

/// Share of a site inside a body, and the centroid of that share.
template <int Dim>
struct SiteShare {
  double share = 0;                    ///< of the site's volume [-]
  std::array<double, Dim> centroid{};  ///< [m]
};

template <int Dim>
SiteShare<Dim> whole_site(const Bounds& site) {
  SiteShare<Dim> whole{1, {}};
  for (int a = 0; a < Dim; ++a) whole.centroid[a] = (site.lower[a] + site.upper[a]) / 2;
  return whole;
}

/// How much of a site, or of a block of sites, belongs to a body; `part` may also be said of one that is just touched.
enum class Cover { none, part, all };

/// A shape, with what is asked of it at each site.
struct Outlined {
  explicit Outlined(const Shape& shape_);

  const Shape* shape;
  Bounds box;
  std::vector<PolygonEdge> edges;  ///< of a polygon
};

/// The material points that belong to a body: inside its shape, outside all shapes cut out of it.
class BodyRegion {
 public:
  BodyRegion(const Scene& scene, const BodySpec& spec);

  bool holds(const Point& x) const;
  Cover cover(const Bounds& box) const;

  /// The share of an axis-aligned site. Lengths along x are exact, and Gauss points integrate them over y, and in 3D
  /// the exact sections over z, between all levels at which an outline bends, begins, ends or leaves the site: exact
  /// for boxes, polygons and half-spaces, to about 1e-7 of the site for ellipses and ellipsoids, and to 1e-3 where two
  /// outlines cross within the site.
  template <int Dim>
  SiteShare<Dim> share(const Bounds& site) const;

 private:
  Outlined shape_;
  std::vector<Outlined> removed_;
};

}  // namespace geodrop
