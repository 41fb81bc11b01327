// The rows of the constraint at sharp interfaces: what they say about velocities, as the nodes can take it.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <array>
#include <utility>
#include <vector>

#include "grid/node_vectors.hpp"
#include "sparse_product.hpp"
#include "stretches.hpp"

namespace geodrop {

/// The nodes that the rows of E reach, of all fields: as many columns each as there are axes.
template <int Dim>
class Columns {
 public:
  struct Place {
    int field, node;
    double root_mass;             ///< [kg^1/2]
    std::array<bool, Dim> fixed;  ///< components that a wall holds
  };

  explicit Columns(const Grids<Dim>& grids);

  /// Number of the first of the columns of a node that has mass.
  int of(int field, int node);
  const std::vector<Place>& places() const { return places_; }

 private:
  const Grids<Dim>& grids_;
  std::array<int, Dim> first_{}, count_{};  ///< stored nodes that rows may reach: around the outlines
  std::vector<std::vector<int>> number_;    ///< by field and node of that box
  std::vector<Place> places_;
};

/// A row on its way: what it says of the velocities of nodes, times M^-1/2, in the order in which nodes turned up.
template <int Dim>
struct RawRow {
  struct Entry {
    int field, node;
    std::array<double, Dim> value;
  };
  std::vector<Entry> entries;
  bool complete = false;  ///< its fields have mass there
};

/// A row that adds up the vectors of one field's nodes and takes off the other's, each as the nodes can take it.
template <int Dim>
RawRow<Dim> make_row(const Grids<Dim>& grids, int field, int other, const std::vector<NodeVector<Dim>>& vectors);

/// A row of one field's nodes alone.
template <int Dim>
RawRow<Dim> make_row(const Grids<Dim>& grids, int field, const std::vector<NodeVector<Dim>>& vectors);

/// The row along an outline from the one normal to it: all vectors a quarter turn anticlockwise.
RawRow<2> along(RawRow<2> normal);

/// A symmetric matrix that links each column with one other at most.
struct DragAt {
  double own = 1, both = 0;  ///< on the diagonal, and between the two
  int partner = -1;
};
using Drag = std::vector<DragAt>;

/// E K; each sum has two terms at most, whose order does not matter.
SparseRows times(const SparseRows& E, const Drag& K);

/// Builds E M^-1/2 row by row.
template <int Dim>
class Rows {
 public:
  explicit Rows(const Grids<Dim>& grids) : grids_(grids), columns_(grids) {}

  /// None, and false, if the row is not complete.
  bool add(const RawRow<Dim>& row);

  int count() const { return static_cast<int>(row_begin_.size()) - 1; }
  SparseRows matrix() const;

  /// What the drag between soils and the water in their pores leaves of a step's impulses at the columns, implicitly as
  /// in pores/pores: (1 + dt M^-1/2 C M^-1/2)^-1; adds the columns of their partners. Empty if nothing drags there.
  Drag drag(double dt);

  /// M^1/2 v of the columns [kg^1/2 m/s].
  Eigen::VectorXd scaled_velocities() const;

  const Columns<Dim>& columns() const { return columns_; }

 private:
  struct Entry {
    int column;  ///< the first of its node
    std::array<double, Dim> value;
  };

  const Grids<Dim>& grids_;
  Columns<Dim> columns_;
  std::vector<Entry> entries_;
  std::vector<std::size_t> row_begin_{0};
};

/// v -= dt M^-1 E^T p.
template <int Dim>
void apply_pressures(const Rows<Dim>& rows, const SparseRows& E, const Eigen::VectorXd& pressure, double dt,
                     Grids<Dim>& grids);

}  // namespace geodrop
