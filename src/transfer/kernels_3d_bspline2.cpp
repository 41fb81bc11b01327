// The kernels of 3D with quadratic B-splines.
#include "dispatch.hpp"

namespace geodrop {

GEODROP_KERNELS(3, Bspline2)

}  // namespace geodrop
