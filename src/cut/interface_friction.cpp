#include "interface_friction.hpp"

#include <algorithm>
#include <cmath>

namespace geodrop {
namespace {

/// Tractions along a membrane at one stretch, no larger together than `most`.
void limit(double most, Eigen::Ref<Eigen::VectorXd> traction) {
  if (traction.size() == 1)
    traction[0] = std::clamp(traction[0], -most, most);
  else if (const double size = traction.norm(); size > most)
    traction *= most / size;
}

/// Tractions that stop the slip of rows, those of each stretch (Dim - 1 rows) together at most `most`: projected
/// Gauss-Seidel from a guess.
template <int Dim>
Eigen::VectorXd solve_limited(const SparseRows& S, const Eigen::VectorXd& slip_rate, const std::vector<double>& most,
                              Eigen::VectorXd traction) {
  constexpr int most_sweeps = 200;
  constexpr double tolerance = 1e-6;  // of the largest traction
  constexpr Eigen::Index ways = Dim - 1;
  Eigen::Matrix<double, ways, 1> before;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double change = 0;
    for (Eigen::Index first = 0; first < S.rows(); first += ways) {
      before = traction.template segment<ways>(first);
      for (Eigen::Index r = first; r < first + ways; ++r) {
        double held = 0, diagonal = 1;
        for (SparseRows::InnerIterator entry(S, r); entry; ++entry) {
          held += entry.value() * traction[entry.col()];
          if (entry.col() == r) diagonal = entry.value();
        }
        traction[r] += (slip_rate[r] - held) / diagonal;
      }
      limit(most[static_cast<std::size_t>(first / ways)], traction.segment(first, ways));
      change = std::max(change, (traction.template segment<ways>(first) - before).cwiseAbs().maxCoeff());
    }
    if (change <= tolerance * traction.cwiseAbs().maxCoeff()) break;
  }
  return traction;
}

}  // namespace

template <int Dim>
std::vector<std::array<double, Dim - 1>> tractions_along(const std::vector<Contact<Dim>>& contacts,
                                                         const Grids<Dim>& grids) {
  std::vector<std::array<double, Dim - 1>> out(contacts.size());
  const auto count = std::ssize(contacts);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t c = 0; c < count; ++c)
    if (contacts[c].rubs())
      for (std::size_t k = 0; k < Dim - 1; ++k)
        out[c][k] = last_traction(contacts[c], grids[contacts[c].membrane->field].outline, tangents<Dim>()[k]);
  return out;
}

template <int Dim>
void rub(double dt, const std::vector<RowsOfContact<Dim>>& said, std::vector<Contact<Dim>>& contacts, Grids<Dim>& grids,
         const std::vector<std::array<double, Dim - 1>>& last) {
  constexpr std::size_t ways = Dim - 1;
  ContactRows<Dim> rows(grids);
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (contacts[c].joined && contacts[c].rubs())
      for (const Says says : tangents<Dim>()) rows.add(along(contacts[c], says, said[c].rubbed(contacts[c])), c, says);
  if (rows.list().empty()) return;
  const Drag drag = rows.rows().drag(dt);
  NodeRows<Dim> T = rows.rows().matrix();
  const ByPlace<Dim> by_place(T);
  if (!drag.empty()) T = times(T, drag);
  const auto [S, slip_rate] = system_of(T, by_place, rows.rows().scaled_velocities() / dt);
  const Eigen::VectorXd slip = dt * slip_rate;
  Eigen::VectorXd guess(S.rows());
  std::vector<double> most(rows.list().size() / ways);
  for (std::size_t k = 0; k < most.size(); ++k) {
    const auto first = static_cast<Eigen::Index>(ways * k);
    const std::size_t c = rows.list()[ways * k].contact;
    most[k] = contacts[c].most_friction(slip.segment(first, ways).norm());
    for (std::size_t way = 0; way < ways; ++way) guess[first + static_cast<Eigen::Index>(way)] = last[c][way];
    limit(most[k], guess.segment(first, ways));
  }
  const Eigen::VectorXd traction = solve_limited<Dim>(S, slip_rate, most, guess);
  apply_pressures(rows.rows(), by_place, traction, dt, grids);
  store(rows, traction, grids, contacts);
}

using Along2 = std::vector<std::array<double, 1>>;
using Along3 = std::vector<std::array<double, 2>>;
template Along2 tractions_along(const std::vector<Contact<2>>&, const Grids<2>&);
template Along3 tractions_along(const std::vector<Contact<3>>&, const Grids<3>&);
template void rub(double, const std::vector<RowsOfContact<2>>&, std::vector<Contact<2>>&, Grids<2>&, const Along2&);
template void rub(double, const std::vector<RowsOfContact<3>>&, std::vector<Contact<3>>&, Grids<3>&, const Along3&);

}  // namespace geodrop
