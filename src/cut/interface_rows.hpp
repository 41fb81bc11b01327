// The rows of the constraint at sharp interfaces: what they say about velocities, as the nodes can take it.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <Eigen/SparseCore>

#include <array>
#include <utility>
#include <vector>

namespace geodrop {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// A vector at a node.
struct NodeVector {
  int node;
  std::array<double, 2> value;
};

/// A part of an outline with one multiplier: consecutive pieces, [first, last) in CutCells::pieces, round its end.
struct Stretch {
  std::size_t first = 0, count = 0;
  double length = 0;  ///< [m]
};

/// The stretches of an outline that has something beside it. Two flanks in one cell are two stretches.
std::vector<Stretch> wet_stretches(const Grid<2>& around, const Membrane<2>& membrane, const CutCells& cells);

/// f(piece) for the pieces of a stretch.
template <class F>
void for_each_piece(const CutCells& cells, const Stretch& stretch, F&& f) {
  for (std::size_t k = 0; k < stretch.count; ++k) f(cells.pieces[(stretch.first + k) % cells.pieces.size()]);
}

/// Length of a piece [m].
double length_of(const Membrane<2>& membrane, const CutCells::Piece& piece);

enum class Direction { normal, tangent };

/// int N n dl over a stretch, or along it int N t dl, t the outward normal turned anticlockwise.
std::vector<NodeVector> line_integrals(const GridLayout<2>& layout, const Membrane<2>& membrane, const CutCells& cells,
                                       const Stretch& stretch, Direction direction);

/// The nodes that the rows of E reach, of all fields: two columns each.
class Columns {
 public:
  struct Place {
    int field, node;
    double root_mass;           ///< [kg^1/2]
    std::array<bool, 2> fixed;  ///< components that a wall holds
  };

  explicit Columns(const Grids<2>& grids)
      : grids_(grids), number_(grids.size(), std::vector<int>(grids.front().layout.nodes(), -1)) {}

  /// Number of the first of both columns of a node that has mass.
  int of(int field, int node);
  const std::vector<Place>& places() const { return places_; }

 private:
  const Grids<2>& grids_;
  std::vector<std::vector<int>> number_;  ///< by field and node
  std::vector<Place> places_;
};

/// Builds E M^-1/2 row by row; all rows reach nodes of two fields.
class Rows {
 public:
  explicit Rows(const Grids<2>& grids) : grids_(grids), columns_(grids) {}

  /// A row that adds up the vectors of one field's nodes and takes off the other's, each as the nodes can take it;
  /// none, and false, if one of the fields has no mass there.
  bool add(int field, int other, const std::vector<NodeVector>& vectors);

  int count() const { return static_cast<int>(row_begin_.size()) - 1; }
  SparseRows matrix() const;

  /// What the drag between soils and the water in their pores leaves of a step's impulses at the columns, implicitly as
  /// in pores/pores: (1 + dt M^-1/2 C M^-1/2)^-1; adds the columns of their partners. Empty if nothing drags there.
  SparseRows drag(double dt);

  /// M^1/2 v of the columns [kg^1/2 m/s].
  Eigen::VectorXd scaled_velocities() const;

  const Columns& columns() const { return columns_; }

 private:
  bool add_field(int field, double sign, const std::vector<NodeVector>& vectors);
  void put(int field, int node, double share, const std::array<double, 2>& value);
  bool spread(int field, int node, double share, const std::array<double, 2>& value);
  void spread_over_row(std::size_t first, int field, const std::array<double, 2>& value);
  void end_row(bool keep);

  const Grids<2>& grids_;
  Columns columns_;
  std::vector<double> value_;  ///< of the present row, by column
  std::vector<int> touched_;
  std::vector<std::pair<int, double>> entries_;
  std::vector<int> row_begin_{0};
};

/// v -= dt M^-1 E^T p.
void apply_pressures(const Rows& rows, const SparseRows& E, const Eigen::VectorXd& pressure, double dt,
                     Grids<2>& grids);

}  // namespace geodrop
