// The kernels of 3D with hat functions.
#include "dispatch.hpp"

namespace geodrop {

GEODROP_KERNELS(3, Linear)

}  // namespace geodrop
