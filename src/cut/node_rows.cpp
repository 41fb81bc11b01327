#include "node_rows.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

namespace geodrop {
namespace {

/// Numbers that were met.
class NumberSet {
 public:
  explicit NumberSet(std::size_t size) : words_((size + 63) / 64, 0) {}

  /// Whether it is the first time.
  bool add(int number) {
    std::uint64_t& word = words_[static_cast<std::size_t>(number) / 64];
    const std::uint64_t bit = std::uint64_t{1} << (static_cast<unsigned>(number) % 64);
    const bool first = (word & bit) == 0;
    word |= bit;
    return first;
  }

  /// f(number), from the least to the largest; none are left.
  template <class F>
  void take(F&& f) {
    for (std::size_t w = 0; w < words_.size(); ++w)
      for (; words_[w] != 0; words_[w] &= words_[w] - 1) f(static_cast<int>(64 * w) + std::countr_zero(words_[w]));
  }

 private:
  std::vector<std::uint64_t> words_;
};

/// A row of sums; empty for the next one when its entries are taken.
template <int Dim>
class RowOfSums {
 public:
  explicit RowOfSums(std::size_t places) : sum_(places), met_(places) {}

  void add(int place, double factor, const std::array<double, Dim>& value) {
    std::array<double, Dim>& sum = sum_[place];
    const bool first = met_.add(place);
    for (int a = 0; a < Dim; ++a) sum[a] = first ? factor * value[a] : sum[a] + factor * value[a];
    count_ += first;
  }

  std::vector<NodeEntry<Dim>> take() {
    std::vector<NodeEntry<Dim>> row;
    row.reserve(count_);
    met_.take([&](int place) { row.push_back({place, sum_[place]}); });
    count_ = 0;
    return row;
  }

 private:
  std::vector<std::array<double, Dim>> sum_;
  NumberSet met_;
  std::size_t count_ = 0;
};

/// Rows of sums: f(row, its sums).
template <int Dim, class F>
NodeRows<Dim> sums(std::size_t rows, std::size_t places, F&& f) {
  NodeRows<Dim> out{std::vector<std::vector<NodeEntry<Dim>>>(rows), places};
  const auto count = static_cast<std::ptrdiff_t>(rows);
#pragma omp parallel
  {
    RowOfSums<Dim> row(places);
#pragma omp for schedule(dynamic, 16)
    for (std::ptrdiff_t r = 0; r < count; ++r) {
      f(r, row);
      out.rows[r] = row.take();
    }
  }
  return out;
}

/// f(row, entry) for all entries, those of one place in the order of rows and on one thread.
template <int Dim, class F>
void for_ranges_of_places(const NodeRows<Dim>& E, F&& f) {
  constexpr int places_at_once = 2048;
  const auto places = static_cast<int>(E.places);
#pragma omp parallel for schedule(dynamic, 1) if (places > places_at_once)
  for (int first = 0; first < places; first += places_at_once)
    for (std::size_t r = 0; r < E.rows.size(); ++r) {
      const auto& row = E.rows[r];
      auto entry = std::lower_bound(row.begin(), row.end(), first,
                                    [](const NodeEntry<Dim>& one, int place) { return one.place < place; });
      for (; entry != row.end() && entry->place < first + places_at_once; ++entry) f(r, *entry);
    }
}

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

template <int Dim>
ByPlace<Dim>::ByPlace(const NodeRows<Dim>& E) : begin_(E.places + 1, 0) {
  for_ranges_of_places(E, [&](std::size_t, const NodeEntry<Dim>& entry) { ++begin_[entry.place + 1]; });
  for (std::size_t place = 0; place < E.places; ++place) begin_[place + 1] += begin_[place];
  entries_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for_ranges_of_places(E, [&](std::size_t row, const NodeEntry<Dim>& entry) {
    entries_[next[entry.place]++] = {static_cast<int>(row), entry.value};
  });
}

template <int Dim>
NodeRows<Dim> times(const SparseRows& B, const NodeRows<Dim>& E) {
  return sums<Dim>(B.rows(), E.places, [&](std::ptrdiff_t r, RowOfSums<Dim>& row) {
    for (SparseRows::InnerIterator of_row(B, r); of_row; ++of_row)
      for (const auto& [place, value] : E.rows[of_row.col()]) row.add(place, of_row.value(), value);
  });
}

template <int Dim>
NodeRows<Dim> times(const NodeRows<Dim>& E, const Drag& K) {
  return sums<Dim>(E.rows.size(), E.places, [&](std::ptrdiff_t r, RowOfSums<Dim>& row) {
    for (const auto& [place, value] : E.rows[r]) {
      const auto& [own, both, partner] = K[place];
      row.add(place, own, value);
      if (partner >= 0) row.add(partner, both, value);
    }
  });
}

template <int Dim>
Eigen::VectorXd times(const NodeRows<Dim>& E, const Eigen::VectorXd& v) {
  const auto rows = static_cast<std::ptrdiff_t>(E.rows.size());
  Eigen::VectorXd out(rows);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t r = 0; r < rows; ++r) {
    double sum = 0;
    for (const auto& [place, value] : E.rows[r])
      for (int a = 0; a < Dim; ++a) sum += value[a] * v[Dim * place + a];
    out[r] = sum;
  }
  return out;
}

template <int Dim>
SparseRows symmetric_product(const NodeRows<Dim>& A, const ByPlace<Dim>& B) {
  const auto rows = static_cast<int>(A.rows.size());
  UpperRows upper(rows);
#pragma omp parallel
  {
    std::vector<double> sum(rows, 0.0);
    std::vector<std::uint8_t> met(rows, 0);
#pragma omp for schedule(dynamic, 16)
    for (int r = 0; r < rows; ++r) {
      for (const auto& [place, value] : A.rows[r]) {
        const auto of_place = B.at(place);
        for (auto entry = of_place.rbegin(); entry != of_place.rend() && entry->row >= r; ++entry) {
          double to = sum[entry->row];
          for (int a = 0; a < Dim; ++a) to += value[a] * entry->value[a];
          sum[entry->row] = to;
          met[entry->row] = 1;
        }
      }
      upper[r].reserve(std::count(met.begin() + r, met.end(), 1));
      for (int c = r; c < rows; ++c) {
        if (!met[c]) continue;
        upper[r].emplace_back(c, sum[c]);
        sum[c] = met[c] = 0;
      }
    }
  }
  return mirrored(upper);
}

#define GEODROP_INSTANTIATE(D)                                                \
  template class ByPlace<D>;                                                  \
  template NodeRows<D> times(const SparseRows&, const NodeRows<D>&);          \
  template NodeRows<D> times(const NodeRows<D>&, const Drag&);                \
  template Eigen::VectorXd times(const NodeRows<D>&, const Eigen::VectorXd&); \
  template SparseRows symmetric_product(const NodeRows<D>&, const ByPlace<D>&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
