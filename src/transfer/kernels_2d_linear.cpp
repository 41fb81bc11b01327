// The kernels of 2D with hat functions.
#include "dispatch.hpp"

namespace geodrop {

GEODROP_KERNELS(2, Linear)

}  // namespace geodrop
