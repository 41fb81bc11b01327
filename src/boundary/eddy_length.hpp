// Lengths of unresolved eddies beside walls.
//
//   l = min(l_0, kappa (d + y_0)),   kappa = 0.4,   y_0 = k_s / 30
//
// (Prandtl 1925; von Karman 1930; Nikuradse 1933: the logarithmic law of a rough wall), l_0 the mixing length of the
// fluid, d the distance to the nearest wall that the flow rubs on: a side of the domain where it sticks, or a sharp
// membrane, k_s the roughness of that. The surface of a soil is no such wall: nothing tracks it.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace geodrop {

/// A segment or triangle of a sharp membrane.
template <int Dim>
struct WallPart;
template <>
struct WallPart<2> {
  double x, y, dx, dy, rough;  ///< rough: y_0
};
template <>
struct WallPart<3> {
  std::array<Vec<3>, 3> corner;
  double rough;
};

/// Segments or triangles of sharp membranes that are near, by squares or cubes of a box around them. Keeps its arrays
/// from step to step.
template <int Dim>
class NearOutlines {
 public:
  /// Lists those within `reach` [m] of each square.
  void update(const State<Dim>& state, double reach);

  /// The least kappa (d + y_0) [m] over those within reach; `most` if that is less.
  double least_length(const std::array<double, Dim>& x, double most) const;

 private:
  std::size_t square_of(const std::array<int, Dim>& at) const {
    std::size_t place = 0;
    for (int a = Dim - 1; a >= 0; --a)
      place = place * static_cast<std::size_t>(count_[a]) + static_cast<std::size_t>(at[a]);
    return place;
  }
  void add(const WallPart<Dim>& part, double reach);

  double size_ = 1;  ///< of a square, at least the reach [m]
  std::array<double, Dim> lower_{};
  std::array<int, Dim> count_{};
  std::vector<WallPart<Dim>> parts_;
  std::vector<std::vector<std::uint32_t>> squares_;  ///< parts within reach
};

/// Sets the eddy length of each particle of fluids with a mixing length.
template <int Dim>
void limit_eddies(const GridLayout<Dim>& layout, NearOutlines<Dim>& outlines, State<Dim>& state);

}  // namespace geodrop
