// Products of sparse matrices with the same bits for any number of threads.
#pragma once

#include <Eigen/SparseCore>

namespace geodrop {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// A B^T, row by row in parallel; each sum in the order of the columns.
SparseRows times_transpose(const SparseRows& A, const SparseRows& B);

}  // namespace geodrop
