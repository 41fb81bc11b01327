// Numbers that describe a frame: of one particle, of a body, of a membrane, of the whole. All sums run in a fixed
// order, so they have the same bits for any thread count.
#pragma once

#include <array>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>
#include <string>
#include <vector>

namespace geodrop {

/// A number worth knowing that is no result of the history: "bed.skempton_b", "density_rise_ratio", ...
struct Fact {
  std::string name;  ///< ends in its unit
  double value = 0;
};

/// Total stress of particle p [Pa], tension positive, pore pressure included; order of types.hpp.
template <int Dim>
std::array<double, stress_components<Dim>> total_stress(const Body<Dim>& body, std::size_t p);

/// A rotation [rad]: in 2D an angle, anticlockwise; in 3D the components of axis times angle, at most half a turn.
template <int Dim>
using Rotation = Vec<Dim == 2 ? 1 : 3>;

/// Where a body is, how it moves, and its mean stress near its centre. The stresses, and with them the columns
/// *_centre_Pa of history.csv, are NaN while no particle is near the centre of mass, as in a ring or a splash; results
/// leave such rows out.
template <int Dim>
struct BodyMeasures {
  Vec<Dim> centre = Vec<Dim>::Zero(), velocity = Vec<Dim>::Zero();  ///< of mass [m], [m/s]
  Vec<Dim> lower = Vec<Dim>::Zero(), upper = Vec<Dim>::Zero();      ///< extremes of particle positions [m]
  Rotation<Dim> rotation = Rotation<Dim>::Zero();  ///< best fit from the initial positions, about the centres [rad]
  double velocity_rms = 0;                         ///< weighted by mass [m/s]
  double pressure_centre = 0;                      ///< mean over the volume within `radius` of the centre [Pa]
  Vec<Dim> stress_centre =
      Vec<Dim>::Zero();  ///< normal components along the axes likewise, total, tension positive [Pa]
};
template <int Dim>
BodyMeasures<Dim> measure(const Body<Dim>& body, double radius);

/// Value below which `percent` of the values lie, linear between neighbours; NaN if there are none.
double percentile(std::vector<double> values, double percent);

/// Tension and size of a membrane.
template <int Dim>
struct MembraneMeasures {
  double tension_max = 0, tension_mean = 0, tension_p95 = 0;    ///< mean over rest length, p95 over segments [N/m]
  Vec<Dim> tension_max_at = Vec<Dim>::Zero();                   ///< middle of the segment [m]
  double length = 0;                                            ///< of the line now, 2D only [m]
  double area = 0;                                              ///< enclosed, 2D and closed only; 3D: of the cloth [m2]
  double volume = 0;                                            ///< enclosed, 3D only [m3]
  double cross_tension_mean = 0, cross_tension_deviation = 0;   ///< across `tension`, over the cloth, 3D only [N/m]
  double tension_deviation = 0;                                 ///< standard deviation along the rest length [N/m]
  Vec<Dim> lower = Vec<Dim>::Zero(), upper = Vec<Dim>::Zero();  ///< extremes of the nodes [m]
  double gauge_peak = 0, gauge_time = 0;  ///< largest mean over the gauge since the last report [N/m], when [s]
  Vec<Dim> gauge_at = Vec<Dim>::Zero();   ///< middle of that gauge [m]
  double utilisation_max = 0;             ///< gauge_peak over strength [-]; NaN without strength
};
template <int Dim>
MembraneMeasures<Dim> measure(const Membrane<Dim>& membrane);

/// Energies [J], mass [kg], momentum [kg m/s] of everything, per metre of depth in 2D.
template <int Dim>
struct Totals {
  double kinetic = 0, potential = 0;
  double strain = 0;    ///< stored elastically in particles: fluid, skeleton, pore fluid
  double membrane = 0;  ///< stored in membranes
  double mass = 0;
  Vec<Dim> momentum = Vec<Dim>::Zero();

  double energy() const { return kinetic + potential + strain + membrane; }
  Totals& operator+=(const Totals& other);
};
template <int Dim>
Totals<Dim> measure(const State<Dim>& state, const Point& gravity);

/// Kinetic energy of everything [J], per metre of depth in 2D.
template <int Dim>
double kinetic_energy(const State<Dim>& state);

/// Difference of a body's pressure from a still fluid's, over its particles [Pa].
struct PressureError {
  double rms = 0, max = 0;
};
template <int Dim>
PressureError pressure_error(const Body<Dim>& body, const Newtonian& fluid, double surface, double gravity);

/// Difference of a body from the exact solution that it follows. Errors of velocity and strain (of J) are relative to
/// the solution's scales, see exact.hpp. NaN: not told by the solution.
struct ExactError {
  double velocity_rms = 0, velocity_max = 0;          ///< [-]
  double displacement_rms = 0, displacement_max = 0;  ///< [m]
  double strain_rms = 0, strain_max = 0;              ///< [-]
  // TaylorGreen, LambDipole
  double kinetic_energy = 0;                ///< over the exact one at the particles [-]
  double pressure_rms = 0;                  ///< over the exact rms [-]
  double density_min = 0, density_max = 0;  ///< over the nodes, mass over that of a full node [-]
  // BarFirstMode, from the projection of the motion on the mode
  double mode_energy = 0;  ///< over the initial one [-]
  double phase = 0;        ///< ahead of the exact swing, from -pi to pi [rad]
};
template <int Dim>
ExactError exact_error(const Scene& scene, const State<Dim>& state, const Body<Dim>& body);

}  // namespace geodrop
