// Closed forms for a geotextile container that a split barge lets go: how wide to open, what the geotextile carries,
// what the walls push, how fast it falls. Plane strain: per metre of barge. docs/release.md puts simulations beside
// them. "CUR 217": publication 217 of CUR, in English Bezuijen & Vastenburg (2013), Geosystems: Design Rules and
// Applications, chapter 6.
#pragma once

namespace geodrop {

/// Of the formulas below [m/s2].
inline constexpr double release_gravity = 9.81;

/// The section of a filled container.
struct ContainerSection {
  double area;           ///< of the fill [m2]
  double density;        ///< of the fill with what is in its pores [kg/m3]
  double water_density;  ///< around it [kg/m3]; 0: air
};

/// Force of gravity less buoyancy, (rho - rho_w) g A [N/m]. Throws SceneError, its key area, density or water-density,
/// unless A > 0 and rho > rho_w >= 0. So do all functions below where a number cannot be, with the key they name.
double container_weight(const ContainerSection& section);

/// Smallest perimeter that passes an opening of width b0 [m]: S = 2.5 (A/b0 + b0) (CUR 217, formula 6.2). That is the
/// perimeter of a rectangle as wide as the opening, and a quarter more. Keys: area, opening-width.
double smallest_perimeter(double area, double opening_width);

/// Opening that needs the smallest perimeter, b0 = sqrt(A), then 5 sqrt(A) [m]: where the derivative of 2.5 (A/b0 + b0)
/// is zero. Key: area.
double best_opening_width(double area);

/// How full the container is, 4 pi A/S^2: its area over that of the circle of its perimeter [-]. Keys: area, perimeter;
/// an area beyond the circle's is refused.
double circle_share(double area, double perimeter);

/// Tension in the geotextile while the barge opens, T = 0.45 (rho - rho_w) g A [N/m] (CUR 217, formula 6.3; the factor
/// is empirical, for sand in water; in air, rho_w = 0, this is an extrapolation). Errors as container_weight.
double opening_tension(const ContainerSection& section);

/// Two straight walls that meet at the keel and turn about a hinge straight above it, by the same angle each.
struct SplitBarge {
  double wall_slope;    ///< of the closed barge, from the horizontal [rad], 0 to pi/2; key wall-slope
  double hinge_radius;  ///< height of the hinge above the keel [m]; key hinge-radius
  double friction;      ///< coefficient, geotextile on wall [-], at least 0; key friction
};

/// Between the edges of the keel when each half has turned by `angle` [rad]: b0 = 2 R sin(angle) [m]. Keys: those of
/// the barge, angle (0 to pi/2).
double opening_width(const SplitBarge& barge, double angle);

/// The angle of each half that opens the keel by a width [m], asin(b0 / 2R) [rad]. Keys: those of the barge,
/// opening-width (at most 2 R).
double opening_angle(const SplitBarge& barge, double width);

/// Height above the keel of the closed barge at which a wall that starts to turn neither recedes from the container nor
/// pushes into it, R sin^2(slope) [m]: the foot of the perpendicular from the hinge. Below it the wall recedes.
double neutral_height(const SplitBarge& barge);

/// Horizontal force of one wall on a container that slides down slowly [N/m]: (W/2) tan(slope + angle - atan mu).
/// Statics: a wall bears W/2, its resultant leans from the wall's normal by the angle of friction. Half the container
/// in equilibrium makes it F_s - F_GT, the force of the soil less that of the geotextile across the vertical section in
/// the middle. Holds while the container slides on both walls at once: not before it slides, nor once it falls out.
/// Keys: those of the barge, weight (> 0), angle (slope + angle from atan mu to less than pi/2 + atan mu, at most
/// pi/2).
double wall_force(const SplitBarge& barge, double weight, double angle);

struct FreeFall {
  double speed;  ///< at the end [m/s]
  double time;   ///< from rest [s]
};

/// From rest in air without drag: v = sqrt(2 g h), t = sqrt(2 h/g). Key: fall-height (> 0) [m].
FreeFall free_fall(double height);

/// A whole container that sinks.
struct SinkingContainer {
  double volume;            ///< [m3]; key volume
  double frontal_area;      ///< across the fall [m2]; key frontal-area
  double drag_coefficient;  ///< [-]; key drag-coefficient
  double density;           ///< [kg/m3]
  double water_density;     ///< [kg/m3], > 0
};

/// v = sqrt(2 g V (rho - rho_w)/(A_s Cd rho_w)) [m/s]: drag balances the weight under water (CUR 217, formula 6.9).
/// Keys also density and water-density, rho > rho_w > 0.
double terminal_velocity(const SinkingContainer& container);

}  // namespace geodrop
