// The whole state of a simulation: what a checkpoint holds and what stages write. No pointers, no handles.
#pragma once

#include <geodrop/materials.hpp>
#include <geodrop/types.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace geodrop {

/// Velocity field of what a later stage of the scene places: none.
inline constexpr int waiting = -1;

/// One body: its law and its particles, one array per scalar component (structure of arrays). All arrays
/// have `size()` entries or, where the body has no such quantity, none.
/// Particles are kept sorted by base cell (see grid/sort_particles); `id` is the order at the start.
template <int Dim>
struct Body {
  std::string name;
  std::string material_name;
  Material material;
  int field = 0;  ///< velocity field that it moves with, Grid::field; or waiting
  PressureSupport pressure = PressureSupport::cell;
  bool shift = false;                            ///< particle shifting (fluids)
  double shift_speed = 0;                        ///< v0 of the shift [m/s]
  double half_size = 0;                          ///< half width of a particle's domain (Basis::gimp) [h]
  int enclosed = -1;                             ///< index in Grid::enclosed of its field (PressureSupport::enclosed)
  double unit_weight = 0, weightless_level = 0;  ///< of an enclosed fluid: gamma [N/m3], y0 [m]

  std::array<Array<double>, Dim> x;             ///< position [m]
  std::array<Array<double>, Dim> v;             ///< velocity [m/s]
  std::array<Array<double>, Dim * Dim> affine;  ///< C, row-major: dv_a/dx_b ~ affine[a * Dim + b] [1/s]
  Array<double> mass;                           ///< [kg], per metre of depth in 2D
  Array<double> J;                              ///< volume ratio to the reference density [-]
  std::array<Array<double>, stress_components<Dim>>
      stress;                                        ///< soil: effective Cauchy stress; viscous fluid: deviator [Pa]
  std::array<Array<double>, Dim * Dim> deformation;  ///< neo-Hookean: F, row-major [-]
  Array<double> pore_pressure;                       ///< undrained soil [Pa]
  Array<double> deviatoric_strain;                   ///< soil: accumulated sqrt(2/3 e:e) [-]
  Array<double> gap;                                 ///< soil with void memory: volume of open voids over its own [-]
  Array<std::uint32_t> id;                           ///< index at the start

  // Indexed by id, so never permuted:
  std::array<Array<double>, Dim> initial_x;  ///< [m]
  Array<std::uint8_t> layer;                 ///< horizontal band at the start

  // Written by sort_particles:
  Array<std::uint32_t> slab_begin;  ///< first particle of each slab of the grid, one more at the end

  std::size_t size() const { return mass.size(); }
  /// Current volume of particle p [m3], per metre of depth in 2D.
  double volume(std::size_t p) const { return mass[p] * J[p] / reference_density(material); }
};

/// Pressure of particle p of a body [Pa], compression positive, pore pressure included.
template <int Dim>
double mean_pressure(const Body<Dim>& body, std::size_t p);

/// Memory of all that the particles of a body have [byte].
template <int Dim>
double particle_bytes(const Body<Dim>& body);

/// Tension-only membrane: a polyline of nodes with segments between neighbours (2D).
template <int Dim>
struct Membrane {
  std::string name;
  std::string body;
  int field = 0;  ///< its body's
  bool closed = true;
  double axial_stiffness = 0;           ///< J [N/m]
  double strength = 0;                  ///< [N/m]
  int averaging_segments = 0;           ///< half width of the box mean
  double half_size = 0;                 ///< half distance of nodes when drawn, their domain for Basis::gimp [h]
  std::array<Array<double>, Dim> x, v;  ///< nodes [m], [m/s]
  Array<double> mass;                   ///< nodes [kg], per metre of depth
  Array<double> rest_length;            ///< segments [m]
  Array<double> strain;                 ///< segments, averaged, signed [-]
  Array<double> tension;                ///< segments, that acts: averaged twice [N/m]
  double tension_peak = 0;              ///< largest tension since it was last reported [N/m]
  std::array<Array<double>, Dim> load;  ///< nodes: of contacts, of the weight inside [N]; else empty

  std::size_t nodes() const { return mass.size(); }
  std::size_t segments() const { return rest_length.size(); }
};

/// A membrane on the boundary of a rigid half-plane.
template <int Dim>
struct Contact {
  std::string membrane, rigid;
  std::array<double, Dim> point, normal;  ///< of the boundary [m]; unit, out of the rigid body
  double friction = 0;                    ///< mu [-]
  double stiffness = 0;                   ///< penalty: pressure per penetration [Pa/m]
  std::array<Array<double>, Dim> slip;    ///< stretch of the tangential springs of the nodes [m]
};

/// Two membranes that touch, or the folds of one, see contact/membrane_contact.
struct MembraneContact {
  std::array<std::string, 2> between;  ///< names; twice the same: own folds
  std::array<double, 2> outward;       ///< 1: the body is on the left of its membrane, -1: on its right
  double friction = 0;                 ///< mu [-]
  double stiffness = 0;                ///< penalty: pressure per penetration [Pa/m]
  double reach = 0;                    ///< farthest distance at which nodes look for segments [m]
  std::array<Array<double>, 2> slip;   ///< stretch of the tangential springs of the nodes of both [m]
  std::array<double, 2> force{};       ///< on the first membrane, in the last step [N]
  double normal_force = 0;             ///< sum of the magnitudes of normal forces, likewise [N]
};

/// Points that move with the outermost particles at an edge of the ground; dashpots and springs act on them (2D).
template <int Dim>
struct ViscousBoundary {
  std::string name;
  int field = 0;                            ///< its body's
  std::array<double, Dim> normal{};         ///< unit, out of the body
  double length = 0;                        ///< of the line that belongs to each point [m]
  double half_size = 0;                     ///< of a point's domain for Basis::gimp, that of the particles [h]
  double inwards = 0;                       ///< of the edge, by half a particle [m]
  double impedance_p = 0, impedance_s = 0;  ///< rho c_p, rho c_s [Pa s/m]
  double spring = 0;                        ///< rho c_p^2 / depth [Pa/m]
  std::array<Array<double>, Dim> x, v;      ///< [m], [m/s]
  std::array<Array<double>, Dim> moved;     ///< displacement since the start [m]
  std::array<Array<double>, Dim> at_start;  ///< traction at the start [Pa]

  std::size_t points() const { return x[0].size(); }
};

/// How far a state has come to rest, see pipeline/relaxation. Energies in J.
struct Relaxation {
  double kinetic = 0, kinetic_largest = 0;             ///< after the last step; largest of the present cycle
  double out_of_balance_largest = 0;                   ///< of the present cycle [-]
  double initial_potential = 0;                        ///< of gravity, of all mass where it came in
  double kinetic_ratio = 1, out_of_balance_ratio = 1;  ///< of the last whole cycle [-]
  std::uint64_t steps = 0;                             ///< of the present cycle
  std::uint64_t cycles = 0, cycles_at_rest = 0;        ///< so far; the latest ones in a row that met both criteria
};

/// Massless points that move with the grid velocity.
template <int Dim>
struct Tracer {
  std::string name;
  std::array<double, Dim> x, v, initial_x;
  int field = 0;
};

template <int Dim>
struct State {
  double t = 0;  ///< [s]
  std::uint64_t step = 0;
  double drift = 0;         ///< accumulated |v|max dt since the last sort [m]; negative: sort before the next step
  double v_max = 0;         ///< largest particle speed [m/s]
  double damping_rate = 0;  ///< mass-proportional damping of velocities [1/s]
  std::uint64_t stages_entered = 0;  ///< of the scene's stages
  std::vector<Body<Dim>> bodies;
  std::vector<Membrane<Dim>> membranes;
  std::vector<Contact<Dim>> contacts;
  std::vector<MembraneContact> membrane_contacts;
  std::vector<ViscousBoundary<Dim>> viscous_boundaries;
  std::vector<Tracer<Dim>> tracers;
  Relaxation relaxation;

  /// Number of particles of all bodies.
  std::size_t particles() const {
    std::size_t count = 0;
    for (const Body<Dim>& body : bodies) count += body.size();
    return count;
  }
};

/// Read-only view for writers, probes and checkpoints.
template <int Dim>
class Frame {
 public:
  explicit Frame(const State<Dim>& state) : state_(&state) {}
  const State<Dim>* operator->() const { return state_; }
  const State<Dim>& operator*() const { return *state_; }

 private:
  const State<Dim>* state_;
};

}  // namespace geodrop
