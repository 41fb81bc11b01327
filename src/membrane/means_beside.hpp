// Means of what the particles of bodies carry, at places on a membrane (2D).
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace geodrop {

/// Means of three values of particles over linear functions of the grid's nodes, two cells wide: particles beside a
/// membrane carry noise of the size of their pressure. Keeps its arrays from one step to the next.
class MeansBeside {
 public:
  struct Sums {
    double volume = 0;              ///< [m2]
    std::array<double, 3> value{};  ///< times volume
  };

  /// Forgets all sums; those of the nodes around this membrane are wanted.
  void begin(const GridLayout<2>& layout, const Membrane<2>& membrane);

  /// Adds a body with `values`, three of a particle by its index. One particle after the other: their order is the same
  /// for any number of threads.
  template <class Values>
  void add(const GridLayout<2>& layout, const Body<2>& body, const Values& values) {
    for (std::size_t p = 0; p < body.size(); ++p) {
      const Place at = place(layout, body.x[0][p], body.x[1][p]);
      if (at.inside) add(at, body.volume(p), values(p));
    }
  }

  /// Sums around a node of the membrane.
  Sums at(const GridLayout<2>& layout, const Membrane<2>& membrane, std::size_t k) const;

  /// Room around a node of the membrane, in whose field the grid is, less what bodies of other fields have of it [m2].
  double room(const Grid<2>& grid, const Membrane<2>& membrane, std::size_t k) const;

 private:
  struct Place {
    std::array<int, 2> node;      ///< lower left node of the four around, in the box
    std::array<double, 2> share;  ///< of the way to the next one
    bool inside;                  ///< the box
  };
  Place place(const GridLayout<2>& layout, double x, double y) const;
  std::size_t corner(const Place& at, int which) const;
  void add(const Place& at, double volume, const std::array<double, 3>& value);

  std::array<int, 2> first_{}, count_{};
  std::vector<Sums> sums_;            ///< of the nodes of the box around the membrane
  std::vector<std::uint8_t> wanted_;  ///< nodes that the membrane reads
};

}  // namespace geodrop
