// Lengths of unresolved eddies beside walls.
//
//   l = min(l_0, kappa (d + y_0)),   kappa = 0.4,   y_0 = k_s / 30
//
// (Prandtl 1925; von Karman 1930; Nikuradse 1933: the logarithmic law of a rough wall), l_0 the mixing length of the
// fluid, d the distance to the nearest wall that the flow rubs on: a side of the domain where it sticks, or (2D) a
// sharp membrane, k_s the roughness of that. The surface of a soil is no such wall: nothing tracks it.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <array>
#include <vector>

namespace geodrop {

/// Segments of sharp membranes that are near, by squares of a box around them. Keeps its arrays from step to step.
class NearOutlines {
 public:
  /// Lists the segments within `reach` [m] of each square.
  void update(const State<2>& state, double reach);

  /// The least kappa (d + y_0) [m] over the segments within reach; `most` if that is less.
  double least_length(double x, double y, double most) const;

 private:
  struct Segment {
    double x, y, dx, dy, rough;  ///< rough: y_0
  };
  std::size_t square_of(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(count_[0]) + static_cast<std::size_t>(i);
  }
  void add(const Segment& segment);

  double size_ = 1;  ///< of a square, at least the reach [m]
  std::array<double, 2> lower_{};
  std::array<int, 2> count_{};
  std::vector<std::vector<Segment>> squares_;
};

/// Sets the eddy length of each particle of fluids with a mixing length.
template <int Dim>
void limit_eddies(const GridLayout<Dim>& layout, NearOutlines& outlines, State<Dim>& state);

}  // namespace geodrop
