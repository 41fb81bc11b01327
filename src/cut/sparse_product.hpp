// Products of sparse matrices with the same bits for any number of threads.
#pragma once

#include <Eigen/SparseCore>

namespace geodrop {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// A B^T of which it is known that it is symmetric, as E E^T or E K E^T with a symmetric K: the sums of its upper half,
/// each in the order of the columns, stand in both halves. Row by row in parallel.
SparseRows symmetric_product(const SparseRows& A, const SparseRows& B);

}  // namespace geodrop
