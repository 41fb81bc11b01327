// Isotropic hypoelasticity of the Cauchy stress: rotate, then add C : de. With small steps the strain is the
// logarithmic one: a column stretched by F without lateral strain carries sigma = (K + 4G/3) ln F.
#pragma once

#include "strain.hpp"

#include <geodrop/materials.hpp>

namespace geodrop {

/// Advances the Cauchy stress [Pa] by one step. The deviator of sym(dL) is kept; its trace is replaced by the
/// volumetric strain increment `dvol`, which may come from the cell and then differs from tr(dL).
template <int Dim, class R>
[[gnu::always_inline]] inline void update_stress(const LinearElastic& law,
                                                 const std::array<R, std::size_t{Dim * Dim}>& dL, const R& dvol,
                                                 std::array<R, std::size_t{stress_components<Dim>}>& stress) {
  rotate(dL, stress);
  add_elastic<Dim, R>(law, deviator<Dim, R>(dL), dvol, stress);
}

}  // namespace geodrop
