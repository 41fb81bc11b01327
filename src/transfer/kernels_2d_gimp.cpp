// The kernels of 2D with uGIMP.
#include "dispatch.hpp"

namespace geodrop {

GEODROP_KERNELS(2, Gimp)

}  // namespace geodrop
