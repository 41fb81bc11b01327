// Means of what the particles of bodies carry, at places on a membrane.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace geodrop {

/// Means of some values of particles over linear functions of the grid's nodes, two cells wide: particles beside a
/// membrane carry noise of the size of their pressure. Keeps its arrays from one step to the next.
template <int Dim, std::size_t Count>
class MeansBeside {
 public:
  using Values = std::array<double, Count>;
  struct Sums {
    double volume = 0;  ///< [m2, m3]
    Values value{};     ///< times volume
  };

  /// Forgets all sums; those of the nodes around this membrane are wanted.
  void begin(const GridLayout<Dim>& layout, const Membrane<Dim>& membrane);

  /// Adds a body with the `values` of a particle by its index. One particle after the other: their order is the same
  /// for any number of threads.
  template <class ValuesOf>
  void add(const GridLayout<Dim>& layout, const Body<Dim>& body, const ValuesOf& values) {
    for (std::size_t p = 0; p < body.size(); ++p) {
      const Place at = place(layout, vector_at(body.x, p));
      if (at.inside) add(at, body.volume(p), values(p));
    }
  }

  /// Sums around a node of the membrane.
  Sums at(const GridLayout<Dim>& layout, const Membrane<Dim>& membrane, std::size_t k) const;

  /// Room around a node of the membrane, in whose field the grid is, less what bodies of other fields have of it [m2,
  /// m3].
  double room(const Grid<Dim>& grid, const Membrane<Dim>& membrane, std::size_t k) const;

 private:
  static constexpr int corners = 1 << Dim;
  struct Place {
    std::array<int, Dim> node;      ///< least of the nodes around, in the box
    std::array<double, Dim> share;  ///< of the way to the next one
    bool inside;                    ///< the box
  };
  Place place(const GridLayout<Dim>& layout, const Vec<Dim>& x) const;
  std::size_t corner(const Place& at, int which) const;
  void add(const Place& at, double volume, const Values& value);

  std::array<int, Dim> first_{}, count_{};
  std::vector<Sums> sums_;            ///< of the nodes of the box around the membrane
  std::vector<std::uint8_t> wanted_;  ///< nodes that the membrane reads
};

}  // namespace geodrop
