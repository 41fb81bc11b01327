// Membranes of triangles: laws, forces, loads.
#include <doctest/doctest.h>
#include <geodrop/geometry/triangle_surface.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

#include "membrane/surface_load.hpp"
#include "membrane/triangles.hpp"
#include "support/near.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

Membrane<3> cloth(Fabric fabric, double J, double nu = 0) {
  Membrane<3> membrane;
  membrane.axial_stiffness = J;
  membrane.strength = 100;
  membrane.triangles.fabric = fabric;
  membrane.triangles.poisson_ratio = nu;
  membrane.triangles.weft_stiffness = 3 * J;
  membrane.triangles.weft_strength = 200;
  return membrane;
}

Eigen::Matrix2d square_of(double along, double across, double angle) {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
  return turn * Eigen::Vector2d(along * along, across * across).asDiagonal() * turn.transpose();
}

/// Two triangles that share an edge, at rest in a plane.
Membrane<3> hinge(Fabric fabric) {
  Membrane<3> membrane = cloth(fabric, 1000, 0.3);
  const std::array<Eigen::Vector3d, 4> rest{{{0, 0, 0}, {1, 0.1, 0}, {1.2, 0.9, 0}, {-0.1, 1, 0}}};
  for (const auto& x : rest)
    for (int a = 0; a < 3; ++a) {
      membrane.x[a].push_back(x[a]);
      membrane.v[a].push_back(0);
      membrane.load[a].push_back(0);
    }
  membrane.mass.assign(4, 1.0);
  for (const auto& t : {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 2, 3}}) {
    const Eigen::Matrix2d edges = rest_edges({rest[t[0]], rest[t[1]], rest[t[2]]}, {1, 0.5, 0}),
                          inverse = edges.inverse();
    for (std::size_t k = 0; k < 3; ++k) membrane.triangles.corner[k].push_back(t[k]);
    for (int c = 0; c < 4; ++c) membrane.triangles.inverse_rest[c].push_back(inverse(c / 2, c % 2));
    membrane.triangles.rest_area.push_back(0.5 * edges.determinant());
  }
  for (auto* values : {&membrane.strain, &membrane.tension, &membrane.triangles.cross_tension}) values->assign(2, 0.0);
  return membrane;
}

void stretch(Membrane<3>& membrane) {
  for (std::size_t k = 0; k < 4; ++k) {
    membrane.x[0][k] *= 1.08;
    membrane.x[1][k] = 1.03 * membrane.x[1][k] + 0.05 * membrane.x[0][k];
    membrane.x[2][k] = k == 3 ? 0.2 : 0.1 * membrane.x[0][k];
  }
}

}  // namespace

TEST_CASE("Isotropic cloth is taut, wrinkled or slack") {
  const Membrane<3> membrane = cloth(Fabric::isotropic, 1000, 0.25);
  for (const double angle : {0.0, 0.4, 2.0}) {
    CAPTURE(angle);
    // Taut: plane stress, 1000 / (1 - 1/16) (0.02 + 0.25 0.01) = 24, and 16.
    const ClothState taut = cloth_state(membrane, square_of(1.02, 1.01, angle));
    CHECK(taut.tension == near(24.0, 1e-12));
    CHECK(taut.cross_tension == near(16.0, 1e-12));
    CHECK(taut.energy == near(0.5 * (24 * 0.02 + 16 * 0.01), 1e-12));
    // Narrower than 1 - nu e: wrinkles across, tension of a strip.
    const ClothState wrinkled = cloth_state(membrane, square_of(1.02, 0.9, angle));
    CHECK(wrinkled.tension == near(20.0, 1e-12));
    CHECK(wrinkled.cross_tension == 0);
    CHECK(wrinkled.energy == near(0.5 * 20 * 0.02, 1e-12));
    const ClothState slack = cloth_state(membrane, square_of(0.999, 0.9, angle));
    CHECK(slack.tension == 0);
    CHECK(slack.energy == 0);
    CHECK(slack.stress.norm() == 0);
    // The relaxed energy and its tension are continuous where wrinkles begin.
    const double e = 0.02, edge = 1 - 0.25 * e, step = 1e-9;
    const ClothState before = cloth_state(membrane, square_of(1 + e, edge + step, angle));
    const ClothState after = cloth_state(membrane, square_of(1 + e, edge - step, angle));
    CHECK(before.energy == near(after.energy, 1e-9));
    CHECK((before.stress - after.stress).norm() < 1e-5);
  }
}

TEST_CASE("Rubber is taut, wrinkled or slack, and as stiff in a strip as it says") {
  const Membrane<3> membrane = cloth(Fabric::rubber, 3000);
  for (const double angle : {0.0, 0.4, 2.0}) {
    CAPTURE(angle);
    // 1000 (2 - 1 / (8 1.5^2)), 1000 (1.5 - 1 / (4 1.5^3)), 500 (4 + 2.25 + 1/9 - 3).
    const ClothState taut = cloth_state(membrane, square_of(2.0, 1.5, angle));
    CHECK(taut.tension == near(1944.4444444444444, 1e-12));
    CHECK(taut.cross_tension == near(1425.925925925926, 1e-12));
    CHECK(taut.energy == near(1680.5555555555556, 1e-12));
    // Narrower than 2^(-1/2): 1000 (2 - 1/4), 500 (4 + 1 - 3).
    const ClothState wrinkled = cloth_state(membrane, square_of(2.0, 0.5, angle));
    CHECK(wrinkled.tension == near(1750.0, 1e-12));
    CHECK(wrinkled.cross_tension == 0);
    CHECK(wrinkled.energy == near(1000.0, 1e-12));
    const ClothState slack = cloth_state(membrane, square_of(0.999, 0.9, angle));
    CHECK(slack.energy == 0);
    CHECK(slack.stress.norm() == 0);
    const double edge = 1 / std::sqrt(1.2), step = 1e-9;
    const ClothState before = cloth_state(membrane, square_of(1.2, edge + step, angle));
    const ClothState after = cloth_state(membrane, square_of(1.2, edge - step, angle));
    CHECK(before.energy == near(after.energy, 1e-9));
    CHECK((before.stress - after.stress).norm() < 1e-4);
  }
  CHECK(cloth_state(membrane, square_of(1 + 1e-6, 0.5, 0)).tension == near(3000 * 1e-6, 1e-5));
}

TEST_CASE("Yarns bear tension along themselves alone") {
  const Membrane<3> membrane = cloth(Fabric::yarns, 1000);
  Eigen::Matrix2d c;
  c << 1.02 * 1.02, 0.5, 0.5, 1.01 * 1.01;  // sheared by a lot
  const ClothState both = cloth_state(membrane, c);
  CHECK(both.tension == near(20.0, 1e-10));
  CHECK(both.cross_tension == near(30.0, 1e-10));
  CHECK(both.stress(0, 1) == 0);
  c(1, 1) = 0.9;
  CHECK(cloth_state(membrane, c).cross_tension == 0);
  CHECK(cloth_state(membrane, c).tension == near(20.0, 1e-10));
}

TEST_CASE("Stress is twice the derivative of the energy by C") {
  for (const Fabric fabric : {Fabric::isotropic, Fabric::rubber, Fabric::yarns})
    for (const double across : {1.03, 0.97, 0.9}) {
      const Membrane<3> membrane = cloth(fabric, 1000, 0.3);
      const Eigen::Matrix2d c = square_of(1.06, across, 0.7);
      const ClothState state = cloth_state(membrane, c);
      constexpr double step = 1e-6;
      for (const auto& [i, j] : {std::pair{0, 0}, std::pair{1, 1}, std::pair{0, 1}}) {
        Eigen::Matrix2d change = Eigen::Matrix2d::Zero();
        change(i, j) = change(j, i) = step;
        const double slope =
            (cloth_state(membrane, c + change).energy - cloth_state(membrane, c - change).energy) / (2 * step);
        const double half_stress = (i == j ? 0.5 : 1.0) * state.stress(i, j);
        CHECK(std::abs(slope - half_stress) < 1e-5 * membrane.axial_stiffness);
      }
    }
}

TEST_CASE("Forces of triangles are less the derivative of their energy, and turn nothing") {
  for (const Fabric fabric : {Fabric::isotropic, Fabric::rubber, Fabric::yarns}) {
    Membrane<3> membrane = hinge(fabric);
    CHECK(cloth_energy(membrane) == near_zero(1e-20));
    stretch(membrane);
    const auto force = triangle_forces(membrane);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector3d f(force[0][k], force[1][k], force[2][k]);
      sum += f;
      moment += vector_at(membrane.x, k).cross(f);
      for (int a = 0; a < 3; ++a) {
        constexpr double step = 1e-6;
        Membrane<3> more = membrane, less = membrane;
        more.x[a][k] += step;
        less.x[a][k] -= step;
        const double slope = (cloth_energy(more) - cloth_energy(less)) / (2 * step);
        CHECK(std::abs(force[a][k] + slope) < 1e-6 * f.norm() + 1e-7);
      }
    }
    CHECK(sum.norm() < 1e-12);
    CHECK(moment.norm() < 1e-12);
  }
}

TEST_CASE("The utilisation is that of the yarn that is nearest to its strength") {
  Membrane<3> membrane = cloth(Fabric::yarns, 1000);
  membrane.tension = {50, 20};
  membrane.triangles.cross_tension = {20, 160};
  membrane.triangles.rest_area = {1, 1};
  CHECK(utilisation(membrane) == near(0.8, 1e-15));  // 160 of 200
  membrane.tension[0] = 90;
  CHECK(utilisation(membrane) == near(0.9, 1e-15));
}

TEST_CASE("Pressures on triangles: the resultant of a fluid at rest is the weight that it displaces") {
  // A closed tetrahedron: of a whole one gamma V upwards; of one that a level cuts gamma times the part below.
  Membrane<3> membrane;
  membrane.name = "bag";
  for (const Corner& x : {Corner{0, 0, 0}, Corner{1, 0, 0}, Corner{0, 1, 0}, Corner{0, 0, 1}})
    for (int a = 0; a < 3; ++a) membrane.x[a].push_back(x[a]);
  membrane.mass.assign(4, 1.0);
  for (const auto& t : {std::array<std::uint32_t, 3>{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    for (std::size_t k = 0; k < 3; ++k) membrane.triangles.corner[k].push_back(t[k]);
    membrane.triangles.rest_area.push_back(1);
  }
  Eigen::Vector3d moment;
  const auto resultant = [&](double unit_weight, double level, double gauge) {
    State<3> state;
    state.membranes.push_back(membrane);
    for (auto& component : state.membranes[0].load) component.assign(4, 0.0);
    state.membranes[0].triangles.gauge_pressure = gauge;
    add_surface_pressure({{"bag", unit_weight, level}}, state);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    moment.setZero();
    for (std::size_t k = 0; k < 4; ++k) {
      sum += vector_at(state.membranes[0].load, k);
      moment += vector_at(membrane.x, k).cross(vector_at(state.membranes[0].load, k));
    }
    return sum;
  };
  CHECK(enclosed_volume(membrane) == near(1.0 / 6, 1e-15));
  const Eigen::Vector3d outside = resultant(-9000, 5, 0);
  CHECK(outside[2] == near(9000.0 / 6, 1e-12));
  CHECK(outside.head<2>().norm() < 1e-9);
  // It acts at the middle of the volume, (1/4, 1/4, 1/4).
  CHECK((moment - Eigen::Vector3d(0.25, 0.25, 0.25).cross(outside)).norm() < 1e-9);
  // Below 1/2: 1/6 (1 - 1/8) of volume.
  const Eigen::Vector3d half = resultant(-9000, 0.5, 0);
  CHECK(half[2] == near(9000.0 / 6 * 7 / 8, 1e-12));
  CHECK(half.head<2>().norm() < 1e-9);
  CHECK(resultant(9000, 5, 0)[2] == near(-9000.0 / 6, 1e-12));
  CHECK(resultant(0, 0, 1e4).norm() < 1e-10);
}
