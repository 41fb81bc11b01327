// The kernels of 2D with quadratic B-splines.
#include "dispatch.hpp"

namespace geodrop {

GEODROP_KERNELS(2, Bspline2)

}  // namespace geodrop
