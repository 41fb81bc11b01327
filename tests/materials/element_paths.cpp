// One point led along laboratory paths: oedometer, triaxial and biaxial compression, rigid spin, undrained squeeze.
#include "element.hpp"
#include "support/near.hpp"
#include "support/paths.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <numbers>
#include <sstream>
#include <vector>

namespace {

using namespace geodrop;
using namespace geodrop::test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180;

/// Applies a strain increment along the axes.
template <int Dim>
void strain(const MohrCoulomb& law, const Vector3d& increment, Stress<Dim, double>& stress) {
  const double volume = increment.head<Dim>().sum();
  update_stress<Dim, double>(law, gradient<Dim>(increment.asDiagonal()), volume, stress);
}

/// Compresses along y by `axial` while the lateral strain keeps stress component 0 at `lateral`; returns that
/// strain. In 3D z does as x; in 2D it is held. Bisection: the response is monotonic.
template <int Dim>
double compress(const MohrCoulomb& law, double axial, double lateral, Stress<Dim, double>& stress) {
  const auto tried = [&](double x) {
    Stress<Dim, double> s = stress;
    strain<Dim>(law, {x, -axial, Dim == 3 ? x : 0.0}, s);
    return s;
  };
  double low = -axial, high = 5 * axial;
  for (int halving = 0; halving < 70; ++halving) {
    const double middle = 0.5 * (low + high);
    (tried(middle)[0] < lateral ? low : high) = middle;
  }
  stress = tried(high);
  return high;
}

struct BiaxialRow {
  double youngs_modulus, poissons_ratio, cohesion, phi, psi, lateral, peak, yield_strain, second, ratio, slope;
};

std::vector<BiaxialRow> read_biaxial() {
  std::ifstream file(test::source_directory + "/tests/data/biaxial_plane_strain.csv");
  std::string line;
  std::getline(file, line);
  std::vector<BiaxialRow> rows;
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    BiaxialRow r{};
    fields >> r.youngs_modulus >> r.poissons_ratio >> r.cohesion >> r.phi >> r.psi >> r.lateral >> r.peak >>
        r.yield_strain >> r.second >> r.ratio >> r.slope;
    rows.push_back(r);
  }
  return rows;
}

/// Largest error of a stress carried round by a rigid spin of 1000 equal steps, relative to its largest component.
template <int Dim>
double spin_error(double step_spin) {
  Matrix3d spin = Matrix3d::Zero();
  const Vector3d axis = Dim == 2 ? Vector3d{0, 0, 1} : Vector3d{2, -1, 2} / 3;
  spin << 0, -axis[2], axis[1], axis[2], 0, -axis[0], -axis[1], axis[0], 0;
  const LinearElastic law{1000, 1e6, 5e5};
  Stress<Dim, double> start{-3e4, -1e4, -2e4, 8e3}, stress = start;
  for (int step = 0; step < 1000; ++step) update_stress<Dim, double>(law, gradient<Dim>(step_spin * spin), 0.0, stress);
  return largest_difference(stress, start) / largest(start);
}

}  // namespace

TEST_CASE("An oedometer with Ec = 111.11 kPa settles by 0.164730 m under 20 kPa: the strain is logarithmic") {
  const double confined = 111.11e3, length = 1.0, load = 20e3;
  const LinearElastic law{1000, confined / 3, confined / 2};  // K + 4G/3 = Ec
  // Settle to the reference in steps, each taken at mid-step, so that the sum of dL is ln F to O(steps^-2).
  const double settlement = length * (1 - std::exp(-load / confined));
  CHECK(settlement == near(0.164730, 1e-5));
  const int steps = 1000;
  const double step = settlement / steps;
  Stress<2, double> plane{};
  Stress<3, double> full{};
  for (int k = 0; k < steps; ++k) {
    const double dL = -step / (length - (k + 0.5) * step);
    update_stress<2, double>(law, {0, 0, 0, dL}, dL, plane);
    update_stress<3, double>(law, {0, 0, 0, 0, dL, 0, 0, 0, 0}, dL, full);
  }
  CHECK(plane[1] == near(-load, 8e-9));
  CHECK(full[1] == near(-load, 8e-9));
  const double lateral = -load * (law.bulk_modulus - 2.0 / 3.0 * law.shear_modulus) / confined;
  CHECK(plane[2] == within(lateral, 1e-12));
  CHECK(full[0] == within(lateral, 1e-12));
}

TEST_CASE("A triaxial test at 50 kPa fails at the stress of the reference table") {
  struct Case {
    double cohesion, phi, sigma1;
  };
  for (const Case& c : {Case{5e3, 35, 203.718e3}, Case{3e3, 30, 160.392e3}, Case{1e3, 40, 234.235e3}}) {
    for (const double psi : {0.0, 10.0}) {
      const MohrCoulomb law = soil({1e7, 0.3, c.cohesion, c.phi, psi});
      Stress<3, double> stress{-50e3, -50e3, -50e3, 0, 0, 0};
      for (int step = 0; step < 100; ++step) compress<3>(law, 5e-4, -50e3, stress);
      const double root = std::tan((45 + c.phi / 2) * degree);
      const double exact = 50e3 * root * root + 2 * c.cohesion * root;
      CHECK(stress[0] == near(-50e3, 1e-9));
      CHECK(stress[2] == near(-50e3, 1e-9));
      CHECK(-stress[1] == near(exact, 1e-9));
      CHECK(std::abs(-stress[1] - c.sigma1) < 0.5001);  // the last digit of the table is 1 Pa
    }
  }
}

TEST_CASE("Biaxial compression has the stiffness, strength and dilatancy of the reference") {
  const auto rows = read_biaxial();
  REQUIRE(rows.size() == 3);
  for (const BiaxialRow& row : rows) {
    const MohrCoulomb law = soil({row.youngs_modulus, row.poissons_ratio, row.cohesion, row.phi, row.psi});
    Stress<2, double> stress{-row.lateral, -row.lateral, -row.lateral, 0};
    compress<2>(law, 0.5 * row.yield_strain, -row.lateral, stress);
    CHECK((-stress[1] - row.lateral) / (0.5 * row.yield_strain) == near(row.slope, 1e-8));
    compress<2>(law, 0.5 * row.yield_strain, -row.lateral, stress);
    CHECK(-stress[2] == near(row.second, 1e-8));
    const double lateral_strain = compress<2>(law, 0.1 * row.yield_strain, -row.lateral, stress);
    CHECK(-stress[1] == near(row.peak, 1e-8));
    CHECK(-stress[2] == near(row.second, 1e-8));
    CHECK(lateral_strain / (0.1 * row.yield_strain) == near(row.ratio, 9e-10));
  }
}

TEST_CASE("A stress is carried round by a rigid spin of 360 degrees in 1000 steps") {
  const double turn = 2 * std::numbers::pi / 1000;
  // A step that spins by 2 tan(turn/2) turns by exactly `turn`: round-off of 1000 steps is left.
  CHECK(spin_error<2>(2 * std::tan(turn / 2)) < 1e-12);
  CHECK(spin_error<3>(2 * std::tan(turn / 2)) < 1e-12);
  // Spun by `turn` itself it lags by turn^3/12 a step, 2.07e-5 in all; stress differences turn by twice that.
  CHECK(spin_error<2>(turn) < 2 * 2.1e-5);
  CHECK(spin_error<3>(turn) < 2 * 2.1e-5);
}

TEST_CASE("An eighth of an anticlockwise turn takes uniaxial stress along x to the diagonal") {
  const LinearElastic law{1000, 1e6, 5e5};
  const double spin = 2 * std::tan(std::numbers::pi / 4 / 125 / 2);
  Stress<2, double> plane{1000, 0, 0, 0};
  Stress<3, double> about_z{1000, 0, 0, 0, 0, 0}, about_x{0, 1000, 0, 0, 0, 0}, about_y{0, 0, 1000, 0, 0, 0};
  for (int step = 0; step < 125; ++step) {
    update_stress<2, double>(law, {0, -spin, spin, 0}, 0.0, plane);
    update_stress<3, double>(law, {0, -spin, 0, spin, 0, 0, 0, 0, 0}, 0.0, about_z);
    update_stress<3, double>(law, {0, 0, 0, 0, 0, -spin, 0, spin, 0}, 0.0, about_x);
    update_stress<3, double>(law, {0, 0, spin, 0, 0, 0, -spin, 0, 0}, 0.0, about_y);
  }
  CHECK(largest_difference(plane, {500, 500, 0, 500}) < 1e-9);
  CHECK(largest_difference(about_z, {500, 500, 0, 500, 0, 0}) < 1e-9);
  CHECK(largest_difference(about_x, {0, 500, 500, 0, 500, 0}) < 1e-9);
  CHECK(largest_difference(about_y, {500, 0, 500, 0, 0, 500}) < 1e-9);
}

TEST_CASE("A turn made of chords strains nothing, about any axis: the stretch of the tangent is that of the spin") {
  const double angle = 0.01;
  const auto strain_of_turn = [&]<int Dim>(std::integral_constant<int, Dim>, const Vector3d& axis) {
    const Matrix3d turn = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
    Gradient<Dim, double> dL = gradient<Dim>(turn - Matrix3d::Identity());
    double trace = add_stretch_of_spin<Dim, double>(dL);
    for (int a = 0; a < Dim; ++a) trace += turn(a, a) - 1;
    const Stress<Dim, double> deviatoric = deviator<Dim, double>(dL);
    return std::hypot(trace, std::sqrt(norm_squared<Dim, double>(deviatoric)));
  };
  // 1e-4 without it, the square of the angle.
  CHECK(strain_of_turn(std::integral_constant<int, 2>{}, {0, 0, 1}) < 5e-9);
  CHECK(strain_of_turn(std::integral_constant<int, 2>{}, {0, 0, -1}) < 5e-9);
  for (const Vector3d& axis : {Vector3d{1, 0, 0}, Vector3d{0, 1, 0}, Vector3d{0, 0, 1}, Vector3d{2, -1, 2}})
    CHECK(strain_of_turn(std::integral_constant<int, 3>{}, axis) < 5e-9);
}

TEST_CASE("The given volume change replaces the trace, and the deviator is kept") {
  const LinearElastic law{1000, 2e6, 1e6};
  Stress<2, double> plane{};
  update_stress<2, double>(law, {3e-3, 2e-3, 0, 0}, -1e-3, plane);
  // By hand, without the spin (no stress to turn): deviator 2e-3, -1e-3, -1e-3, shear 1e-3; mean -2000 Pa.
  CHECK(plane[0] == near(4000 - 2000, 1e-12));
  CHECK(plane[1] == near(-2000 - 2000, 1e-12));
  CHECK(plane[2] == near(-2000 - 2000, 1e-12));
  CHECK(plane[3] == near(2000, 1e-12));
  Stress<3, double> full{};
  update_stress<3, double>(law, {3e-3, 2e-3, 0, 0, 0, 0, 0, 0, 0}, -1e-3, full);
  CHECK(largest_difference(full, {2000, -4000, -4000, 2000, 0, 0}) < 1e-9);
}

TEST_CASE("A Newtonian deviator is 2 mu dev(D), whatever the spin") {
  const Newtonian thin{1000, 1e6, 8.9e-4}, thick{1000, 1e6, 0.5};
  const auto shear = viscous_stress<2, double>(thin, 1, {0, 3, 1, 0}, thin.mixing_length);
  CHECK(largest_difference(shear, {0, 0, 0, 2 * 8.9e-4 * 2}) < 1e-18);
  const auto stretch = viscous_stress<2, double>(thick, 0.1, {0.3, 0, 0, 0}, thick.mixing_length);
  CHECK(largest_difference(stretch, {2, -1, -1, 0}) < 1e-15);
  const auto full = viscous_stress<3, double>(thick, 1, {0, 1, 2, 1, 0, 5, 4, 1, 3}, thick.mixing_length);
  CHECK(largest_difference(full, {-1, -1, 2, 1, 3, 3}) < 1e-15);
}

TEST_CASE("Eddies add rho l^2 du/dy to the viscosity") {
  const Newtonian fluid{1000, 1e6, 0.5, 0.2};
  const auto shear = viscous_stress<2, double>(fluid, 0.1, {0, 0.3, 0, 0}, fluid.mixing_length);  // du/dy = 3 /s
  CHECK(largest_difference(shear, {0, 0, 0, (0.5 + 1000 * 0.04 * 3) * 3}) < 1e-12);
  const auto spin = viscous_stress<2, double>(fluid, 0.1, {0, 0.3, -0.3, 0}, fluid.mixing_length);
  CHECK(largest_difference(spin, {}) < 1e-12);
}

TEST_CASE("The deviatoric strain increment is sqrt(2/3 e:e)") {
  const MohrCoulomb law = soil({1e7, 0.3, 1e3, 30, 0});
  Stress<3, double> stress{};
  // Uniaxial deviator (-2, 1, 1) a: e:e = 6 a^2, so the measure is 2 a. The trace does not enter.
  const double a = 1e-3;
  const double measured =
      update_stress<3, double>(law, {-2 * a + 1e-2, 0, 0, 0, a + 1e-2, 0, 0, 0, a + 1e-2}, 3e-2, stress);
  CHECK(measured == near(2 * a, 1e-12));
  Stress<2, double> plane{};
  CHECK(update_stress<2, double>(law, {0, 2 * a, 0, 0}, 0.0, plane) == near(2 * a / std::sqrt(3.0), 1e-12));
}

TEST_CASE("An undrained isotropic step shows Skempton's B") {
  MohrCoulomb law = soil({1e7, 0.333, 1e3, 30, 0});
  law.pore_stiffness = 20 * law.bulk_modulus;
  Stress<3, double> stress{-2e4, -2e4, -2e4, 0, 0, 0};
  const double dvol = -1e-4;
  const double pore = pore_pressure_increment(law, dvol);
  strain<3>(law, Vector3d::Constant(dvol / 3), stress);
  const double skeleton = -stress[0] - 2e4;
  CHECK(pore / (pore + skeleton) == near(20.0 / 21.0, 1e-9));
  CHECK(skempton_b(law) == near(20.0 / 21.0, 1e-12));
}

TEST_CASE("The laws do not know the names of the axes") {
  Dice dice;
  const MohrCoulomb law = soil({1e6, 0.3, 1000, 30, 10, 500});
  for (int repeat = 0; repeat < 500; ++repeat) {
    const Matrix3d turn = dice.rotation(), dL = 0.02 * dice.any_matrix();
    const Matrix3d root = dice.any_matrix();
    const Matrix3d start = -3e3 * (root + root.transpose()) - 4e3 * Matrix3d::Identity();
    auto plain = components<3>(start), turned = components<3>(turn * start * turn.transpose());
    update_stress<3, double>(law, gradient<3>(dL), dL.trace(), plain);
    update_stress<3, double>(law, gradient<3>(turn * dL * turn.transpose()), dL.trace(), turned);
    CHECK(largest_difference(components<3>(turn * matrix(plain) * turn.transpose()), turned) < 1e-9);  // of 1e4 Pa
  }
}

TEST_CASE("Plane strain is a slice of 3D") {
  Dice dice;
  const MohrCoulomb law = soil({1e6, 0.3, 1000, 30, 10, 500});
  for (int repeat = 0; repeat < 500; ++repeat) {
    const Stress<2, double> start{1e4 * dice.normal(), 1e4 * dice.normal(), 1e4 * dice.normal(), 3e3 * dice.normal()};
    Matrix3d dL = 0.02 * dice.any_matrix();
    dL.row(2).setZero();
    dL.col(2).setZero();
    Stress<2, double> plane = start;
    Stress<3, double> full{start[0], start[1], start[2], start[3], 0, 0};
    update_stress<2, double>(law, gradient<2>(dL), dL.trace(), plane);
    update_stress<3, double>(law, gradient<3>(dL), dL.trace(), full);
    CHECK(largest_difference(full, {plane[0], plane[1], plane[2], plane[3], 0, 0}) < 1e-9);  // of 1e4 Pa
  }
}
