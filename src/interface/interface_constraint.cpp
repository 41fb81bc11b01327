#include "interface_constraint.hpp"

#include <geodrop/find_named.hpp>

#include <Eigen/Dense>
#include <Eigen/IterativeLinearSolvers>

#include <algorithm>

#include "../grid/momentum.hpp"
#include "interface_rows.hpp"
#include "outline_pieces.hpp"

namespace geodrop {
namespace {

/// A row: the membrane that it belongs to, the part of its outline, and what lies there.
struct Contact {
  Membrane<2>* membrane;
  Stretch stretch;
  bool on_bed = false;
  double pore_pressure = 0;  ///< of the bed [Pa]
};

/// Mean over a stretch of the pressure that its segments had.
double last_pressure(const Contact& contact, const CutCells& cells) {
  double sum = 0;
  for_each_piece(cells, contact.stretch, [&](const CutCells::Piece& piece) {
    sum += contact.membrane->water_pressure[piece.edge] * length_of(*contact.membrane, piece);
  });
  return contact.stretch.length > 0 ? sum / contact.stretch.length : 0;
}

/// Where the bed is around a membrane: volume of its particles in each cell of the box, and that times pore pressure.
struct BedCells {
  Array<double> volume, pore;
};

BedCells bed_around(const State<2>& state, const GridLayout<2>& layout, const Membrane<2>& membrane,
                    const CutCells& cells) {
  BedCells out{Array<double>(cells.size(), 0.0), Array<double>(cells.size(), 0.0)};
  const Body<2>& bed = find_named(state.bodies, membrane.bed);
  for (std::size_t p = 0; p < bed.size(); ++p) {
    const int cell = local_cell(layout, cells, bed.x[0][p], bed.x[1][p]);
    if (cell < 0) continue;
    const double volume = bed.volume(p);
    out.volume[cell] += volume;
    if (!bed.pore_pressure.empty()) out.pore[cell] += volume * bed.pore_pressure[p];
  }
  return out;
}

/// Whether a stretch lies on the bed: most of what is in the cells around it.
void look_for_bed(const Grid<2>& around, const CutCells& cells, const BedCells& bed, Contact& contact) {
  double soil = 0, pore = 0, all = 0;
  for_each_piece(cells, contact.stretch, [&](const CutCells::Piece& piece) {
    for (int n = 0; n < 9; ++n) {
      const int local = local_around(cells, piece.cell, n);
      soil += bed.volume[local];
      pore += bed.pore[local];
      all += around.cell_volume[flat_of(around.layout, cells, local)];
    }
  });
  contact.on_bed = soil > 0.5 * all;
  if (contact.on_bed) contact.pore_pressure = pore / soil;
}

std::vector<Contact> build_rows(State<2>& state, const Grids<2>& grids, Rows& rows) {
  std::vector<Contact> contacts;
  const Grid<2>& around = grids.front();
  for (Membrane<2>& membrane : state.membranes) {
    if (!acts_sharply(membrane)) continue;
    const CutCells& cells = grids[membrane.field].outline;
    const BedCells bed = membrane.bed.empty() ? BedCells{} : bed_around(state, around.layout, membrane, cells);
    for (const Stretch& stretch : wet_stretches(around, membrane, cells)) {
      if (!rows.add(membrane.field, 0, line_integrals(around.layout, membrane, cells, stretch, Direction::normal)))
        continue;
      contacts.push_back({&membrane, stretch});
      if (!membrane.bed.empty()) look_for_bed(around, cells, bed, contacts.back());
    }
  }
  return contacts;
}

/// Pressures that stop the gaps from opening and closing.
Eigen::VectorXd solve(const SparseRows& S, const Eigen::VectorXd& gap_rate, const Eigen::VectorXd& guess) {
  constexpr double tolerance = 1e-8;  // of the gaps' rate
  constexpr int most_iterations = 1000;
  Eigen::ConjugateGradient<SparseRows, Eigen::Lower | Eigen::Upper> solver(S);
  solver.setTolerance(tolerance);
  solver.setMaxIterations(most_iterations);
  return solver.solveWithGuess(gap_rate, guess);
}

/// Coulomb friction on the bed: tractions along the membrane that stop it, at most mu times the effective pressure.
/// Projected Gauss-Seidel.
void rub_on_bed(const std::vector<Contact>& contacts, const Eigen::VectorXd& pressure, double dt, Grids<2>& grids) {
  constexpr int sweeps = 30;
  Rows rows(grids);
  std::vector<double> most;
  for (std::size_t r = 0; r < contacts.size(); ++r) {
    const Contact& contact = contacts[r];
    const double bound = contact.on_bed ? contact.membrane->bed_friction * (pressure[r] - contact.pore_pressure) : 0;
    if (bound <= 0) continue;
    const Membrane<2>& membrane = *contact.membrane;
    const CutCells& cells = grids[membrane.field].outline;
    if (rows.add(membrane.field, 0,
                 line_integrals(grids[0].layout, membrane, cells, contact.stretch, Direction::tangent)))
      most.push_back(bound);
  }
  if (most.empty()) return;
  const SparseRows T = rows.matrix();
  const Eigen::MatrixXd S = T * T.transpose();
  const Eigen::VectorXd slip_rate = T * rows.scaled_velocities() / dt;
  Eigen::VectorXd traction = Eigen::VectorXd::Zero(S.rows());
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (Eigen::Index r = 0; r < S.rows(); ++r) {
      const double wanted = traction[r] + (slip_rate[r] - S.row(r).dot(traction)) / S(r, r);
      traction[r] = std::clamp(wanted, -most[r], most[r]);
    }
  apply_pressures(rows, T, traction, dt, grids);
}

void store_pressures(const std::vector<Contact>& contacts, const Eigen::VectorXd& pressure, const Grids<2>& grids,
                     State<2>& state) {
  for (Membrane<2>& membrane : state.membranes)
    std::fill(membrane.water_pressure.begin(), membrane.water_pressure.end(), 0.0);
  for (std::size_t r = 0; r < contacts.size(); ++r) {
    Membrane<2>& membrane = *contacts[r].membrane;
    for_each_piece(grids[membrane.field].outline, contacts[r].stretch, [&](const CutCells::Piece& piece) {
      membrane.water_pressure[piece.edge] += (piece.to - piece.from) * pressure[static_cast<Eigen::Index>(r)];
    });
  }
}

}  // namespace

template <>
void join_interfaces(State<2>& state, Grids<2>& grids, double dt) {
  Rows rows(grids);
  const std::vector<Contact> contacts = build_rows(state, grids, rows);
  if (contacts.empty()) return;
  const SparseRows E = rows.matrix();
  Eigen::VectorXd guess(contacts.size());
  for (std::size_t r = 0; r < contacts.size(); ++r)
    guess[r] = last_pressure(contacts[r], grids[contacts[r].membrane->field].outline);
  const Eigen::VectorXd pressure = solve(E * E.transpose(), E * rows.scaled_velocities() / dt, guess);
  apply_pressures(rows, E, pressure, dt, grids);
  rub_on_bed(contacts, pressure, dt, grids);
  for (Grid<2>& grid : grids) impose_wall_velocity(grid);
  store_pressures(contacts, pressure, grids, state);
}

// Sharp interfaces are for the plane: check_scene refuses them in space.
template <>
void join_interfaces(State<3>&, Grids<3>&, double) {}

}  // namespace geodrop
