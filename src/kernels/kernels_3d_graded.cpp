// The kernels of 3D with quadratic B-splines on graded axes: one translation unit per (dimension, basis), see
// dispatch.hpp.
#include "dispatch.hpp"

namespace geodrop {

template <>
GEODROP_KERNEL void scatter<3, GradedBspline2>(const Body<3>& body, Grid<3>& grid, double dt, std::size_t begin,
                                               std::size_t end) {
  scatter_dispatch<3, GradedBspline2>(body, grid, dt, begin, end);
}

template <>
GEODROP_KERNEL Maxima gather<3, GradedBspline2>(Body<3>& body, const Grid<3>& grid, const GatherOptions& options,
                                                std::size_t begin, std::size_t end) {
  return gather_dispatch<3, GradedBspline2>(body, grid, options, begin, end);
}

template <>
GEODROP_KERNEL void update_velocity<3, GradedBspline2>(Body<3>& body, const Grid<3>& grid, const GatherOptions& options,
                                                       std::size_t begin, std::size_t end) {
  update_velocity_range<3, GradedBspline2>(body, grid, options, begin, end);
}

template <>
GEODROP_KERNEL void sum_by_mass<3, GradedBspline2>(const Body<3>& body, const ByMass<3>& what,
                                                   const GridLayout<3>& layout, Vec4* sum, std::size_t begin,
                                                   std::size_t end) {
  sum_by_mass_range<3, GradedBspline2>(body, what, layout, sum, begin, end);
}

}  // namespace geodrop
