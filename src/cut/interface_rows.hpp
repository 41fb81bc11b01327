// The rows of the constraint at sharp interfaces: what they say about velocities, as the nodes can take it.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <array>
#include <initializer_list>
#include <utility>
#include <vector>

#include "grid/node_vectors.hpp"
#include "node_rows.hpp"
#include "stretches.hpp"

namespace geodrop {

/// The nodes that the rows of E reach, of all fields.
template <int Dim>
class Places {
 public:
  struct Place {
    int field, node;
    double root_mass;             ///< [kg^1/2]
    std::array<bool, Dim> fixed;  ///< components that a wall holds
  };

  explicit Places(const Grids<Dim>& grids);

  /// Number of a node that has mass.
  int of(int field, int node);
  const std::vector<Place>& list() const { return list_; }

 private:
  const Grids<Dim>& grids_;
  int first_;                             ///< flat index of the first node that rows may reach
  std::vector<std::vector<int>> number_;  ///< by field and node from there on
  std::vector<Place> list_;
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

/// What a row says of one field.
template <int Dim>
struct TermOfRow {
  int field;
  double sign;
  const std::vector<NodeVector<Dim>>& vectors;
};

/// A row that adds up, or takes off, the vectors of the nodes of fields, each as the nodes can take it.
template <int Dim>
RawRow<Dim> make_row(const Grids<Dim>& grids, std::initializer_list<TermOfRow<Dim>> terms);

/// Of one field, less another.
template <int Dim>
RawRow<Dim> make_row(const Grids<Dim>& grids, int field, int other, const std::vector<NodeVector<Dim>>& vectors);

/// A row of one field's nodes alone.
template <int Dim>
RawRow<Dim> make_row(const Grids<Dim>& grids, int field, const std::vector<NodeVector<Dim>>& vectors);

/// The row along an outline from the one normal to it: all vectors a quarter turn anticlockwise.
RawRow<2> along(RawRow<2> normal);

/// Builds E M^-1/2 row by row.
template <int Dim>
class Rows {
 public:
  explicit Rows(const Grids<Dim>& grids) : grids_(grids), places_(grids) {}

  /// None, and false, if the row is not complete.
  bool add(const RawRow<Dim>& row);

  std::size_t count() const { return rows_.size(); }
  NodeRows<Dim> matrix() const;

  /// What the drag between soils and the water in their pores leaves of a step's impulses at the nodes, implicitly as
  /// in pores/pores: (1 + dt M^-1/2 C M^-1/2)^-1; adds the places of their partners. Empty if nothing drags there.
  Drag drag(double dt);

  /// M^1/2 v of the places [kg^1/2 m/s].
  Eigen::VectorXd scaled_velocities() const;

  const Places<Dim>& places() const { return places_; }

 private:
  const Grids<Dim>& grids_;
  Places<Dim> places_;
  std::vector<std::vector<NodeEntry<Dim>>> rows_;  ///< in the order in which nodes turned up
};

/// v -= dt M^-1 E^T p.
template <int Dim>
void apply_pressures(const Rows<Dim>& rows, const ByPlace<Dim>& E, const Eigen::VectorXd& pressure, double dt,
                     Grids<Dim>& grids);

}  // namespace geodrop
