// The kernels of 2D with three-node triangles.
#include "transfer/dispatch.hpp"

namespace geodrop {

GEODROP_KERNELS(2, Simplex)
GEODROP_NODAL_KERNELS(2)

}  // namespace geodrop
