// The kernels of 3D with uGIMP.
#include "dispatch.hpp"

namespace geodrop {

GEODROP_KERNELS(3, Gimp)

}  // namespace geodrop
