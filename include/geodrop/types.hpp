// Conventions of the whole code, stated once.
//
// Units are SI everywhere, the scene file included. Stress is tension-positive, pressure is
// compression-positive. A stress in 2D plane strain has the components XX YY ZZ XY, in 3D
// XX YY ZZ XY YZ XZ (shear as tensor components, not doubled).
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace geodrop {

template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;

/// The axis that is called vertical in names like `highest_m`: y in 2D, z in 3D.
template <int Dim>
inline constexpr int vertical_axis = Dim - 1;

/// Number of stored components of a symmetric tensor; plane strain keeps ZZ.
template <int Dim>
inline constexpr int stress_components = Dim == 2 ? 4 : 6;

/// Four doubles that the compiler keeps in one register: the node record of the grid.
/// A struct or an Eigen array of four made 3D scatter four times slower when it was measured.
using Vec4 [[gnu::vector_size(32)]] = double;

/// Arrays that kernels stream through start on a cache line.
template <class T>
struct CacheAlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};
  CacheAlignedAllocator() = default;
  template <class U>
  CacheAlignedAllocator(const CacheAlignedAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }
  template <class U>
  bool operator==(const CacheAlignedAllocator<U>&) const {
    return true;
  }
};

template <class T>
using Array = std::vector<T, CacheAlignedAllocator<T>>;

/// Entry i of a field that has an array for each component.
template <std::size_t Dim>
Vec<static_cast<int>(Dim)> vector_at(const std::array<Array<double>, Dim>& field, std::size_t i) {
  Vec<static_cast<int>(Dim)> v;
  for (std::size_t a = 0; a < Dim; ++a) v[static_cast<int>(a)] = field[a][i];
  return v;
}

}  // namespace geodrop
