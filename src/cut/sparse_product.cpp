#include "sparse_product.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace geodrop {

SparseRows times_transpose(const SparseRows& A, const SparseRows& B) {
  const SparseRows Bt = B.transpose();
  const int *a_begin = A.outerIndexPtr(), *a_column = A.innerIndexPtr();
  const int *b_begin = Bt.outerIndexPtr(), *b_column = Bt.innerIndexPtr();
  const double *a_value = A.valuePtr(), *b_value = Bt.valuePtr();
  const auto rows = static_cast<int>(A.rows());
  const bool symmetric = &A == &B;  // the upper half is enough then: both halves are the same sums
  std::vector<std::vector<std::pair<int, double>>> upper(rows), lower(rows);
#pragma omp parallel
  {
    std::vector<double> sum(B.rows(), 0.0);
    std::vector<int> met(B.rows(), -1), columns;  // by the row that met it last
#pragma omp for schedule(dynamic, 16)
    for (int r = 0; r < rows; ++r) {
      columns.clear();
      for (int k = a_begin[r]; k < a_begin[r + 1]; ++k)
        for (int l = b_begin[a_column[k] + 1]; l-- > b_begin[a_column[k]];) {
          const int c = b_column[l];
          if (symmetric && c < r) break;
          if (met[c] != r) {
            met[c] = r;
            sum[c] = 0;
            columns.push_back(c);
          }
          sum[c] += a_value[k] * b_value[l];
        }
      std::sort(columns.begin(), columns.end());
      upper[r].reserve(columns.size());
      for (const int c : columns) upper[r].emplace_back(c, sum[c]);
    }
  }
  std::size_t entries = 0;
  for (int r = 0; r < rows; ++r) {
    entries += (symmetric ? 2 : 1) * upper[r].size();
    for (const auto& [c, value] : upper[r])
      if (symmetric && c > r) lower[c].emplace_back(r, value);
  }
  SparseRows product(A.rows(), B.rows());
  product.reserve(static_cast<Eigen::Index>(entries));
  for (int r = 0; r < rows; ++r) {
    product.startVec(r);
    for (const auto* half : {&lower[r], &upper[r]})
      for (const auto& [c, value] : *half) product.insertBack(r, c) = value;
  }
  product.finalize();
  return product;
}

}  // namespace geodrop
