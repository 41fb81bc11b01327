// The kernels of 3D with four-node tetrahedra.
#include "transfer/dispatch.hpp"

namespace geodrop {

GEODROP_KERNELS(3, Simplex)
GEODROP_NODAL_KERNELS(3)

}  // namespace geodrop
