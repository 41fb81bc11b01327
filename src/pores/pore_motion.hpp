// What the implicit pressure of pore water moves: grains and water of a node together, with the drag between them.
//
// An impulse f of the pressure at a node acts as n f on the water and as (1 - n) f on the grains. With the drag of the
// same step, (m_w + dt c) dv_w - dt c dv_s = n f, (m_s + dt c) dv_s - dt c dv_w = (1 - n) f; cells see n dv_w + (1 - n)
// dv_s. In a bag, and around one, nodes of small mass hand on impulses, and have velocities as impulses see them, each
// field by itself.
// Symmetric and positive.
#pragma once

#include <cstdint>
#include <vector>

#include "grid/implicit_pressure.hpp"

namespace geodrop {

template <int Dim>
class PoreMotion final : public Medium<Dim> {
 public:
  /// The fields of a soil and of the water in its pores, after pore_drag; their grids must outlive it.
  PoreMotion(Grid<Dim>& grains, Grid<Dim>& water, double dt);

  void begin(const std::vector<bool>& pressed) override;
  double lightness(int node) const override;
  void respond(NodeVectors<Dim>& impulse) override;
  void velocities(NodeVectors<Dim>& out) const override;
  void move() override;

 private:
  struct Node {
    int flat;
    double share;                ///< n
    double of_water, of_grains;  ///< 1 / m [1/kg]; 0: no mass
    double drag;                 ///< dt c / (1 + dt c (1 / m_w + 1 / m_s)) [kg]
    Vec4 free;                   ///< 0 for the components that walls hold, otherwise 1
    bool pressed = false;
  };
  /// Where an impulse on a node goes; nodes by their number.
  struct Share {
    int from, to;
    double share;
  };
  /// One of the two fields; nodes by their number.
  struct Field {
    Grid<Dim>* grid;
    std::vector<std::uint8_t> light;  ///< whether the impulse on a node is handed on
    std::vector<Share> shares;        ///< of those, in the order of the nodes
    std::vector<Vec4> change;         ///< impulses, then velocities
    std::vector<Vec4> given;          ///< by shares: what is handed on
  };

  void find_nodes();
  void find_shares(Field& field);
  static void hand_on(Field& field);
  void see(auto&& of_water, auto&& of_grains, NodeVectors<Dim>& out) const;

  double dt_;
  bool bagged_;
  Field grains_, water_;
  std::vector<Node> nodes_;
  std::vector<int> number_;  ///< of the nodes of the grid; -1: neither field has mass there
};

}  // namespace geodrop
