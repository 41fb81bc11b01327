#include "triangles.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geodrop {

Eigen::Vector3d corner_of(const Membrane<3>& membrane, std::size_t triangle, std::size_t k) {
  return vector_at(membrane.x, membrane.triangles.corner[k][triangle]);
}

namespace {

/// S of a principal direction is T / l; a cloth without length there has none.
double over(double tension, double stretch) { return stretch > 0 ? tension / stretch : 0.0; }

ClothState yarn_state(const Membrane<3>& membrane, const Eigen::Matrix2d& c) {
  const double warp = std::sqrt(c(0, 0)), weft = std::sqrt(c(1, 1));
  const double weft_strain = std::max(0.0, weft - 1), weft_stiffness = membrane.triangles.weft_stiffness;
  ClothState state;
  state.strain = warp - 1;
  state.tension = membrane.axial_stiffness * std::max(0.0, warp - 1);
  state.cross_tension = weft_stiffness * weft_strain;
  state.energy = 0.5 * state.tension * std::max(0.0, warp - 1) + 0.5 * state.cross_tension * weft_strain;
  state.stress.diagonal() << over(state.tension, warp), over(state.cross_tension, weft);
  return state;
}

/// Tensions along and across of the principal stretches, and the energy.
struct Principal {
  double along = 0, across = 0, energy = 0;
};

Principal linear_field(double J, double nu, double e, double e_across) {
  const double taut = J / (1 - nu * nu);
  const bool wrinkled = e_across <= -nu * e;
  Principal out;
  out.along = wrinkled ? J * e : taut * (e + nu * e_across);
  out.across = wrinkled ? 0.0 : taut * (e_across + nu * e);
  out.energy = 0.5 * (out.along * e + out.across * e_across);
  return out;
}

Principal rubber_field(double J, double along, double across) {
  const double natural = 1 / std::sqrt(along);  // width of a strip
  const double width = std::max(across, natural), thinned = 1 / (along * along * width * width);
  Principal out;
  out.along = J / 3 * (along - thinned / along);
  out.across = across <= natural ? 0.0 : J / 3 * (across - thinned / across);
  out.energy = J / 6 * (along * along + width * width + thinned - 3);
  return out;
}

ClothState tension_field(const Membrane<3>& membrane, const Eigen::Matrix2d& c) {
  const double mean = 0.5 * (c(0, 0) + c(1, 1)), half = 0.5 * (c(0, 0) - c(1, 1)), shear = c(0, 1);
  const double radius = std::hypot(half, shear);
  const double along = std::sqrt(mean + radius), across = std::sqrt(std::max(0.0, mean - radius));
  ClothState state;
  state.strain = along - 1;
  if (state.strain <= 0) return state;
  const double J = membrane.axial_stiffness;
  const Principal principal = membrane.triangles.fabric == Fabric::rubber
                                  ? rubber_field(J, along, across)
                                  : linear_field(J, membrane.triangles.poisson_ratio, state.strain, across - 1);
  state.tension = principal.along;
  state.cross_tension = principal.across;
  state.energy = principal.energy;
  const double first = over(state.tension, along), second = over(state.cross_tension, across);
  state.stress.diagonal().setConstant(0.5 * (first + second));
  if (radius == 0) return state;
  const double deviator = 0.5 * (first - second) / radius;
  state.stress(0, 0) += deviator * half;
  state.stress(1, 1) -= deviator * half;
  state.stress(0, 1) = state.stress(1, 0) = deviator * shear;
  return state;
}

ClothState state_of(const Membrane<3>& membrane, std::size_t triangle) {
  const auto F = deformation(membrane, triangle);
  return cloth_state(membrane, F.transpose() * F);
}

Eigen::Matrix2d inverse_rest(const Membrane<3>& membrane, std::size_t t) {
  const auto& d = membrane.triangles.inverse_rest;
  Eigen::Matrix2d inverse;
  inverse << d[0][t], d[1][t], d[2][t], d[3][t];
  return inverse;
}

}  // namespace

ClothState cloth_state(const Membrane<3>& membrane, const Eigen::Matrix2d& c) {
  return membrane.triangles.fabric == Fabric::yarns ? yarn_state(membrane, c) : tension_field(membrane, c);
}

Eigen::Matrix<double, 3, 2> deformation(const Membrane<3>& membrane, std::size_t t) {
  const Eigen::Vector3d origin = corner_of(membrane, t, 0);
  Eigen::Matrix<double, 3, 2> edges;
  edges << corner_of(membrane, t, 1) - origin, corner_of(membrane, t, 2) - origin;
  return edges * inverse_rest(membrane, t);
}

Eigen::Matrix2d rest_edges(const Membrane<3>& membrane, std::size_t t) { return inverse_rest(membrane, t).inverse(); }

Eigen::Matrix2d rest_edges(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& warp) {
  constexpr double least = 1e-6;  // of the warp's length: else it stands on the cloth
  const Eigen::Vector3d one = corners[1] - corners[0], other = corners[2] - corners[0];
  const Eigen::Vector3d normal = one.cross(other).normalized();
  Eigen::Vector3d first = warp - normal.dot(warp) * normal;
  if (!(first.norm() > least * warp.norm())) first = one;
  first.normalize();
  const Eigen::Vector3d second = normal.cross(first);
  Eigen::Matrix2d edges;
  edges << first.dot(one), first.dot(other), second.dot(one), second.dot(other);
  return edges;
}

Eigen::Vector3d middle_of(const Membrane<3>& membrane, std::size_t t) {
  return (corner_of(membrane, t, 0) + corner_of(membrane, t, 1) + corner_of(membrane, t, 2)) / 3;
}

Eigen::Vector3d normal_of(const Membrane<3>& membrane, std::size_t t) {
  const Eigen::Vector3d origin = corner_of(membrane, t, 0);
  return (corner_of(membrane, t, 1) - origin).cross(corner_of(membrane, t, 2) - origin);
}

double enclosed_volume(const Membrane<3>& membrane) {
  double sum = 0;
  if (membrane.triangles.open_edge[2].empty()) {
    for (std::size_t t = 0; t < membrane.triangles.size(); ++t)
      sum += corner_of(membrane, t, 0).dot(normal_of(membrane, t)) / 6;
    return sum;
  }
  const int a = axis_without_ends(membrane);
  for (std::size_t t = 0; t < membrane.triangles.size(); ++t)
    sum += middle_of(membrane, t)[a] * normal_of(membrane, t)[a] / 2;
  return sum;
}

int axis_without_ends(const Membrane<3>& membrane) {
  const Array<std::uint32_t>& walls = membrane.triangles.open_edge[2];
  int axis = 0;
  while (
      std::any_of(walls.begin(), walls.end(), [&](std::uint32_t wall) { return static_cast<int>(wall / 2) == axis; }))
    ++axis;
  return axis;
}

void update_triangles(Membrane<3>& membrane) {
  for (std::size_t t = 0; t < membrane.triangles.size(); ++t) {
    const ClothState state = state_of(membrane, t);
    membrane.strain[t] = state.strain;
    membrane.tension[t] = state.tension;
    membrane.triangles.cross_tension[t] = state.cross_tension;
  }
}

std::array<Array<double>, 3> triangle_forces(const Membrane<3>& membrane) {
  std::array<Array<double>, 3> force;
  for (auto& component : force) component.assign(membrane.nodes(), 0.0);
  const MembraneTriangles<3>& triangles = membrane.triangles;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto F = deformation(membrane, t);
    const Eigen::Matrix2d stress = cloth_state(membrane, F.transpose() * F).stress;
    const Eigen::Matrix<double, 3, 2> pull =
        -triangles.rest_area[t] * F * stress * inverse_rest(membrane, t).transpose();
    for (int a = 0; a < 3; ++a) {
      force[a][triangles.corner[1][t]] += pull(a, 0);
      force[a][triangles.corner[2][t]] += pull(a, 1);
      force[a][triangles.corner[0][t]] -= pull(a, 0) + pull(a, 1);
    }
  }
  return force;
}

double cloth_energy(const Membrane<3>& membrane) {
  double sum = 0;
  for (std::size_t t = 0; t < membrane.triangles.size(); ++t)
    sum += membrane.triangles.rest_area[t] * state_of(membrane, t).energy;
  return sum;
}

double utilisation(const Membrane<3>& membrane) {
  if (!(membrane.strength > 0)) return std::numeric_limits<double>::quiet_NaN();
  const MembraneTriangles<3>& triangles = membrane.triangles;
  const double across = triangles.fabric == Fabric::yarns ? triangles.weft_strength : membrane.strength;
  double largest = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    largest = std::max({largest, membrane.tension[t] / membrane.strength, triangles.cross_tension[t] / across});
  return largest;
}

}  // namespace geodrop
