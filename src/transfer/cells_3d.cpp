// Sums over the particles of pressure cells in 3D.
#include "cell_sums.hpp"
#include "kernels.hpp"

namespace geodrop {

template <>
void sum_cells<3>(const Body<3>& body, Grid<3>& grid, std::size_t begin, std::size_t end) {
  with_level([&](auto) { sum_cells_range<3>(body, grid, begin, end); });
}

}  // namespace geodrop
