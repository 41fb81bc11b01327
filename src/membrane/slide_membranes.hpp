// Geotextiles that slide over what is inside: rest length, and mass with it, flows along their lines.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include "contents_pressure.hpp"
#include "held_nodes.hpp"
#include "slide.hpp"

namespace geodrop {

/// Cloth without inertia in balance at each step (slide.hpp): tension, the friction mu p' of the soil inside and the
/// loads: friction of rough contacts, the shear of water and bed around, its own weight (or the weight would drive the
/// fluid inside round and round). The rows of cut/interface_constraint give that shear to the body; the tensions that
/// balance it take it back, so that the body gets what friction between the two carries, mu p' at most. Over a fluid
/// (mu = 0) the exact tension without friction. Nothing passes anchors. Keeps its arrays from one step to the next; all
/// that lasts is in the membranes.
class MembraneSlide {
 public:
  explicit MembraneSlide(const std::array<double, 2>& gravity) : gravity_(gravity) {}

  /// Renews rest length, mass, velocity of nodes and contents_pressure of all membranes that slide.
  void slide(State<2>& state, const Grids<2>& grids);

 private:
  void slide(const State<2>& state, const Grid<2>& grid, Membrane<2>& membrane);
  void gather(const State<2>& state, const Membrane<2>& membrane);
  void slide(Cloth& cloth, double contents_friction);
  void slide_between(const std::vector<LinePart>& parts, double contents_friction);
  void move_mass(Membrane<2>& membrane);

  std::array<double, 2> gravity_;  ///< [m/s2]
  Cloth cloth_, part_;
  ClothSlide solver_;
  ContentsPressure pressure_;
  std::array<std::vector<double>, 2> momentum_;
};

}  // namespace geodrop
