// Anchors of sharp membranes, as rows of the constraint at the interface: both hold at the end of the step.
//
// A row says sum_i N_i e . v_i = e . v_k of the nodes i around an anchor's node k, e an axis (held), or the direction
// away from the end of the line. It is scaled by l = h^(d-1), so that its multiplier q is a traction as those of the
// other rows. With the distance g that the node has gone astray along e, or the stretch of the line, before the step,
//
//   (S + C l^2 / dt^2) q = (E v + l g / dt) / dt
//
// is the law of membrane/anchors after the step, C the compliance of the line (held: 0). The force on the node is -q l
// e; lines only pull, q >= 0.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <vector>

#include <Eigen/Core>

#include "interface_rows.hpp"

namespace geodrop {

template <int Dim>
struct AnchorRow {
  Anchor<Dim>* anchor;
  Vec<Dim> along;  ///< e
  double gap;      ///< g [m]
  double scale;    ///< l [m, m2]
  RawRow<Dim> row;

  /// Multiplier of the last step [Pa].
  double last() const { return -along.dot(Vec<Dim>(anchor->force.data())) / scale; }
};

template <int Dim>
using AnchorRows = std::vector<AnchorRow<Dim>>;

/// Those of the sharp membranes that are there, where the field inside has mass.
template <int Dim>
AnchorRows<Dim> anchor_rows(State<Dim>& state, const Grids<Dim>& grids);

/// Adds what the anchors' laws say to the system of all rows, theirs last.
template <int Dim>
void add_laws(const AnchorRows<Dim>& rows, double dt, SparseRows& S, Eigen::VectorXd& rate);

/// Keeps force and stretch; `missing`: what the multipliers leave of the system's right side.
template <int Dim>
void keep_forces(const AnchorRows<Dim>& rows, double dt, const Eigen::VectorXd& multipliers,
                 const Eigen::VectorXd& missing);

}  // namespace geodrop
