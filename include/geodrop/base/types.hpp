// Conventions of the whole code, stated once.
//
// Units are SI everywhere, the scene file included. Stress is tension-positive, pressure is
// compression-positive. A stress in 2D plane strain has the components XX YY ZZ XY, in 3D
// XX YY ZZ XY YZ XZ (shear as tensor components, not doubled).
#pragma once

#include <Eigen/Core>

#include <geodrop/base/arrays.hpp>

namespace geodrop {

template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;

/// The axis that is called vertical in names like `highest_m`: y in 2D, z in 3D.
template <int Dim>
inline constexpr int vertical_axis = Dim - 1;

/// Four doubles that the compiler keeps in one register: the node record of the grid.
/// A struct or an Eigen array of four made 3D scatter four times slower when it was measured.
using Vec4 [[gnu::vector_size(32)]] = double;

/// Entry i of a field that has an array for each component.
template <std::size_t Dim>
Vec<static_cast<int>(Dim)> vector_at(const std::array<Array<double>, Dim>& field, std::size_t i) {
  Vec<static_cast<int>(Dim)> v;
  for (std::size_t a = 0; a < Dim; ++a) v[static_cast<int>(a)] = field[a][i];
  return v;
}

}  // namespace geodrop
