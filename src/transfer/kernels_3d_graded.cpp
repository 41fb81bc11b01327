// The kernels of 3D with quadratic B-splines on graded axes.
#include "dispatch.hpp"

namespace geodrop {

GEODROP_KERNELS(3, GradedBspline2)

}  // namespace geodrop
