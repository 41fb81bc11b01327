// The kernels of 3D with uGIMP: one translation unit per (dimension, basis), see dispatch.hpp.
#include "dispatch.hpp"

namespace geodrop {

template <>
GEODROP_KERNEL void scatter<3, Gimp>(const Body<3>& body, Grid<3>& grid, double dt, std::size_t begin,
                                     std::size_t end) {
  scatter_dispatch<3, Gimp>(body, grid, dt, begin, end);
}

template <>
GEODROP_KERNEL Maxima gather<3, Gimp>(Body<3>& body, const Grid<3>& grid, const GatherOptions& options,
                                      std::size_t begin, std::size_t end) {
  return gather_dispatch<3, Gimp>(body, grid, options, begin, end);
}

template <>
GEODROP_KERNEL void update_velocity<3, Gimp>(Body<3>& body, const Grid<3>& grid, const GatherOptions& options,
                                             std::size_t begin, std::size_t end) {
  update_velocity_range<3, Gimp>(body, grid, options, begin, end);
}

template <>
GEODROP_KERNEL void sum_momentum<3, Gimp>(const Body<3>& body, Grid<3>& grid, std::size_t begin, std::size_t end) {
  sum_momentum_range<3, Gimp>(body, grid, begin, end);
}

}  // namespace geodrop
