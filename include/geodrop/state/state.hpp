// The whole state of a simulation: what a checkpoint holds and what stages write. No pointers, no handles.
#pragma once

#include <geodrop/base/types.hpp>
#include <geodrop/materials/materials.hpp>
#include <geodrop/scene/bodies.hpp>
#include <geodrop/state/fields.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace geodrop {

/// A list that most states have empty; the hash passes over it then, so that scenes without it keep theirs.
template <class T>
struct RareList : std::vector<T> {
  using std::vector<T>::vector;
};

/// Velocity field of what a later stage of the scene places: none.
inline constexpr int waiting = -1;

/// What a body is, apart from its particles.
struct BodySettings {
  std::string name;
  std::string material_name;
  Material material;
  int field = 0;  ///< velocity field that it moves with, Grid::field; or waiting
  PressureSupport pressure = PressureSupport::cell;
  /// Of undrained soil with implicit pore pressure, see grid/implicit_pressure: one entry, not 0 where the next step is
  /// explicit; else empty.
  RareList<std::uint8_t> implicit_pores;
  bool shift = false;                            ///< particle shifting (fluids)
  double shift_speed = 0;                        ///< v0 of the shift [m/s]
  double half_size = 0;                          ///< half width of a particle's domain (Basis::gimp) [h]
  int enclosed = -1;                             ///< index in Grid::enclosed of its field (PressureSupport::enclosed)
  double unit_weight = 0, weightless_level = 0;  ///< of an enclosed fluid: gamma [N/m3], y0 [m]
};

/// Whether the water in the pores of a body acts implicitly in the next step.
inline bool implicit_pores_now(const BodySettings& body) {
  return !body.implicit_pores.empty() && !body.implicit_pores.front();
}

/// Moduli of a body that the next step follows explicitly.
inline ElasticModuli explicit_moduli(const BodySettings& body) {
  ElasticModuli moduli = elastic_moduli(body.material);
  if (implicit_pores_now(body)) moduli.bulk -= implicit_modulus(body.material);
  return moduli;
}

/// One body: its law and its particles.
template <int Dim>
struct Body : BodySettings, Particles<Dim> {
  /// Current volume of particle p [m3], per metre of depth in 2D.
  double volume(std::size_t p) const { return this->mass[p] * this->J[p] / reference_density(material); }
  /// Volume of gas at zero pressure over that of the water of particle p, see fluid_pressure.
  double gas_at(std::size_t p) const { return this->gas.empty() ? 0 : this->gas[p]; }
};

/// Pressure of particle p of a body [Pa], compression positive, pore pressure included.
template <int Dim>
double mean_pressure(const Body<Dim>& body, std::size_t p);

/// Tension as a wide-width strip test measures it: over a gauge length along the line and a time, see
/// membrane/tension_gauge.
template <int Dim>
struct TensionGauge {
  std::uint64_t windows = 0;          ///< of time that are complete, from the start of the run
  Array<double> sums;                 ///< segments in each of the latest windows: T dt, the running one last [N s/m]
  double now = 0;                     ///< largest along the line, over the latest whole time [N/m]
  std::array<double, Dim> now_at{};   ///< middle of the gauge [m]
  double peak = 0;                    ///< largest `now` since it was last reported [N/m]
  double peak_time = 0;               ///< at the end of that time [s]
  std::array<double, Dim> peak_at{};  ///< middle of the gauge [m]
};

/// Triangles of a membrane in space, with what they are at rest; in the plane there are none.
template <int Dim>
struct MembraneTriangles {};
template <>
struct MembraneTriangles<3> {
  Fabric fabric = Fabric::isotropic;
  double poisson_ratio = 0;                      ///< of one that is not of yarns [-]
  double weft_stiffness = 0, weft_strength = 0;  ///< of yarns [N/m]
  double mass_per_area = 0;                      ///< [kg/m2]
  double gauge_pressure = 0;                     ///< inside over outside [Pa]
  std::array<Array<std::uint32_t>, 3> corner;    ///< nodes, anticlockwise from outside
  std::array<Array<double>, 4> inverse_rest;     ///< D^-1 [1/m], D the two edges from corner 0 in warp and weft
  Array<double> rest_area;                       ///< [m2]
  std::array<Array<double>, 3> water_shear;      ///< of a sharp one: traction along it of what is around [Pa]; or empty
  Array<double> cross_tension;                   ///< smaller principal one, or of the weft, per width at rest [N/m]
  /// Edges on walls at which the surface ends: nodes, as their triangle runs along them, and wall_number; else empty.
  std::array<Array<std::uint32_t>, 3> open_edge;

  std::size_t size() const { return rest_area.size(); }
};

/// Tension-only membrane: a polyline of nodes with segments between neighbours (2D), or nodes and triangles (3D).
template <int Dim>
struct Membrane {
  std::string name;
  std::string body;
  int field = 0;  ///< its body's
  bool closed = true;
  bool sharp = false;                   ///< its body and what is around it meet at a sharp interface
  double axial_stiffness = 0;           ///< J [N/m]
  double strength = 0;                  ///< [N/m]
  double contents_friction = 0;         ///< mu between it and its body, if it slides [-]
  double gauge_length = 0;              ///< of the reported tension [m]
  double half_size = 0;                 ///< half distance of nodes when drawn, their domain for Basis::gimp [h]
  std::array<Array<double>, Dim> x, v;  ///< nodes [m], [m/s]
  Array<double> mass;                   ///< nodes [kg], per metre of depth
  Array<double> rest_length;            ///< segments [m]
  Array<double> strain;                 ///< segments, signed [-]
  Array<double> tension;                ///< segments [N/m]
  TensionGauge<Dim> gauge;              ///< what is reported of it
  std::array<Array<double>, Dim> load;  ///< nodes: of contacts, of the weight inside [N]; else empty

  // Of one that slides over its body:
  Array<double> share;              ///< segments: of the length of the line, at the start [-]; else empty
  Array<double> contents_pressure;  ///< nodes: effective pressure p' of a soil inside on it [Pa]; else empty

  // Of a sharp membrane:
  std::string bed;              ///< body around that it rubs on; empty: none
  double bed_friction = 0;      ///< mu on it [-]
  Shear shear = Shear::none;    ///< of the fluid around
  double wall_friction = 0;     ///< C_f of Shear::wall_law [-]
  double roughness = 0;         ///< k_s of Shear::rough_wall [m]
  double drag_coefficient = 0;  ///< C_d of a drag that the fluid does not feel [-]
  double fluid_density = 0;     ///< of the fluid around [kg/m3]; 0: there is none
  /// Nodes: what particles that it has held back left to it in the last step, see cut/keep_sides [N s]; else empty.
  std::array<Array<double>, Dim> caught;
  Array<double> water_pressure;  ///< segments: of what is around [Pa]; else empty
  Array<double> water_shear;     ///< likewise, traction on the membrane along it, from node to node [Pa]
  Array<double> bed_shear;       ///< the part of it that is friction on the bed [Pa]; empty without a bed
  Array<double> bed_pressure;    ///< the part of water_pressure that grains of a coupled bed bear [Pa]; else empty

  // Of a sharp membrane whose body is a soil with water in its pores:
  double permeance = 0;             ///< flow through it per area and pressure difference, psi / gamma_w [m/(s Pa)]
  Array<double> permeance_strains;  ///< strains at which it is `permeance_factors` times that, linear between [-]
  Array<double> permeance_factors;  ///< [-]
  Array<double> pore_pressure;      ///< segments or triangles: of the water inside on it [Pa]; else empty
  Array<double> seepage;            ///< segments or triangles: flow through it per area, outwards [m/s]

  /// In space `strain` and `tension` are those of triangles: the larger principal ones, or of the warp.
  [[no_unique_address]] MembraneTriangles<Dim> triangles;

  std::size_t nodes() const { return mass.size(); }
  std::size_t segments() const { return rest_length.size(); }
  bool slides() const { return !share.empty(); }
};

/// A node of a membrane that is held, or hangs on a line, see membrane/anchors.
template <int Dim>
struct Anchor {
  std::string name, membrane;
  std::uint32_t node = 0;
  bool line = false;                ///< else held at `to`
  std::array<double, Dim> to{};     ///< where it is held; the fixed end of the line [m]
  double compliance = 0;            ///< of the line: extension per force; 0: it does not stretch [m/N]
  double length = 0;                ///< of the line at rest [m]
  double stretch = 0;               ///< of the line, in the last step [m]
  std::array<double, Dim> force{};  ///< on the membrane, in the last step [N]
};

/// A rigid surface and how far it has moved. A pose is a rotation about `centre` and then a displacement.
template <int Dim>
struct RigidBody {
  std::string name;
  bool half_plane = false;                 ///< else a capsule, or what its corners say
  std::array<double, Dim> from{}, to{};    ///< at the start: ends of the capsule's segment; a point of the half-plane;
                                           ///< the least and largest x of a box or prism in space [m]
  std::array<double, Dim> normal{};        ///< of a half-plane at the start: unit, out of the rigid body
  double radius = 0;                       ///< of a capsule or polyline [m]
  std::array<double, Dim> centre{};        ///< of rotation [m]
  bool moving = true;                      ///< its motion goes on
  bool present = true;                     ///< contacts notice it
  double moved = 0;                        ///< for how long it has moved [s]
  double angle = 0;                        ///< anticlockwise from the start [rad]
  std::array<double, Dim> displacement{};  ///< from the start [m]
  double angle_rate = 0;                   ///< over the last step [rad/s]
  std::array<double, Dim> velocity{};      ///< likewise [m/s]
  /// At the start [m]: of a polygon (radius 0) clockwise, so that the outside is on the left; of a polyline in order;
  /// of a box or prism in space those of its section at the least x, clockwise seen from +x (y to the right, z up).
  RareList<std::array<double, Dim>> corners;
};

/// A membrane's nodes, or a body's particles, on a rigid body (in space nodes only). Nodes and particles are points
/// here.
template <int Dim>
struct RigidContact {
  std::string touching, rigid;
  bool bare = false;            ///< particles, without a membrane
  double friction = 0;          ///< mu [-]
  double stiffness = 0;         ///< penalty: pressure per penetration [Pa/m]
  double damping = 0;           ///< of the penalty: pressure per normal velocity [Pa s/m]
  Array<double> reach;          ///< bare: how far its surface is from a particle at the start, by id [m]
  Array<double> half_width;     ///< bare: the same now, as the flow flattens or stretches what touches [m]
  Array<std::uint32_t> points;  ///< that touched in the last step: nodes, or ids of particles; ascending; in a corner
                                ///< of a polygon twice
  Array<double> slip;  ///< of each: stretch of its tangential spring, along the normal turned clockwise; 3D: vector [m]
  Array<std::int8_t> side;  ///< of each: 1 left, -1 right of the capsule's segment; 0: not yet beside it
  std::array<double, Dim> normal_force{}, friction_force{};  ///< sums over the points in the last step [N]
  double normal_sum = 0, friction_sum = 0;                   ///< sums of their sizes, friction with its sign [N]
  double friction_work = 0, damping_work = 0;                ///< turned into heat so far [J]
  double driving_work = 0;                                   ///< done by the motion of the rigid body so far [J]
  RareList<std::uint32_t> piece;  ///< of each point on a polygon or polyline: its edge, or edges + corner; else empty
  RareList<double>
      pressed_in;  ///< bare, of fluids: the part of `reach` that the pressure at the start presses in, by id [m]
};

/// Two membranes that touch, or the folds of one, see contact/membrane_contact.
template <int Dim>
struct MembraneContact {
  std::array<std::string, 2> between;  ///< names; twice the same: own folds
  std::array<double, 2> outward;       ///< 1: the body is on the left of its membrane, -1: on its right; in space 1
  double friction = 0;                 ///< mu [-]
  double stiffness = 0;                ///< penalty: pressure per penetration [Pa/m]
  double damping = 0;                  ///< of the penalty: pressure per normal velocity [Pa s/m]
  double reach = 0;                    ///< farthest distance at which nodes look for segments [m]
  std::array<Array<double>, 2> slip;   ///< stretch of the tangential springs of the nodes of both; 3D: vectors [m]
  std::array<double, Dim> force{};     ///< on the first membrane, in the last step [N]
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

/// A layer of a fluid beside a side wall in which waves fade (2D).
struct SilentSide {
  std::string name, body;
  double outward = 1;       ///< 1: towards the right wall, -1: the left one
  double begin = 0;         ///< where the layer begins [m]
  double width = 0;         ///< [m]
  double rate = 0;          ///< of fading, at the wall [1/s]
  double surface = 0;       ///< of the still fluid [m]
  double gravity = 0;       ///< downwards [m/s2]
  double water_beyond = 0;  ///< length of the water beyond that flows with that inside [m]
  double rest_time = 0;     ///< what lasts longer is no wave [s]
  Array<double> lasting;  ///< pressure over that of the still fluid that stays, by stored node of the upright axis [Pa]
  Array<double> flow;     ///< velocity of the water beyond outwards, likewise [m/s]
};

/// How far a state has come to rest, see step/relaxation. Energies in J.
struct Relaxation {
  double kinetic = 0, kinetic_largest = 0;             ///< after the last step; largest of the present cycle
  double out_of_balance_largest = 0;                   ///< of the present cycle [-]
  double initial_potential = 0;                        ///< of gravity, of all mass where it came in
  double kinetic_ratio = 1, out_of_balance_ratio = 1;  ///< of the last whole cycle [-]
  std::uint64_t steps = 0;                             ///< of the present cycle
  std::uint64_t cycles = 0, cycles_at_rest = 0;        ///< so far; the latest ones in a row that met both criteria
};

/// What a state may hold in motion and strain, see step/energy_watch. Energies in J.
struct EnergyBudget {
  bool begun = false;
  std::uint64_t stages = 0;  ///< that had been entered when it began
  double t = 0;              ///< of the last look, when all was in order [s]
  double held = 0;           ///< in motion and strain when it began
  double potential = 0;      ///< in loads when it began, and all that came from outside since
  double fallen = 0;         ///< largest loss of potential since, with what came
  double driven = 0;         ///< by the motion of rigid bodies, when it began
};

/// How often the pressures on sharp membranes were not found, see cut/interface_constraint. Counted anew after a
/// checkpoint; no result depends on it.
struct ConstraintWatch {
  std::uint64_t unsolved = 0;  ///< steps so far in which the solver stopped short of its tolerance
  std::uint64_t in_a_row = 0;  ///< of them, the last ones without a break
};

/// Massless points that move with the grid velocity.
template <int Dim>
struct Tracer {
  std::string name;
  std::array<double, Dim> x, v, initial_x;
  int field = 0;
  std::string body{};  ///< that it moves with
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
  std::vector<RigidBody<Dim>> rigid;
  std::vector<RigidContact<Dim>> rigid_contacts;
  std::vector<MembraneContact<Dim>> membrane_contacts;
  std::vector<ViscousBoundary<Dim>> viscous_boundaries;
  std::vector<SilentSide> silent_sides;
  RareList<Anchor<Dim>> anchors;
  std::vector<Tracer<Dim>> tracers;
  Relaxation relaxation;
  EnergyBudget energy_budget;
  ConstraintWatch constraint_watch;

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
