// Sums over the particles of pressure cells in 2D.
#include "cell_sums.hpp"
#include "kernels.hpp"

namespace geodrop {

template <>
void sum_cells<2>(const Body<2>& body, Grid<2>& grid, std::size_t begin, std::size_t end) {
  with_level([&](auto) { sum_cells_range<2>(body, grid, begin, end); });
}

}  // namespace geodrop
