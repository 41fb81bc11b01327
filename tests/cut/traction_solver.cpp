// Tractions of rows: against dense algebra, with rows that may only push, with rows that say the same twice.
#include "cut/traction_solver.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>

#include <random>

using namespace geodrop;

namespace {

constexpr int rows = 40;

/// E E^T of random rows of five neighbouring columns each; their tractions have areas from 1e-3 to 1.
System system_of_rows(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  Eigen::MatrixXd E = Eigen::MatrixXd::Zero(rows, rows + 4);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < 5; ++c) E(r, r + c) = any(random) * std::pow(10, -3.0 * (r % 7) / 6);
  const Eigen::MatrixXd S = E * E.transpose();
  const Eigen::VectorXd velocities = Eigen::VectorXd::NullaryExpr(rows + 4, [&](Eigen::Index) { return any(random); });
  return {S.sparseView(), E * velocities};
}

/// The last row says what the one before says, and so does the one before that: S is singular.
System repeated(System system) {
  Eigen::MatrixXd twice = Eigen::MatrixXd::Zero(rows + 2, rows);
  twice.topRows(rows).setIdentity();
  twice(rows, rows - 1) = 2;
  twice(rows + 1, rows - 1) = 0.1;
  const Eigen::MatrixXd S = twice * system.S * twice.transpose();
  return {S.sparseView(), twice * system.rate};
}

}  // namespace

TEST_CASE_TEMPLATE("Tractions are those of dense algebra, whatever the guess", Outline, std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const System system = system_of_rows(seed);
    const Eigen::VectorXd exact = Eigen::MatrixXd(system.S).ldlt().solve(system.rate);
    for (const double scale : {0.0, 1.0}) {
      const auto [traction, converged] =
          solve_tractions<Outline::value>(system, std::vector<bool>(rows, false), scale * exact);
      CHECK(converged);
      CHECK((system.rate - system.S * traction).norm() < 1e-8 * system.rate.norm());
    }
  }
}

TEST_CASE_TEMPLATE("Rows that may only push do, or their gap opens", Outline, std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>) {
  int open = 0, shut = 0;
  for (const unsigned seed : {1u, 2u, 3u}) {
    const System system = system_of_rows(seed);
    std::vector<bool> only_pushes(rows, false);
    for (int r = 0; r < rows; r += 3) only_pushes[r] = true;
    const auto [traction, converged] =
        solve_tractions<Outline::value>(system, only_pushes, Eigen::VectorXd::Zero(rows));
    REQUIRE(converged);
    const Eigen::VectorXd left = system.rate - system.S * traction;
    const double small = 1e-7 * system.rate.norm();
    for (int r = 0; r < rows; ++r) {
      if (!only_pushes[r] || traction[r] != 0) {
        CHECK(std::abs(left[r]) < small);
        if (only_pushes[r]) ++shut;
      } else {
        CHECK(left[r] < small);
        ++open;
      }
      if (only_pushes[r]) CHECK(traction[r] >= 0);
    }
  }
  CHECK(open > 3);
  CHECK(shut > 3);
}

TEST_CASE_TEMPLATE("Rows that say the same have tractions, which only their sum decides", Outline,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const System single = system_of_rows(seed), system = repeated(single);
    const auto [traction, converged] =
        solve_tractions<Outline::value>(system, std::vector<bool>(rows + 2, false), Eigen::VectorXd::Zero(rows + 2));
    CHECK(converged);
    CHECK((system.rate - system.S * traction).norm() < 1e-8 * system.rate.norm());
    const double sum = traction[rows - 1] + 2 * traction[rows] + 0.1 * traction[rows + 1];
    const Eigen::VectorXd exact = Eigen::MatrixXd(single.S).ldlt().solve(single.rate);
    CHECK(std::abs(sum - exact[rows - 1]) < 1e-4 * exact.norm());
  }
}
