// The return to Mohr-Coulomb and to the tension cut-off: tabulated states, values by hand, and the flow rule itself.
#include "element.hpp"
#include "materials/principal_return.hpp"
#include "support/near.hpp"
#include "support/paths.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <vector>

namespace {

using namespace geodrop;
using namespace geodrop::test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

struct TabulatedReturn {
  SoilConstants soil;
  Vector3d trial, expected;
  std::string region;
};

std::vector<TabulatedReturn> read_table() {
  std::ifstream file(test::source_directory + "/tests/data/mohr_coulomb_return_map.csv");
  std::vector<TabulatedReturn> table;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    TabulatedReturn row{};
    fields >> row.soil.youngs_modulus >> row.soil.poissons_ratio >> row.soil.cohesion >> row.soil.friction_angle >>
        row.soil.dilatancy_angle >> row.trial[0] >> row.trial[1] >> row.trial[2] >> row.expected[0] >>
        row.expected[1] >> row.expected[2] >> row.region;
    row.soil.tension_cutoff = 1e30;
    table.push_back(row);
  }
  return table;
}

/// Half a unit in the last of the ten digits that the table has of a stress [Pa].
double rounding(const Vector3d& stress) {
  const double largest = stress.cwiseAbs().maxCoeff();
  return largest > 0 ? 0.5 * std::pow(10.0, std::floor(std::log10(largest)) - 9) : 0.0;
}

/// 1e-10 of the trial stress, and the rounding of both in the table [Pa]. The test of the flow rule is the sharper.
double tolerance(const TabulatedReturn& row) {
  return 1e-10 * row.trial.cwiseAbs().maxCoeff() + rounding(row.trial) + rounding(row.expected);
}

/// Soil with k = 1000 Pa, apex at 1000 Pa, sin(phi) = 1/2, psi = 0, lambda = G, cut-off at t = 400 Pa, hence m = -800.
MohrCoulomb soil_by_hand() {
  const double cohesion = 500 / std::cos(std::acos(-1.0) / 6);
  return soil({7.5e6, 0.25, cohesion, 30, 0, 400});
}

Vector3d principal_return(const MohrCoulomb& law, const Vector3d& trial) {
  const Stress<3, double> s = returned<3>(law, components<3>(trial.asDiagonal()));
  return {s[0], s[1], s[2]};
}

void check_return(const Vector3d& trial, const Vector3d& expected) {
  CAPTURE(trial.transpose());
  const Vector3d result = principal_return(soil_by_hand(), trial);
  CAPTURE(result.transpose());
  CHECK((result - expected).norm() < 1e-9);  // of 1000 Pa: round-off
}

/// Flow directions of all surfaces that are active at a sorted stress.
std::vector<Vector3d> active_flow(const MohrCoulomb& law, const Vector3d& s, double tolerance) {
  std::vector<Vector3d> flow;
  for (int i = 0; i < 3; ++i) {
    if (s[i] > law.tension_cutoff - tolerance) flow.push_back(Vector3d::Unit(i));
    for (int j = 0; j < 3; ++j) {
      const double f = (1 + law.sin_phi) * s[i] - (1 - law.sin_phi) * s[j] - 2 * law.cohesion * law.cos_phi;
      if (i != j && f > -tolerance)
        flow.push_back((1 + law.sin_psi) * Vector3d::Unit(i) - (1 - law.sin_psi) * Vector3d::Unit(j));
    }
  }
  return flow;
}

/// Distance of a plastic strain from the cone of flow directions, over all choices of up to three of them, relative.
double distance_from_cone(const std::vector<Vector3d>& flow, const Vector3d& strain) {
  double best = strain.norm();
  const auto try_basis = [&](const Eigen::MatrixXd& basis) {
    const Eigen::VectorXd multipliers = basis.colPivHouseholderQr().solve(strain);
    if (multipliers.minCoeff() >= -1e-9 * strain.norm()) best = std::min(best, (basis * multipliers - strain).norm());
  };
  for (std::size_t a = 0; a < flow.size(); ++a) {
    try_basis(flow[a]);
    for (std::size_t b = a + 1; b < flow.size(); ++b) {
      try_basis((Eigen::MatrixXd(3, 2) << flow[a], flow[b]).finished());
      for (std::size_t c = b + 1; c < flow.size(); ++c)
        try_basis((Eigen::MatrixXd(3, 3) << flow[a], flow[b], flow[c]).finished());
    }
  }
  return best / strain.norm();
}

double worst_violation(const MohrCoulomb& law, const Vector3d& s) {
  const double shear =
      (1 + law.sin_phi) * s.maxCoeff() - (1 - law.sin_phi) * s.minCoeff() - 2 * law.cohesion * law.cos_phi;
  return std::max(shear, s.maxCoeff() - law.tension_cutoff);
}

/// Plastic strain 2G (trial - returned) in elastic compliance.
Vector3d plastic_strain(const MohrCoulomb& law, const Vector3d& drop) {
  const double lambda = law.bulk_modulus - 2.0 / 3.0 * law.shear_modulus;
  return drop.array() - lambda / (3 * lambda + 2 * law.shear_modulus) * drop.sum();
}

}  // namespace

TEST_CASE("Mohr-Coulomb returns every tabulated state in plane strain, whichever principal axis is out of plane") {
  const auto table = read_table();
  REQUIRE(table.size() == 240);
  Dice dice;
  for (const auto& row : table) {
    const MohrCoulomb law = soil(row.soil);
    for (int out = 0; out < 3; ++out) {
      const Vector3d order{double((out + 1) % 3), double((out + 2) % 3), double(out)};
      const Matrix3d turn = Eigen::AngleAxisd(dice.uniform(0, 7), Vector3d::UnitZ()).toRotationMatrix();
      const auto in_plane = [&](const Vector3d& p) {
        const Vector3d placed{p[int(order[0])], p[int(order[1])], p[int(order[2])]};
        return components<2>(turn * placed.asDiagonal() * turn.transpose());
      };
      const auto result = returned<2>(law, in_plane(row.trial));
      INFO(row.region << ", trial " << row.trial.transpose());
      CHECK(largest_difference(result, in_plane(row.expected)) < tolerance(row));
    }
  }
}

TEST_CASE("Mohr-Coulomb returns every tabulated state in 3D, however the principal axes lie") {
  Dice dice;
  for (const auto& row : read_table()) {
    const MohrCoulomb law = soil(row.soil);
    for (int repeat = 0; repeat < 5; ++repeat) {
      const Matrix3d turn = dice.rotation();
      const auto turned = [&](const Vector3d& p) { return components<3>(turn * p.asDiagonal() * turn.transpose()); };
      const auto result = returned<3>(law, turned(row.trial));
      INFO(row.region << ", trial " << row.trial.transpose());
      CHECK(largest_difference(result, turned(row.expected)) < tolerance(row));
    }
  }
}

TEST_CASE("The return with a tension cut-off below the apex has the values worked by hand") {
  // D e_1 = G (3, 1, 1), D g_13 = 2 G (1, 0, -1): each trial is the expected stress plus multiples of these.
  SUBCASE("shear plane") { check_return({200, -500, -2200}, {0, -500, -2000}); }
  SUBCASE("edge of triaxial compression") { check_return({300, -2100, -2200}, {0, -2000, -2000}); }
  SUBCASE("edge of triaxial extension") { check_return({300, 200, -2000}, {100, 100, -1700}); }
  SUBCASE("cut-off plane") { check_return({1000, 100, -100}, {400, -100, -300}); }
  SUBCASE("cut-off edge") { check_return({1000, 900, 0}, {400, 400, -275}); }
  SUBCASE("cut-off corner") { check_return({2000, 1900, 1800}, {400, 400, 400}); }
  SUBCASE("cut-off edge beside the corner") { check_return({2000, 1900, 600}, {400, 400, -175}); }
  SUBCASE("line of shear plane and cut-off") { check_return({750, 50, -950}, {400, 0, -800}); }
  SUBCASE("corner of compression edge and cut-off") { check_return({820, -860, -960}, {400, -800, -800}); }
  SUBCASE("corner of extension edge and cut-off") { check_return({740, 600, -1040}, {400, 400, -800}); }
  SUBCASE("inside") { check_return({399, -100, -790}, {399, -100, -790}); }
}

TEST_CASE("With psi = 0 and a tensile mean stress beyond the apex the stress becomes the apex") {
  const MohrCoulomb law = soil({2.8e6, 0.333, 0, 30, 0});
  CHECK(principal_return(law, {9000, 2000, -4000}).norm() < 1e-9);
}

namespace {

/// Largest stress that is left [Pa] of a soil without stress after a strain e1 > 0 along one axis, e2 >= 0 along
/// another and none along the third. The trial then lies exactly between the corner (t, t, t), the edge s1 = s2 = t and
/// the plane s1 = t. Cloned as kernels are: round-off opened a gap there only where sums of products are fused.
[[gnu::target_clones("arch=x86-64-v3", "default")]] double largest_left(const MohrCoulomb& law) {
  const YieldSurface surface(law);
  double largest = 0;
  for (int k = 1; k < 20000; ++k) {
    const double e1 = 1e-7 * k, e2 = k % 3 == 0 ? 0.0 : e1 * (k % 89) / 97.0;
    const double sideways = surface.lambda * (e1 + e2);
    const Principal<double> trial{sideways + 2 * surface.shear * e1, sideways + 2 * surface.shear * e2, sideways};
    const Principal<double> left = return_to_yield(surface, trial, violates(surface, trial));
    largest = std::max(largest, std::abs(left.first) + std::abs(left.second) + std::abs(left.third));
  }
  return largest;
}

}  // namespace

TEST_CASE("A soil without stress that is stretched along one or two axes returns to its corner") {
  CHECK(largest_left(soil({1e6, 0.3, 10, 25, 5, 0})) < 1e-9);  // of trials up to 3000 Pa; the wrong corner is at -31 Pa
}

TEST_CASE("Soil that rests in the corner of shear plane and cut-off keeps its mean stress when it is sheared") {
  // Trials that return exactly there lie between two regions, and round-off may deny both: 332 of 20000 became (t, t,
  // m).
  const MohrCoulomb law = soil({10e6, 0.3, 3e3, 30, 0, 1e3});
  const YieldSurface surface(law);
  const Vector3d corner{surface.cutoff, surface.meeting, surface.meeting};
  Dice dice;
  for (int repeat = 0; repeat < 20000; ++repeat) {
    Vector3d strain = 2e-3 * Vector3d{dice.normal(), dice.normal(), dice.normal()};
    strain.array() -= strain.mean();
    Vector3d trial = corner + 2 * law.shear_modulus * strain;
    std::sort(trial.begin(), trial.end(), std::greater<>());
    CHECK(principal_return(law, trial).mean() < corner.mean() + 1e-8);  // of trials around 2e4 Pa
  }
}

TEST_CASE("Returned stresses are admissible and the plastic strain obeys the flow rule") {
  Dice dice;
  int plastic = 0;
  for (int trial_number = 0; trial_number < 20000; ++trial_number) {
    const double phi = dice.uniform(5, 45), cohesion = dice.uniform(500, 5000);
    const double apex = cohesion / std::tan(phi * std::acos(-1.0) / 180);
    // Up to just below the apex: there, with psi = 0, some states have no solution and the explicit rule holds.
    const MohrCoulomb law =
        soil({1e6, dice.uniform(0, 0.45), cohesion, phi, dice.uniform(0, phi), dice.uniform(0, 0.95) * apex});
    Vector3d trial = apex * Vector3d{dice.normal() - 0.5, dice.normal() - 0.5, dice.normal() - 0.5};
    std::sort(trial.begin(), trial.end(), std::greater<>());
    const Vector3d result = principal_return(law, trial);
    const double round_off = 1e-12 * (trial.norm() + apex);
    INFO("trial " << trial.transpose() << ", returned " << result.transpose());
    CHECK(worst_violation(law, result) < 10 * round_off);
    CHECK(result[0] >= result[1] - round_off);
    CHECK(result[1] >= result[2] - round_off);
    const Vector3d drop = trial - result;
    if (drop.norm() < 1e-6 * apex) continue;
    ++plastic;
    CHECK(distance_from_cone(active_flow(law, result, 10 * round_off), plastic_strain(law, drop)) < 1e-8);
  }
  CHECK(plastic > 10000);
}

TEST_CASE("The separated axis is an eigenvector, double eigenvalues included") {
  Dice dice;
  for (const double gap : {1.0, 1e-3, 1e-6, 1e-9, 1e-13, 0.0}) {
    for (int repeat = 0; repeat < 200; ++repeat) {
      const Matrix3d turn = dice.rotation();
      const double sign = repeat % 2 ? 1 : -1;
      const Vector3d values{dice.normal(), sign, sign + gap};
      const auto stress = components<3>(5e4 * turn * values.asDiagonal() * turn.transpose());
      const double mean = (stress[0] + stress[1] + stress[2]) / 3;
      const Stress<3, double> s{stress[0] - mean, stress[1] - mean, stress[2] - mean, stress[3], stress[4], stress[5]};
      const EigenAxis<double> axis = separated_axis(s, squared_scale(s));
      const Matrix3d dyad = matrix(axis.dyad);
      CHECK((matrix(s) * dyad - axis.eigenvalue * dyad).norm() < 1e-14 * 10 * largest(stress));
      CHECK(largest(s) * (dyad * dyad - dyad).norm() < 1e-14 * 10 * largest(stress));
      CHECK(dyad.trace() == near(1, 1e-15));
    }
  }
}

TEST_CASE("An isotropic trial stress returns to the apex") {
  // Without any deviator there is no direction to divide by; the apex of this soil is at 1000 sqrt(3) Pa.
  const double apex = 1000 * std::sqrt(3.0);
  const auto result = returned<3>(soil({1e6, 0.3, 1000, 30, 10}), {5000, 5000, 5000, 0, 0, 0});
  CHECK(largest_difference(result, {apex, apex, apex, 0, 0, 0}) < 1e-9);
  CHECK(largest_difference(returned<2>(soil({1e6, 0.3, 1000, 30, 10}), {5000, 5000, 5000, 0}), {apex, apex, apex, 0}) <
        1e-9);
}

TEST_CASE("The cone is inscribed in the yield surface: what it holds does not yield, and it touches") {
  Dice dice;
  int held = 0;
  for (int repeat = 0; repeat < 20000; ++repeat) {
    const MohrCoulomb law = soil({1e6, 0.3, repeat % 3 ? 1000.0 : 0.0, dice.uniform(1, 45), 0, dice.uniform(0, 1000)});
    const YieldSurface surface(law);
    const double mean = dice.uniform(-5000, 1000);
    const double room = surface.strength - 2 * law.sin_phi * mean;
    // s1 - s3 = 2 sqrt(3) p cos(angle) and s1 + s3 = -2 p sin(angle) are together worst at this angle.
    const double touching = -std::atan(law.sin_phi / std::sqrt(3.0));
    const double angle = repeat % 2 ? touching : dice.uniform(-std::numbers::pi / 6, std::numbers::pi / 6);
    const double on_cone = room / (2 * std::sqrt(3 + law.sin_phi * law.sin_phi));
    const double p = on_cone * (1 + std::pow(10, -dice.uniform(0, 14)) * dice.normal());
    if (!(p > 0)) continue;
    const Principal<double> s{mean + 2 * p * std::cos(std::numbers::pi / 6 + angle), mean + 2 * p * std::sin(angle),
                              mean - 2 * p * std::cos(std::numbers::pi / 6 - angle)};
    const bool outside = leaves_cone(surface, mean, p * p);
    CAPTURE(mean);
    CAPTURE(p / on_cone - 1);
    CAPTURE(angle);
    if (!outside) CHECK_FALSE(violates(surface, s));
    if (repeat % 2 && p > on_cone * (1 + 1e-9)) CHECK(violates(surface, s));
    held += !outside;
  }
  CHECK(held > 2000);
}
