// How much of a lattice site belongs to a body, and where that share has its centre.
#pragma once

#include <array>
#include <geodrop/scene.hpp>
#include <geodrop/shapes.hpp>
#include <vector>

namespace geodrop {

/// Share of a site inside a body, and the centroid of that share.
template <int Dim>
struct SiteShare {
  double share = 0;                    ///< of the site's volume [-]
  std::array<double, Dim> centroid{};  ///< [m]
};

/// The material points that belong to a body: inside its shape, outside all shapes cut out of it.
class BodyRegion {
 public:
  BodyRegion(const Scene& scene, const BodySpec& spec);

  bool holds(const Point& x) const;

  /// The share of an axis-aligned site. Lengths along x are exact, and Gauss points integrate them over the other axes
  /// between all levels at which an outline bends, begins, ends or leaves the site: exact for boxes and (2D) polygons
  /// that are cut by nothing, else to about 1e-4 of the site.
  template <int Dim>
  SiteShare<Dim> share(const Bounds& site) const;

 private:
  const Shape* shape_;
  std::vector<const Shape*> removed_;
};

}  // namespace geodrop
