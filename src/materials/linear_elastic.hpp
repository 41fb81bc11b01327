// Isotropic hypoelasticity of the Cauchy stress: rotate, then add C : de. With small steps the strain is the
// logarithmic one: a column stretched by F without lateral strain carries sigma = (K + 4G/3) ln F.
#pragma once

#include "strain.hpp"

#include <geodrop/materials/materials.hpp>

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

template <int Dim, class R>
void update_point(auto& points, const LinearElastic& solid, const auto& rates, double, std::size_t p, int k) {
  auto dL = load_increment<Dim, R>(rates, k);
  const R volume = load<R>(&rates.volume[k]) + add_stretch_of_spin<Dim, R>(dL);
  auto sigma = load_stress<Dim, R>(points, p);
  update_stress<Dim, R>(solid, dL, volume, sigma);
  for (int c = 0; c < stress_components<Dim>; ++c) store(&points.stress[c][p], sigma[c]);
  store(&points.J[p], load<R>(&points.J[p]) * (1 + volume));
}

inline LinearElastic make(const LinearElasticSpec& spec) {
  return {spec.density, bulk_modulus(spec.youngs_modulus, spec.poissons_ratio),
          shear_modulus(spec.youngs_modulus, spec.poissons_ratio)};
}

}  // namespace geodrop
