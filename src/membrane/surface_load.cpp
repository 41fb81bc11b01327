#include "surface_load.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <array>

#include "triangles.hpp"

namespace geodrop {
namespace {

/// A point of a triangle: shares of its corners, and how far it is below the level [m].
struct WetCorner {
  Eigen::Vector3d share;
  double depth;
};

/// The part of a triangle below the level: at most four corners.
std::vector<WetCorner> wet_part(const std::array<double, 3>& depth) {
  std::vector<WetCorner> part;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const Eigen::Vector3d here = Eigen::Vector3d::Unit(k), there = Eigen::Vector3d::Unit(next);
    if (depth[k] >= 0) part.push_back({here, depth[k]});
    if ((depth[k] > 0 && depth[next] < 0) || (depth[k] < 0 && depth[next] > 0))
      part.push_back({here + depth[k] / (depth[k] - depth[next]) * (there - here), 0});
  }
  return part;
}

/// Of linear pressure and linear shares, over the area of the triangle: exact on each triangle of the fan.
Eigen::Vector3d shares_of_load(const std::vector<WetCorner>& part, double unit_weight) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 1; k + 1 < part.size(); ++k) {
    const std::array<const WetCorner*, 3> fan{&part[0], &part[k], &part[k + 1]};
    Eigen::Matrix3d corners;
    corners << fan[0]->share, fan[1]->share, fan[2]->share;
    const double area = corners.determinant(), all = fan[0]->depth + fan[1]->depth + fan[2]->depth;
    for (const WetCorner* corner : fan) sum += area / 12 * unit_weight * (corner->depth + all) * corner->share;
  }
  return sum;
}

void add_load(const Eigen::Vector3d& pressure, std::size_t t, Membrane<3>& membrane) {
  const Eigen::Vector3d half_normal = 0.5 * normal_of(membrane, t);  // area times normal
  for (int k = 0; k < 3; ++k)
    for (int a = 0; a < 3; ++a) membrane.load[a][membrane.triangles.corner[k][t]] += pressure[k] * half_normal[a];
}

/// Of the corners of a triangle below a level [m].
std::array<double, 3> depths(double level, const Membrane<3>& membrane, std::size_t t) {
  std::array<double, 3> depth;
  for (int k = 0; k < 3; ++k) depth[k] = level - membrane.x[2][membrane.triangles.corner[k][t]];
  return depth;
}

void add_column(const StillFluid& fluid, Membrane<3>& membrane) {
  for (std::size_t t = 0; t < membrane.triangles.size(); ++t) {
    const std::array<double, 3> depth = depths(fluid.surface, membrane, t);
    if (std::all_of(depth.begin(), depth.end(), [](double d) { return d <= 0; })) continue;
    add_load(shares_of_load(wet_part(depth), fluid.unit_weight), t, membrane);
  }
}

}  // namespace

void add_weight(double unit_weight, double level, Membrane<3>& membrane) {
  const auto whole = [](const std::array<double, 3>& depth) {
    std::vector<WetCorner> corners;
    for (int k = 0; k < 3; ++k) corners.push_back({Eigen::Vector3d::Unit(k), depth[k]});
    return corners;
  };
  if (unit_weight == 0) return;
  for (std::size_t t = 0; t < membrane.triangles.size(); ++t)
    add_load(shares_of_load(whole(depths(level, membrane, t)), unit_weight), t, membrane);
}

void add_surface_pressure(const std::vector<StillFluid>& fluids, State<3>& state) {
  for (Membrane<3>& membrane : state.membranes) {
    if (membrane.load[0].empty() || membrane.field == waiting) continue;
    const double even = membrane.triangles.gauge_pressure / 3;
    for (std::size_t t = 0; even != 0 && t < membrane.triangles.size(); ++t)
      add_load(Eigen::Vector3d::Constant(even), t, membrane);
    for (const StillFluid& fluid : fluids)
      if (fluid.membrane == membrane.name) add_column(fluid, membrane);
  }
}

}  // namespace geodrop
