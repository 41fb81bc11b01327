#include "traction_solver.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <utility>

namespace geodrop {
namespace {

constexpr double tolerance = 1e-8;  // of the gaps' rate

/// Tractions that stop the gaps from opening and closing, and the slip where it sticks: conjugate gradients.
Solution iterate(const SparseRows& S, const Eigen::VectorXd& gap_rate, const Eigen::VectorXd& guess) {
  constexpr int most_iterations = 1000;
  // Rows stand in the order of the outline. With the diagonal alone 98 iterations in the place of 3
  // (main case, 116 rows, a pressure for each stretch).
  using Preconditioner = Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>;
  Eigen::ConjugateGradient<SparseRows, Eigen::Lower | Eigen::Upper, Preconditioner> solver(S);
  solver.setTolerance(tolerance);
  solver.setMaxIterations(most_iterations);
  Eigen::VectorXd traction = solver.solveWithGuess(gap_rate, guess);
  return {std::move(traction), solver.info() == Eigen::Success};
}

/// Solves systems of one pattern.
template <int Dim>
class Solver;

/// Along an outline an incomplete factor is nearly whole.
template <>
class Solver<2> {
 public:
  explicit Solver(const SparseRows&) {}
  Solution solve(const SparseRows& S, const Eigen::VectorXd& gap_rate, const Eigen::VectorXd& guess) {
    return iterate(S, gap_rate, guess);
  }
};

/// On a surface the whole factor costs less than the incomplete one and its iterations: 14 ms, of which 4 with a known
/// pattern, in the place of 33 (632 rows, 12 iterations); on a bed 37 ms in the place of 128 (1254 rows, 190
/// iterations). Two knots of a single stretch make S singular; whatever both take of its traction is right.
template <>
class Solver<3> {
 public:
  explicit Solver(const SparseRows& pattern) { factor_.analyzePattern(pattern); }
  Solution solve(const SparseRows& S, const Eigen::VectorXd& gap_rate, const Eigen::VectorXd& guess) {
    constexpr double held = 1e-10;  // what a diagonal grows by, and about the error of the gaps' rate
    SparseRows regular = S;
    for (Eigen::Index r = 0; r < S.rows(); ++r) regular.coeffRef(r, r) *= 1 + held;
    factor_.factorize(regular);
    if (factor_.info() == Eigen::Success) {
      Eigen::VectorXd traction = factor_.solve(gap_rate);
      if ((gap_rate - S * traction).norm() <= tolerance * gap_rate.norm()) return {std::move(traction), true};
    }
    return iterate(S, gap_rate, guess);
  }

 private:
  Eigen::SimplicialLLT<SparseRows> factor_;
};

}  // namespace

template <int Dim>
Solution solve_tractions(const System& system, const std::vector<bool>& only_pushes, const Eigen::VectorXd& guess) {
  constexpr int most_rounds = 10;
  const auto& [S, gap_rate] = system;
  Solver<Dim> solver(S);
  Solution found = solver.solve(S, gap_rate, guess);
  if (std::find(only_pushes.begin(), only_pushes.end(), true) == only_pushes.end()) return found;
  Eigen::VectorXd joined = Eigen::VectorXd::Ones(gap_rate.size());
  for (int round = 0; round < most_rounds; ++round) {
    const Eigen::VectorXd closing = gap_rate - S * found.traction;
    bool changed = false;
    for (Eigen::Index r = 0; r < gap_rate.size(); ++r) {
      const double pushes = only_pushes[r] && found.traction[r] + closing[r] / S.coeff(r, r) < 0 ? 0 : 1;
      changed = changed || pushes != joined[r];
      joined[r] = pushes;
    }
    if (!changed) return found;
    SparseRows of_joined = joined.asDiagonal() * S * joined.asDiagonal();
    of_joined.diagonal().array() += 1 - joined.array();
    found = solver.solve(of_joined, joined.cwiseProduct(gap_rate), joined.cwiseProduct(guess));
  }
  found.converged = false;  // the last sets are not those of their solution
  return found;
}

template Solution solve_tractions<2>(const System&, const std::vector<bool>&, const Eigen::VectorXd&);
template Solution solve_tractions<3>(const System&, const std::vector<bool>&, const Eigen::VectorXd&);

}  // namespace geodrop
