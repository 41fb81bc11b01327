// The effective pressure of the soil inside a membrane on its nodes: what friction between the two follows from.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace geodrop {

/// Means of the stress of a body over linear functions of the grid's nodes, two cells wide: particles beside a membrane
/// carry noise of the size of their pressure. Keeps its arrays from one step to the next.
class ContentsPressure {
 public:
  /// Renews Membrane::contents_pressure: p' = max(0, -n . sigma' n), n across the line at each node [Pa].
  void update(const State<2>& state, const GridLayout<2>& layout, Membrane<2>& membrane);

 private:
  struct Sums {
    double volume = 0, xx = 0, yy = 0, xy = 0;
  };
  struct Place {
    std::array<int, 2> node;      ///< lower left node of the four around, in the box
    std::array<double, 2> share;  ///< of the way to the next one
    bool inside;                  ///< the box
  };
  Place place(const GridLayout<2>& layout, double x, double y) const;
  std::array<double, 4> weights(const Place& at) const;
  std::size_t corner(const Place& at, int which) const;
  void mark_box(const GridLayout<2>& layout, const Membrane<2>& membrane);
  void sum_up(const GridLayout<2>& layout, const Body<2>& body);

  std::array<int, 2> first_{}, count_{};
  std::vector<Sums> sums_;            ///< of the nodes of the box around the membrane
  std::vector<std::uint8_t> wanted_;  ///< nodes that the membrane reads
};

}  // namespace geodrop
