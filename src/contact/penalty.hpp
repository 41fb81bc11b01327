// The law of every contact: a penalty normal to the surface, Coulomb friction along it.
//
//   f_n = max(0, k l d - z l v_n),   f_t = -k l xi, cut to |f_t| <= mu min(f_n, p' l)
//
// of a point with d, depth of penetration; v_n, normal velocity over the surface, positive out of it; l, length of
// surface that belongs to the point; xi, stretch of its tangential spring, which slips where f_t is cut; p', of a
// membrane that lets water through the effective pressure of the soil inside on it: the rest of f_n is that of water,
// which does not rub (Terzaghi). Of all others p' has no end.
#pragma once

#include <geodrop/base/types.hpp>
#include <geodrop/materials/materials.hpp>
#include <geodrop/scene/scene.hpp>

#include <algorithm>
#include <limits>

namespace geodrop {

/// A point's share.
struct Penalty {
  double spring;    ///< k l [N/m]
  double dashpot;   ///< z l [N s/m]
  double friction;  ///< mu [-]
  double bearing;   ///< p' l, largest part of the normal force that rubs [N]
};

/// `contact`: has stiffness k [Pa/m], damping z [Pa s/m] and friction; `length` l [m]; `pressure` p', see above [Pa].
template <class Contact>
Penalty penalty_of(const Contact& contact, double length, double pressure = std::numeric_limits<double>::infinity()) {
  return {contact.stiffness * length, contact.damping * length, contact.friction, pressure * length};
}

/// Stiffness and damping of a contact with a body of a material, in cells of width h [m].
template <class Contact>
void set_penalty(const ContactSpec& spec, const Material& material, double h, Contact& contact) {
  contact.stiffness = spec.stiffness * impedance(material) * wave_speed(material) / h;
  contact.damping = spec.damping * impedance(material);
}

/// Of the step before: the points in contact and the sums over them.
template <class Contact>
void forget_points(Contact& contact) {
  contact.points.clear();
  contact.slip.clear();
  contact.side.clear();
  contact.piece.clear();
  contact.normal_force = contact.friction_force = {};
  contact.normal_sum = contact.friction_sum = 0;
}

struct PenaltyForce {
  double elastic;   ///< k l d [N]
  double normal;    ///< f_n [N]
  double friction;  ///< f_t [N]
  double stretch;   ///< what is left of xi [m]
};

inline PenaltyForce penalty_force(const Penalty& penalty, double depth, double v_n, double stretch) {
  const double elastic = penalty.spring * depth, normal = std::max(0.0, elastic - penalty.dashpot * v_n);
  const double limit = penalty.friction * std::min(normal, penalty.bearing);
  const double friction = std::clamp(-penalty.spring * stretch, -limit, limit);
  return {elastic, normal, friction, -friction / penalty.spring};
}

/// The same in space, where the stretch of the spring is a vector along the surface with the unit normal `out`.
struct SpacePenaltyForce {
  double elastic;        ///< k A d [N]
  double normal;         ///< f_n [N]
  Vec<3> friction;       ///< f_t [N]
  Vec<3> stretch;        ///< what is left of xi [m]
  double friction_work;  ///< turned into heat [J]
};

/// `stretch`: xi before the step of dt [s]; `velocity`: over the surface [m/s].
inline SpacePenaltyForce penalty_force(const Penalty& penalty, double depth, const Vec<3>& out, const Vec<3>& velocity,
                                       const Vec<3>& stretch, double dt) {
  const double v_n = out.dot(velocity);
  const Vec<3> moved = stretch + dt * (velocity - v_n * out), along = moved - out.dot(moved) * out;
  const double elastic = penalty.spring * depth, normal = std::max(0.0, elastic - penalty.dashpot * v_n);
  const double held = penalty.spring * along.norm(), limit = penalty.friction * normal;
  const Vec<3> kept = held > limit ? Vec<3>(limit / held * along) : along;
  const Vec<3> friction = -penalty.spring * kept;
  return {elastic, normal, friction, kept, friction.norm() * (along - kept).norm()};
}

}  // namespace geodrop
