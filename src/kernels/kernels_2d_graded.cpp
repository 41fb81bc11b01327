// The kernels of 2D with quadratic B-splines on graded axes: one translation unit per (dimension, basis), see
// dispatch.hpp.
#include "dispatch.hpp"

namespace geodrop {

template <>
GEODROP_KERNEL void scatter<2, GradedBspline2>(const Body<2>& body, Grid<2>& grid, double dt, std::size_t begin,
                                               std::size_t end) {
  scatter_dispatch<2, GradedBspline2>(body, grid, dt, begin, end);
}

template <>
GEODROP_KERNEL Maxima gather<2, GradedBspline2>(Body<2>& body, const Grid<2>& grid, const GatherOptions& options,
                                                std::size_t begin, std::size_t end) {
  return gather_dispatch<2, GradedBspline2>(body, grid, options, begin, end);
}

template <>
GEODROP_KERNEL void update_velocity<2, GradedBspline2>(Body<2>& body, const Grid<2>& grid, const GatherOptions& options,
                                                       std::size_t begin, std::size_t end) {
  update_velocity_range<2, GradedBspline2>(body, grid, options, begin, end);
}

template <>
GEODROP_KERNEL void sum_by_mass<2, GradedBspline2>(const Body<2>& body, const ByMass<2>& what,
                                                   const GridLayout<2>& layout, Vec4* sum, std::size_t begin,
                                                   std::size_t end) {
  sum_by_mass_range<2, GradedBspline2>(body, what, layout, sum, begin, end);
}

}  // namespace geodrop
