// Loops over the active blocks of the grid.
#pragma once

#include <algorithm>
#include <geodrop/grid/grid.hpp>

namespace geodrop {

/// Fewer active blocks than this are not worth waking threads for (a wake costs some microseconds, a block about one).
inline constexpr std::ptrdiff_t blocks_worth_threads = 16;

/// Calls f(begin, count, coordinates of the first node) for each row (along x) of a block; flat indices, ghosts
/// included.
template <int Dim, class F>
void for_each_row_of_block(const GridLayout<Dim>& layout, std::uint32_t block, F&& f) {
  std::array<int, Dim> first, last;
  for (int a = 0, rest = static_cast<int>(block); a < Dim; ++a) {
    first[a] = rest % layout.blocks[a] * GridLayout<Dim>::block_width[a];
    last[a] = std::min(first[a] + GridLayout<Dim>::block_width[a], layout.stored[a]);
    rest /= layout.blocks[a];
  }
  std::array<int, Dim> node = first;
  const int z_first = Dim == 3 ? first[Dim - 1] : 0, z_last = Dim == 3 ? last[Dim - 1] : 1;
  for (int z = z_first; z < z_last; ++z) {
    for (int y = first[1]; y < last[1]; ++y) {
      int flat = first[0] + y * layout.stride[1];
      node[1] = y;
      if constexpr (Dim == 3) {
        flat += z * layout.stride[2];
        node[2] = z;
      }
      f(flat, last[0] - first[0], node);
    }
  }
}

/// As for_each_row_of_block, without ghost nodes: only nodes, and with them cells, of the domain.
template <int Dim, class F>
void for_each_real_row_of_block(const GridLayout<Dim>& layout, std::uint32_t block, F&& f) {
  constexpr int pad = GridLayout<Dim>::pad;
  for_each_row_of_block(layout, block, [&](int begin, int count, std::array<int, Dim> node) {
    for (int a = 1; a < Dim; ++a)
      if (node[a] < pad || node[a] > layout.cells[a] + pad) return;
    const int skip = std::max(0, pad - node[0]);
    const int last = std::min(node[0] + count, layout.cells[0] + pad + 1);
    node[0] += skip;
    if (node[0] < last) f(begin + skip, last - node[0], node);
  });
}

template <int Dim, class F>
void for_each_active_real_row(const Grid<Dim>& grid, F&& f) {
  const auto n = static_cast<std::ptrdiff_t>(grid.active_blocks.size());
#pragma omp parallel for schedule(static) if (n >= blocks_worth_threads)
  for (std::ptrdiff_t b = 0; b < n; ++b) for_each_real_row_of_block(grid.layout, grid.active_blocks[b], f);
}

/// Zeroes the fields of a row that have one of the roles.
template <unsigned roles, class Fields>
void zero_row(Fields& fields, int begin, int count) {
  for_each_array<roles>(fields, [&]<class T>(Array<T>& values) {
    if (!values.empty()) std::fill_n(values.begin() + begin, count, T{});
  });
}

/// Runs f on each row of each active block; blocks are shared out among the threads.
template <int Dim, class F>
void for_each_active_row(const Grid<Dim>& grid, F&& f) {
  const auto n = static_cast<std::ptrdiff_t>(grid.active_blocks.size());
#pragma omp parallel for schedule(static) if (n >= blocks_worth_threads)
  for (std::ptrdiff_t b = 0; b < n; ++b) for_each_row_of_block(grid.layout, grid.active_blocks[b], f);
}

}  // namespace geodrop
