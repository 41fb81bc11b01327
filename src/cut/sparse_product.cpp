#include "sparse_product.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace geodrop {
namespace {

using UpperRows = std::vector<std::vector<std::pair<int, double>>>;  // columns from the diagonal on, in order

/// Both halves.
SparseRows mirrored(const UpperRows& upper) {
  const auto n = static_cast<int>(upper.size());
  SparseRows out(n, n);
  int* const begin = out.outerIndexPtr();
  for (int r = 0; r < n; ++r) {
    begin[r + 1] += static_cast<int>(upper[r].size());
    for (const auto& [c, value] : upper[r])
      if (c > r) ++begin[c + 1];
  }
  for (int r = 0; r < n; ++r) begin[r + 1] += begin[r];
  out.resizeNonZeros(begin[n]);
  std::vector<int> next(begin, begin + n);
  const auto put = [&](int r, int c, double value) {
    out.innerIndexPtr()[next[r]] = c;
    out.valuePtr()[next[r]++] = value;
  };
  for (int r = 0; r < n; ++r)  // what stands before the diagonal comes from the rows above
    for (const auto& [c, value] : upper[r]) {
      put(r, c, value);
      if (c > r) put(c, r, value);
    }
  return out;
}

}  // namespace

SparseRows symmetric_product(const SparseRows& A, const SparseRows& B) {
  const SparseRows Bt = B.transpose();
  const int *a_begin = A.outerIndexPtr(), *a_column = A.innerIndexPtr();
  const int *b_begin = Bt.outerIndexPtr(), *b_column = Bt.innerIndexPtr();
  const double *a_value = A.valuePtr(), *b_value = Bt.valuePtr();
  const auto rows = static_cast<int>(A.rows());
  UpperRows upper(rows);
#pragma omp parallel
  {
    std::vector<double> sum(rows, 0.0);
    std::vector<int> met(rows, -1), columns;  // by the row that met it last
#pragma omp for schedule(dynamic, 16)
    for (int r = 0; r < rows; ++r) {
      columns.clear();
      for (int k = a_begin[r]; k < a_begin[r + 1]; ++k)
        for (int l = b_begin[a_column[k] + 1]; l-- > b_begin[a_column[k]] && b_column[l] >= r;) {
          const int c = b_column[l];
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
  return mirrored(upper);
}

}  // namespace geodrop
