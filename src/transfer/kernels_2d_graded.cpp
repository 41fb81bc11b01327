// The kernels of 2D with quadratic B-splines on graded axes.
#include "dispatch.hpp"

namespace geodrop {

GEODROP_KERNELS(2, GradedBspline2)

}  // namespace geodrop
