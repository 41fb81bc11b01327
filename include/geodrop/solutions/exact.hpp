// Motions that a body follows exactly: where a scene begins on one, drives it and is measured against it.
//
// X is where a particle was at t = 0, x where it is. All functions are of one point.
#pragma once

#include <geodrop/base/types.hpp>
#include <geodrop/materials/materials.hpp>
#include <geodrop/scene/scene.hpp>

#include <variant>

namespace geodrop {

/// Wallstedt & Guilkey (2008): u_a = A sin(k X_a) sin(omega t + phase_a) along every axis, phases 0, pi, 0. F stays
/// diagonal, so slip walls at whole and half wave lengths hold it exactly. Driven by `body_force`.
struct AxisAlignedMms {
  double amplitude;                            ///< A [m]
  double wave_number;                          ///< k = 2 pi / length [1/m]
  double frequency;                            ///< omega = pi sqrt(E / rho) / length [1/s]
  double density, lame_lambda, shear_modulus;  ///< [kg/m3], [Pa]
};

/// Decaying vortices of an incompressible fluid: u = U sin(kx) cos(ky) e, v = -U cos(kx) sin(ky) e, e = exp(-2 nu k^2
/// t), p = rho U^2 / 4 (cos 2kx + cos 2ky) e^2. Slip walls at whole and half wave lengths hold it exactly.
struct TaylorGreen {
  double speed;                  ///< U [m/s]
  double wave_number;            ///< k = 2 pi / length [1/m]
  double viscosity;              ///< nu [m2/s]
  double density, bulk_modulus;  ///< [kg/m3], [Pa]
};

/// A body of uniform stretch that drifts: nothing changes. Its shape in the scene, a box, is the stretched one; the
/// lattice of its particles is stretched too.
template <int Dim>
struct UniformMotion {
  Vec<Dim> velocity;  ///< [m/s]
  Vec<Dim> stretch;   ///< present over unstrained length [-]
  double wave_speed;  ///< at zero strain [m/s]
};

/// u = (v0 / omega) sin(k X) sin(omega t) of a bar fixed at coordinate 0 and free at its end; small strain.
struct BarFirstMode {
  double amplitude;    ///< v0 [m/s]
  int axis;            ///< 0: x
  double wave_number;  ///< k = pi / (2 length) [1/m]
  double frequency;    ///< omega = k c [1/s]
};

/// Kamojjala, Brannon, Sadeghirad & Guilkey (2015): each circle about the origin (3D: about the z axis) turns as a
/// whole, by alpha(R, t) = G sin(omega t) (1 - ((R - R0) / w)^2)^2 where |R - R0| < w, and not at all elsewhere: shear
/// up to R dalpha/dR, no change of volume. Driven by `body_force`.
struct GeneralizedVortex {
  double angle;               ///< G [rad]
  double radius, half_width;  ///< R0, w [m]
  double frequency;           ///< omega [rad/s]
  double rigidity;            ///< mu / rho [m2/s2]
};

/// An incompressible drop of radius R about the origin, drawn towards it by -B^2 x per mass, that starts with v = A0
/// (x, -y): it stays an ellipse of the semi-axes a R, R/a, v = A (x, -y) with A = a'/a, and the energy sum (A^2 + B^2)
/// (a^2 + 1/a^2) of its motion stays 2 (A0^2 + B^2). Through `body_force`; free at its surface (2D).
struct OscillatingDrop {
  double rate;                   ///< A0 [1/s]
  double frequency;              ///< B [rad/s]
  double radius;                 ///< R [m]
  double density, bulk_modulus;  ///< [kg/m3], [Pa]
};

/// Two vortices of opposite sense in unbounded fluid without viscosity, which carry each other along x (Lamb 1895;
/// Chaplygin 1903; Meleshko & van Heijst 1994): psi = f(r) y about their centre, which moves with U,
/// f = U (1 - 2 J1(kr) / (kr J0(ka))) where r < a, J1(ka) = 0, and U a^2/r^2 beyond, without vorticity (2D).
struct LambDipole {
  double speed, radius;          ///< U [m/s], a [m]
  Point centre;                  ///< at t = 0 [m]
  double density, bulk_modulus;  ///< [kg/m3], [Pa]
};

template <int Dim>
using ExactSolution = std::variant<AxisAlignedMms, TaylorGreen, UniformMotion<Dim>, BarFirstMode, GeneralizedVortex,
                                   OscillatingDrop, LambDipole>;

/// The material must be one that the solution is of (the scene is checked for that).
template <int Dim>
ExactSolution<Dim> make_exact(const ExactSpec& spec, const Material& material);

/// The solution that a body follows; throws std::logic_error if the scene has none (the scene is checked for that).
template <int Dim>
ExactSolution<Dim> exact_solution(const Scene& scene, const std::string& body);

/// What a solution says of one particle.
template <int Dim>
struct ExactPoint {
  Vec<Dim> displacement =
      Vec<Dim>::Zero();  ///< since t = 0 [m]; zero for TaylorGreen and LambDipole, which know only the present
  Vec<Dim> velocity = Vec<Dim>::Zero();                                                         ///< [m/s]
  Eigen::Matrix<double, Dim, Dim> velocity_gradient = Eigen::Matrix<double, Dim, Dim>::Zero();  ///< dv_a/dx_b [1/s]
  double volume_ratio = 1;                                                                      ///< J [-]
};
template <int Dim>
ExactPoint<Dim> exact_point(const ExactSolution<Dim>& solution, const Vec<Dim>& X, const Vec<Dim>& x, double t);

/// Pressure of the vortices [Pa].
template <int Dim>
double pressure(const TaylorGreen& flow, const Vec<Dim>& x, double t);

/// Stretch a [-] of the drop at time t and its rate A [1/s], by Runge-Kutta steps of the fourth order.
struct DropShape {
  double stretch, rate;
};
DropShape shape_at(const OscillatingDrop& drop, double t);

/// Pressure of the drop [Pa], 0 beyond its surface.
template <int Dim>
double pressure(const OscillatingDrop& drop, const Vec<Dim>& x, double t);

/// Where the centre of the pair is [m].
template <int Dim>
Vec<Dim> centre_at(const LambDipole& pair, double t);

/// Pressure of the pair [Pa], 0 far away.
template <int Dim>
double pressure(const LambDipole& pair, const Vec<Dim>& x, double t);

/// Force per mass [m/s2] that makes a neo-Hookean body follow the solution.
template <int Dim>
Vec<Dim> body_force(const AxisAlignedMms& mms, const Vec<Dim>& X, double t);
template <int Dim>
Vec<Dim> body_force(const GeneralizedVortex& vortex, const Vec<Dim>& X, double t);
/// That of the drop pulls at where a particle is, x.
template <int Dim>
Vec<Dim> body_force(const OscillatingDrop& drop, const Vec<Dim>& x, double t);

/// What errors are divided by: the largest velocity (TaylorGreen: the rms one at time t; LambDipole:
/// that of the pair; UniformMotion: the wave speed)
/// [m/s], and the largest strain [-] (1 if there is none).
template <int Dim>
double velocity_scale(const ExactSolution<Dim>& solution, double t);
template <int Dim>
double strain_scale(const ExactSolution<Dim>& solution);

}  // namespace geodrop
