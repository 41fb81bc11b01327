// A geocontainer that sinks in water, in closed form: how it starts, how fast it gets, when it lands, what the landing
// can do to its geotextile. Plane strain: per metre of container, an ellipse that moves along one of its semi-axes,
// does not turn and keeps its shape, in water at rest that is unbounded. docs/fall.md: assumptions, sources, an
// example. A number that cannot be is refused by SceneError with the key that each function names.
#pragma once

namespace geodrop {

struct SinkingEllipse {
  double along;          ///< semi-axis along the fall [m]; key semi-axes
  double across;         ///< semi-axis across it [m]; key semi-axes
  double density;        ///< of all that the geotextile holds, gas included [kg/m3]; key density, more than the water's
  double water_density;  ///< > 0 [kg/m3]; key water-density
};

struct SemiAxes {
  double along, across;  ///< the fall [m]
};

/// Of the ellipse of a perimeter [m] and an area [m2], upright: the longer one along the fall. Keys: perimeter; area,
/// at most that of the circle.
SemiAxes upright_ellipse(double perimeter, double area);

double ellipse_area(const SinkingEllipse& ellipse);       ///< [m2]
double ellipse_perimeter(const SinkingEllipse& ellipse);  ///< [m]

/// Density of a container, a share of whose volume is gas, (1 - share) rho [kg/m3]: rho is that of the same container
/// without gas, the gas displaces its solid and water in equal parts and weighs nothing. Keys: density, air (0 to less
/// than 1).
double density_with_air(double density, double share);

/// Added mass over the mass of the displaced water, Ca = across/along [-]: potential flow (Lamb, Hydrodynamics, section
/// 71). Keys: those of the ellipse, here and below.
double added_mass_coefficient(const SinkingEllipse& ellipse);

/// Upon release, a0 = g (rho - rho_w)/(rho + Ca rho_w) [m/s2]: nothing drags yet.
double initial_acceleration(const SinkingEllipse& ellipse);

struct Drag {
  double coefficient;  ///< [-]; key drag-coefficient
  double width;        ///< across the fall, to which the coefficient belongs [m]; key width
};

/// v = sqrt(2 g A (rho - rho_w)/(w Cd rho_w)) [m/s], the formula of release.hpp for a metre. Keys also those of the
/// drag.
double terminal_velocity(const SinkingEllipse& ellipse, const Drag& drag);

/// The coefficient with which a terminal velocity [m/s] is reached [-]. Keys also width, terminal-velocity.
double drag_coefficient(const SinkingEllipse& ellipse, double width, double terminal_velocity);

/// A fall from rest with a drag that grows as the square of speed; the added mass is that of the start throughout.
struct Fall {
  double initial_acceleration;  ///< a0 [m/s2]; key initial-acceleration
  double terminal_velocity;     ///< v_inf [m/s]; key terminal-velocity
};

struct FallState {
  double time;   ///< since the release [s]
  double way;    ///< of the container, downwards [m]
  double speed;  ///< [m/s]
};

/// tau = v_inf/a0 = v_inf (rho + Ca rho_w)/((rho - rho_w) g) [s]: after it speed is 76 % of the terminal velocity.
double time_scale(const Fall& fall);

/// v = v_inf tanh(t/tau), z = v_inf tau ln cosh(t/tau). Keys: those of the fall, time (>= 0).
FallState fall_until(const Fall& fall, double time);

/// The same at a way z: v = v_inf sqrt(1 - e^-2q), t = tau (q + ln(1 + v/v_inf)), q = z/(v_inf tau). Keys: those of the
/// fall, fall-height (>= 0).
FallState fall_through(const Fall& fall, double height);

/// v = sqrt(2 a0 z), t = sqrt(2 z/a0): the fastest that a fall can be. Keys: initial-acceleration, fall-height (>= 0).
FallState fall_without_drag(double initial_acceleration, double height);

/// Of container and added mass, (rho + Ca rho_w) A v^2/2 [J/m]. Key also speed (>= 0) [m/s].
double kinetic_energy(const SinkingEllipse& ellipse, double speed);

/// What the weight under water can add once the lower tip has touched a bed: (rho - rho_w) g A along [J/m], the centre
/// coming down to the bed, which it does not pierce. Not in kinetic_energy.
double settling_energy(const SinkingEllipse& ellipse);

/// sqrt(2 E J/S) [N/m] with an energy E [J/m], an axial stiffness J [N/m] and a perimeter S [m]: the tension at which
/// an elastic membrane, free of tension before, holds all of it. NOT a design formula, no source gives one: an upper
/// bound for the root mean square of tension over the perimeter, as if soil and water dissipated nothing. One point may
/// bear more. Keys: energy (>= 0), stiffness, perimeter.
double tension_bound(double energy, double stiffness, double perimeter);

}  // namespace geodrop
