// The law of every contact: a penalty normal to the surface, Coulomb friction along it.
//
//   f_n = max(0, k l d - z l v_n),   f_t = -k l xi, cut to |f_t| <= mu f_n
//
// of a point with d, depth of penetration; v_n, normal velocity over the surface, positive out of it; l, length of
// surface that belongs to the point; xi, stretch of its tangential spring, which slips where f_t is cut.
#pragma once

#include <algorithm>

namespace geodrop {

/// A point's share.
struct Penalty {
  double spring;    ///< k l [N/m]
  double dashpot;   ///< z l [N s/m]
  double friction;  ///< mu [-]
};

/// `contact`: has stiffness k [Pa/m], damping z [Pa s/m] and friction; `length` l [m].
template <class Contact>
Penalty penalty_of(const Contact& contact, double length) {
  return {contact.stiffness * length, contact.damping * length, contact.friction};
}

struct PenaltyForce {
  double elastic;   ///< k l d [N]
  double normal;    ///< f_n [N]
  double friction;  ///< f_t [N]
  double stretch;   ///< what is left of xi [m]
};

inline PenaltyForce penalty_force(const Penalty& penalty, double depth, double v_n, double stretch) {
  const double elastic = penalty.spring * depth, normal = std::max(0.0, elastic - penalty.dashpot * v_n);
  const double limit = penalty.friction * normal, friction = std::clamp(-penalty.spring * stretch, -limit, limit);
  return {elastic, normal, friction, -friction / penalty.spring};
}

}  // namespace geodrop
