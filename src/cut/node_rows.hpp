// Sparse rows whose columns are the velocities of nodes: as many columns each as there are axes. Products row by row in
// parallel, with the same bits for any number of threads.
#pragma once

#include <Eigen/SparseCore>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace geodrop {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// What a row says of one node.
template <int Dim>
struct NodeEntry {
  int place;  ///< number of the node among those that rows reach
  std::array<double, Dim> value;
};

/// Rows in the order of their places, each place once.
template <int Dim>
struct NodeRows {
  std::vector<std::vector<NodeEntry<Dim>>> rows;
  std::size_t places = 0;
};

/// The same entries by place: the rows that reach it, in order.
template <int Dim>
class ByPlace {
 public:
  struct Entry {
    int row;
    std::array<double, Dim> value;
  };

  explicit ByPlace(const NodeRows<Dim>& E);

  std::span<const Entry> at(std::size_t place) const {
    return {entries_.data() + begin_[place], entries_.data() + begin_[place + 1]};
  }
  std::size_t places() const { return begin_.size() - 1; }

 private:
  std::vector<std::size_t> begin_;
  std::vector<Entry> entries_;
};

/// A symmetric matrix that links each place with one other at most, the same along all axes.
struct DragAt {
  double own = 1, both = 0;  ///< on the diagonal, and between the two
  int partner = -1;
};
using Drag = std::vector<DragAt>;

/// B E.
template <int Dim>
NodeRows<Dim> times(const SparseRows& B, const NodeRows<Dim>& E);

/// E K; each sum has two terms at most, whose order does not matter.
template <int Dim>
NodeRows<Dim> times(const NodeRows<Dim>& E, const Drag& K);

/// E v, v by place and axis.
template <int Dim>
Eigen::VectorXd times(const NodeRows<Dim>& E, const Eigen::VectorXd& v);

/// A B^T of which it is known that it is symmetric, as E E^T or E K E^T with a symmetric K: the sums of its upper half,
/// each in the order of the places, stand in both halves.
template <int Dim>
SparseRows symmetric_product(const NodeRows<Dim>& A, const ByPlace<Dim>& B);

}  // namespace geodrop
