// Where a particle goes that has passed a membrane.
#pragma once

#include <geodrop/base/types.hpp>

#include <array>
#include <cstdint>

namespace geodrop {

/// A point on its own side of a membrane, and the membrane's point that is nearest to where it was.
template <int Dim>
struct RightSide {
  Vec<Dim> to;
  std::array<std::uint32_t, Dim> nodes;  ///< of the segment or triangle there
  std::array<double, Dim> share;         ///< of each of them; their sum is 1
};

}  // namespace geodrop
