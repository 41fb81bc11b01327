// The material laws on chunks of particles in 3D.
#include "constitutive.hpp"

namespace geodrop {

template <>
void chunk_volumes<3>(const Body<3>& body, std::size_t begin, int count, double* volume, double* pressure) {
  with_level([&](auto) {
    with_law(body.material, [&](const auto& law) { volumes_and_pressures(body, law, begin, count, volume, pressure); });
  });
}

template <>
void carry_stress<3>(const Body<3>& body, std::size_t begin, int count, const double* own, ChunkStress<3>& out) {
  with_level([&](auto) {
    with_law(body.material, [&](const auto& law) { carried_stress(body, law, begin, count, own, out); });
  });
}

template <>
void strain_chunk<3>(Body<3>& body, const ChunkRates<3>& rates, double dt, std::size_t begin, int count) {
  with_level([&](auto) {
    with_law(body.material, [&](const auto& law) { update_chunk(body, law, rates, dt, begin, count); });
  });
}

}  // namespace geodrop
