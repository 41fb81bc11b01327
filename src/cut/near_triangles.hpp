// The side of a membrane of triangles that a point near it is on.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "right_side.hpp"

namespace geodrop {

/// The triangles of a membrane in each cell of the box around it.
class NearTriangles {
 public:
  NearTriangles(const GridLayout<3>& layout, const Membrane<3>& membrane, const ClippedSurface& cells);

  /// Where a point is to go that should be inside, or else outside; nothing if it is there.
  std::optional<RightSide<3>> on_side(const Vec<3>& x, bool inside) const;

 private:
  /// What tells most triangles that are farther off than another one from the rest.
  struct Plate {
    Vec<3> normal, middle;  ///< unit, outwards
    double radius;          ///< about the middle
    std::uint32_t triangle;
  };
  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    double height = 0;  ///< over the plane of the triangle, signed
    Vec<3> point = Vec<3>::Zero(), normal = Vec<3>::Zero();
    std::uint32_t triangle = 0;
  };

  void look_at(const Plate& plate, const Vec<3>& x, Nearest& nearest) const;

  const GridLayout<3>& layout_;
  const Membrane<3>& membrane_;
  const ClippedSurface& cells_;
  std::vector<Plate> plates_;                                                  ///< one for each piece
  std::vector<std::array<std::pair<std::uint32_t, std::uint32_t>, 2>> parts_;  ///< of a cell, [first, last) plate
};

}  // namespace geodrop
