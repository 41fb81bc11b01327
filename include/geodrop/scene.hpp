// The scene: plain values in SI units, as the user wrote them and as `check_scene` accepted them.
// Nobody writes to it after it was read. Vectors have as many entries as the scene has dimensions.
// `==` compares every value, the positions in the file included.
#pragma once

#include <array>
#include <cstdint>
#include <geodrop/error.hpp>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace geodrop {

using Point = std::vector<double>;  ///< coordinates or components [m, m/s, ...], size = dimension

// --- Shapes ------------------------------------------------------------------------------------
struct BoxShape {
  Point lower, upper;  ///< [m]
  bool operator==(const BoxShape&) const = default;
};
/// In 3D an ellipsoid with its axes along x, y, z.
struct EllipseShape {
  Point centre;           ///< [m]
  Point semi_axes;        ///< [m]
  double tilt_deg = 0.0;  ///< anticlockwise rotation of the axes, 2D only [degree]
  bool operator==(const EllipseShape&) const = default;
};
struct PolygonShape {
  std::vector<Point> points;  ///< [m], simple polygon, either orientation
  bool operator==(const PolygonShape&) const = default;
};
/// In 3D a half-space.
struct HalfPlaneShape {
  Point point;   ///< a point of the boundary [m]
  Point normal;  ///< points out of the body
  bool operator==(const HalfPlaneShape&) const = default;
};
using Shape = std::variant<BoxShape, EllipseShape, PolygonShape, HalfPlaneShape>;

// --- Materials ---------------------------------------------------------------------------------
/// Newtonian, weakly compressible: p = K (rho / rho0 - 1), deviator 2 mu dev(D).
struct NewtonianSpec {
  double density = 0;       ///< at zero pressure [kg/m3]
  double bulk_modulus = 0;  ///< [Pa]; the scene may give sound_speed instead, K = rho c^2
  double viscosity = 0;     ///< dynamic [Pa s]
  bool operator==(const NewtonianSpec&) const = default;
};
/// Hypoelastic with logarithmic strain and a rotated (Hughes-Winget) Cauchy stress.
struct LinearElasticSpec {
  double density = 0;         ///< [kg/m3]
  double youngs_modulus = 0;  ///< [Pa]
  double poissons_ratio = 0;  ///< [-]
  bool operator==(const LinearElasticSpec&) const = default;
};
/// Compressible neo-Hookean solid: sigma = (mu / J) (F F^T - I) + (lambda ln J / J) I.
struct NeoHookeanSpec {
  double density = 0;         ///< unstrained [kg/m3]
  double youngs_modulus = 0;  ///< at small strain [Pa]
  double poissons_ratio = 0;  ///< [-]
  bool operator==(const NeoHookeanSpec&) const = default;
};
/// Fluid in the pores of an undrained soil: pore pressure rate = -(K_f / n) div v.
struct UndrainedSpec {
  double porosity = 0;            ///< [-]
  double fluid_bulk_modulus = 0;  ///< [Pa]
  bool operator==(const UndrainedSpec&) const = default;
};
/// Elastic, perfectly plastic Mohr-Coulomb in effective stress.
struct MohrCoulombSpec {
  double density = 0;                      ///< of the mixture [kg/m3]
  double youngs_modulus = 0;               ///< [Pa]
  double poissons_ratio = 0;               ///< [-]
  double cohesion = 0;                     ///< [Pa]
  double friction_angle_deg = 0;           ///< [degree]
  double dilatancy_angle_deg = 0;          ///< [degree]
  double tension_cutoff = 0;               ///< largest principal effective stress [Pa], at most c cot(phi)
  std::optional<UndrainedSpec> undrained;  ///< empty: drained
  bool void_memory = false;                ///< what opens at the cut-off closes again without stress
  bool operator==(const MohrCoulombSpec&) const = default;
};
struct MaterialSpec {
  std::string name;
  std::variant<NewtonianSpec, LinearElasticSpec, MohrCoulombSpec, NeoHookeanSpec> model;
  SourceRef at;
  bool operator==(const MaterialSpec&) const = default;
};

// --- Initial stress ----------------------------------------------------------------------------
/// Still fluid below `surface`; p = K (exp(rho0 g d / K) - 1) at depth d, the exact weakly compressible column.
struct HydrostaticSpec {
  std::string fluid;   ///< material name of a Newtonian fluid
  double surface = 0;  ///< level of the free surface [m]
  bool operator==(const HydrostaticSpec&) const = default;
};
/// Zero stress at the start.
struct ZeroStressSpec {
  bool operator==(const ZeroStressSpec&) const = default;
};
/// Soil at rest below its own level surface, under a fluid if `fluid` is given.
struct K0StressSpec {
  double surface = 0;                    ///< level of the soil surface [m]
  double k0 = 0;                         ///< horizontal over vertical effective stress [-]
  std::optional<HydrostaticSpec> fluid;  ///< gives overburden and pore pressure
  bool operator==(const K0StressSpec&) const = default;
};
/// Isotropic total stress equal to the pressure of the still fluid (a drained bag: effective stress -p I; undrained:
/// pore pressure p).
struct FluidPressureSpec {
  HydrostaticSpec fluid;
  bool operator==(const FluidPressureSpec&) const = default;
};
/// Velocity or stress of the exact solution that the body follows, see ExactSpec.
struct FromExactSpec {
  bool operator==(const FromExactSpec&) const = default;
};
using InitialStress = std::variant<ZeroStressSpec, HydrostaticSpec, K0StressSpec, FluidPressureSpec, FromExactSpec>;

// --- Initial velocity --------------------------------------------------------------------------
/// The same velocity everywhere (also what `type = "rest"` becomes).
struct UniformVelocitySpec {
  Point value;  ///< [m/s]
  bool operator==(const UniformVelocitySpec&) const = default;
};
/// First mode of a bar fixed at coordinate 0 and free at `length`: v = amplitude sin(pi x / (2 length)) along `axis`.
struct BarFirstModeSpec {
  double amplitude = 0;  ///< velocity of the free end [m/s]
  int axis = 0;          ///< 0: x, 1: y, 2: z
  double length = 0;     ///< [m]
  bool operator==(const BarFirstModeSpec&) const = default;
};
using InitialVelocity = std::variant<UniformVelocitySpec, BarFirstModeSpec, FromExactSpec>;

// --- Exact solutions ---------------------------------------------------------------------------
// What each means stands in exact.hpp.
struct AxisAlignedMmsSpec {
  double amplitude = 0;  ///< A [m]
  double length = 0;     ///< of a wave [m]
  bool operator==(const AxisAlignedMmsSpec&) const = default;
};
struct TaylorGreenSpec {
  double speed = 0;   ///< U [m/s]
  double length = 0;  ///< of a wave, two vortices [m]
  bool operator==(const TaylorGreenSpec&) const = default;
};
struct UniformMotionSpec {
  Point velocity;  ///< [m/s]
  Point stretch;   ///< present over unstrained length [-]
  bool operator==(const UniformMotionSpec&) const = default;
};
/// A solution that a body follows: what it may start from, is driven by, and can be compared with.
struct ExactSpec {
  std::string body;
  std::variant<AxisAlignedMmsSpec, TaylorGreenSpec, UniformMotionSpec, BarFirstModeSpec> solution;
  SourceRef at;
  bool operator==(const ExactSpec&) const = default;
};

// --- Bodies, membranes -------------------------------------------------------------------------
/// Where the mean stress of a body acts from: the cell average (cures locking and noise), each particle, or the nodal
/// average of tri3 and tet4 (the paper's cure), or cells cut exactly by the membrane around (enclosed/enclosed_fluid).
enum class PressureSupport { cell, particle, nodal, enclosed };

struct BodySpec {
  std::string name;
  std::string material;
  Shape shape;
  std::vector<std::string> minus;   ///< bodies whose shapes are cut out of this one
  int particles_per_cell_axis = 2;  ///< particles per cell and axis [-]
  double jitter = 0;                ///< random offset, fraction of the particle spacing [-]
  std::uint64_t jitter_seed = 0;
  InitialVelocity initial_velocity;
  InitialStress initial_stress;
  PressureSupport pressure = PressureSupport::cell;
  int layers = 1;          ///< horizontal bands that colour the picture
  double shift_speed = 0;  ///< v0 of particle shifting [m/s]
  bool shift = false;      ///< particle shifting (fluids only)
  SourceRef at;
  bool operator==(const BodySpec&) const = default;
};

/// How the body of a membrane and what is around it share cells.
enum class Interface {
  mixture,  ///< one velocity field: they stick to each other
  sharp     ///< a field each, cut cells between them; they part along the membrane only (src/interface)
};
struct MembraneSpec {
  std::string name;
  std::string body;           ///< lies on this body's outline
  std::vector<Point> points;  ///< polyline [m]; empty: the whole outline, closed
  bool closed = true;
  double axial_stiffness = 0;    ///< J [N/m]
  double mass_per_area = 0;      ///< [kg/m2]
  double strength = 0;           ///< [N/m]
  double slack = 0;              ///< rest length / drawn length - 1 [-]
  double segments_per_cell = 4;  ///< spacing of nodes = h of the finest cells / segments_per_cell
  int averaging_segments = 2;    ///< half width w of the box mean of strain and of force
  Interface interface = Interface::mixture;
  std::string bed;          ///< body around that a sharp membrane rubs on; empty: none
  double bed_friction = 0;  ///< on it [-]
  SourceRef at;
  bool operator==(const MembraneSpec&) const = default;
};

// --- Contact -----------------------------------------------------------------------------------
/// All points within `radius` of a segment; a disc if its ends are one point.
struct CapsuleShape {
  Point from, to;     ///< ends of the segment [m]
  double radius = 0;  ///< [m]
  bool operator==(const CapsuleShape&) const = default;
};
using RigidShape = std::variant<HalfPlaneShape, CapsuleShape>;

/// Rotation about a point that stands still.
struct HingeMotionSpec {
  Point centre;               ///< [m]
  double rate = 0;            ///< anticlockwise [rad/s]
  double stop_angle_deg = 0;  ///< where it ends, > 0 in either sense [degree]
  bool operator==(const HingeMotionSpec&) const = default;
};
struct TranslationMotionSpec {
  Point velocity;  ///< [m/s]
  bool operator==(const TranslationMotionSpec&) const = default;
};
/// Piecewise linear between the times, at rest before the first and after the last of them.
struct TableMotionSpec {
  std::vector<double> times;         ///< since the body began to move, ascending [s]
  Point centre;                      ///< of a rotation [m]
  std::vector<double> angles_deg;    ///< of a rotation, anticlockwise from the start [degree]; else empty
  std::vector<Point> displacements;  ///< of a translation, from the start [m]; else empty
  bool operator==(const TableMotionSpec&) const = default;
};
/// The first of them: it does not move.
using RigidMotion = std::variant<std::monostate, HingeMotionSpec, TranslationMotionSpec, TableMotionSpec>;

/// Rigid ground, wall or hull that only contacts notice.
struct RigidSpec {
  std::string name;
  RigidShape shape;
  RigidMotion motion;
  SourceRef at;
  bool operator==(const RigidSpec&) const = default;
};
/// Two that touch: penalty with Coulomb friction, see contact/surface_contact and membrane_contact.
struct ContactSpec {
  std::array<std::string, 2> between;  ///< see ContactPair
  double friction = 0;                 ///< mu [-]
  double stiffness = 1;                ///< of the penalty, over P / h of the body that touches, P its wave modulus [-]
  double damping = 1;                  ///< of a rigid body's penalty, over the impedance rho c of that body [-]
  SourceRef at;
  bool operator==(const ContactSpec&) const = default;
};

/// Fluid at rest outside of a closed membrane: its pressure acts on the membrane, nothing moves it.
struct StillFluidSpec {
  std::string membrane;
  std::string fluid;   ///< material name of a Newtonian fluid
  double surface = 0;  ///< level of its surface [m]
  SourceRef at;
  bool operator==(const StillFluidSpec&) const = default;
};
/// A line on a body's outline that lets waves out, see boundary/viscous_boundary.
struct ViscousBoundarySpec {
  std::string name;
  std::string body;
  Point from, to;           ///< ends of the line [m]
  double spring_depth = 0;  ///< thickness of the layer of the same ground that its spring stands for [m]
  SourceRef at;
  bool operator==(const ViscousBoundarySpec&) const = default;
};
/// Fluid that is pumped into a body while from <= t < to: its rest volume grows.
struct PumpSpec {
  std::string body;
  double rate = 0;          ///< rest volume per time [m3/s], per metre of depth in 2D [m2/s]
  double from = 0, to = 0;  ///< [s]
  SourceRef at;
  bool operator==(const PumpSpec&) const = default;
};

// --- Numerics ----------------------------------------------------------------------------------
enum class Basis { bspline2, gimp, linear, tri3, tet4 };
inline bool is_simplex(Basis basis) { return basis == Basis::tri3 || basis == Basis::tet4; }
enum class WallKind { slip, no_slip, periodic };
enum class Transfer { tpic, blend, musl };
/// consistent: two terms of the series for the inverse, see grid/mass_correction.
enum class MassMatrix { lumped, consistent };

/// Finer cells along one axis between `from` and `to`, growing to the spacing of the grid on both sides.
struct RefineSpec {
  int axis = 0;                      ///< 0: x, 1: y, 2: z
  double from = 0, to = 0;           ///< [m]
  double spacing = 0, growth = 1.1;  ///< of the cells there [m]; width of a cell over that of the next finer one [-]
  SourceRef at;
  bool operator==(const RefineSpec&) const = default;
};
struct GridSpec {
  Point lower, upper;  ///< domain [m]
  double spacing = 0;  ///< h [m]
  Basis basis = Basis::bspline2;
  std::vector<RefineSpec> refine{};  ///< at most one an axis
  bool operator==(const GridSpec&) const = default;
};
struct WallsSpec {
  std::vector<WallKind> lower, upper;  ///< per axis
  bool operator==(const WallsSpec&) const = default;
};
struct SolverSpec {
  Transfer transfer = Transfer::tpic;
  double blend_rate = 0;    ///< lambda [1/s] of Transfer::blend
  double courant = 0.5;     ///< C of dt = C h / (c_eff + |v|max)
  double damping_rate = 0;  ///< mass-proportional damping of particle velocity [1/s]
  MassMatrix mass_matrix = MassMatrix::lumped;
  bool operator==(const SolverSpec&) const = default;
};
/// How a run comes to rest: kinetic damping until both ratios are met, see pipeline/relaxation.
struct RelaxationSpec {
  enum class Damping { none, kinetic } damping = Damping::none;
  double kinetic_ratio = 0;         ///< kinetic energy over the work of gravity, to be reached [-]
  double out_of_balance_ratio = 0;  ///< |sum of forces| over |weight|, norms over the nodes, to be reached [-]
  bool operator==(const RelaxationSpec&) const = default;
};
struct TimeSpec {
  double end = 0;  ///< [s]; earlier if a relaxation has come to rest
  bool operator==(const TimeSpec&) const = default;
};
/// A part of the run, from its time on until the next stage begins.
struct StageSpec {
  std::string name;
  double from = 0;                   ///< [s]
  double damping_rate = 0;           ///< mass-proportional damping of particle velocity [1/s]
  double damping_ramp = 0;           ///< time over which the damping rises to that [s]
  std::vector<std::string> places;   ///< bodies, with their membranes, that were not there before
  std::vector<std::string> moves;    ///< rigid bodies whose motion goes on in this stage only
  std::vector<std::string> removes;  ///< rigid bodies that contacts no longer notice
  SourceRef at;
  bool operator==(const StageSpec&) const = default;
};
struct OutputSpec {
  double frame_interval = 0;    ///< time between VTU frames [s]
  double history_interval = 0;  ///< time between rows of history.csv [s]
  bool compress = false;        ///< zlib in VTU files
  bool operator==(const OutputSpec&) const = default;
};

// --- What is measured --------------------------------------------------------------------------
/// A massless point that moves with the grid velocity; columns position_*_m, displacement_*_m, velocity_*_m_s.
struct TracerSpec {
  std::string name;
  Point position;  ///< [m]
  bool operator==(const TracerSpec&) const = default;
};
/// rms over the particles of a body of pressure minus still-fluid pressure; columns pressure_error_{rms,max,p999}_Pa.
struct HydrostaticProbeSpec {
  std::string name;
  std::string body;
  HydrostaticSpec still;
  std::string tips_of{};  ///< membrane near whose lowest and highest node errors count apart; empty: none
  bool operator==(const HydrostaticProbeSpec&) const = default;
};
/// Tension between two places of a membrane, the shorter way round if it is closed; columns tension_mean_N_m,
/// tension_max_N_m.
struct SpanProbeSpec {
  std::string name;
  std::string membrane;
  Point from, to;  ///< on the membrane as drawn [m]
  bool operator==(const SpanProbeSpec&) const = default;
};
/// Spread of the total vertical stress over the particles of a body; columns vertical_stress_p01_Pa (1 %), _p50_Pa,
/// _p99_Pa.
struct StressProbeSpec {
  std::string name;
  std::string body;
  bool operator==(const StressProbeSpec&) const = default;
};
/// Forces over a section x = position through a body and its membrane, consistent with the grid (2D): columns
/// soil_force_N_m (compression positive), membrane_force_N_m (tension positive), net_force_N_m, their difference.
struct SectionProbeSpec {
  std::string name;
  std::string body;
  double position = 0;  ///< [m]
  bool operator==(const SectionProbeSpec&) const = default;
};
/// Difference of a body from the exact solution that it follows.
struct ExactProbeSpec {
  std::string name;
  std::string body;
  bool operator==(const ExactProbeSpec&) const = default;
};
/// Shape, tension and pressure of a closed membrane full of fluid, beside those of the closed form (geotube.hpp).
struct GeotubeProbeSpec {
  std::string name;
  std::string membrane;
  std::string water;       ///< material of the water outside; empty: dry
  double water_level = 0;  ///< of that over the tube's lowest point [m]
  bool operator==(const GeotubeProbeSpec&) const = default;
};
struct ProbeSpec {
  std::variant<TracerSpec, HydrostaticProbeSpec, ExactProbeSpec, GeotubeProbeSpec, SectionProbeSpec, SpanProbeSpec,
               StressProbeSpec>
      probe;
  SourceRef at;
  bool operator==(const ProbeSpec&) const = default;
};

/// How a column of history.csv becomes one number.
enum class Reduction {
  last,
  min,
  max,
  mean,
  rms,
  percentile,
  period,
  first_time_below,
  rms_difference,
  r_squared,
  slope
};

/// A named result of the run: `reduce` applied to `column` over rows with from <= t <= to, times `scale`.
struct ResultSpec {
  std::string name;    ///< ends in its unit, e.g. fall_velocity_max_m_s
  std::string column;  ///< of history.csv
  Reduction reduce = Reduction::last;
  double from = 0;                                      ///< [s]
  double to = std::numeric_limits<double>::infinity();  ///< [s]; infinite: to the end of the run
  std::string after, before;                            ///< results, times that narrow the window; empty: none
  double scale = 1;
  double percentile = 0;       ///< [0..100], for Reduction::percentile
  double level = 0;            ///< for Reduction::first_time_below
  std::string against;         ///< other column, for r_squared
  std::vector<double> times;   ///< for rms_difference: compare at these times [s]
  std::vector<double> values;  ///< ... with these values
  SourceRef at;
  bool operator==(const ResultSpec&) const = default;
};
/// An expectation that a run prints beside its result; met if |value - expected| <= tolerance.
struct ExpectSpec {
  std::string result;
  double expected = 0;
  double tolerance = 0;
  std::string source;
  SourceRef at;
  bool operator==(const ExpectSpec&) const = default;
};

struct Scene {
  std::string file;  ///< path that it was read from
  std::string title;
  std::string question;  ///< what this case asks
  int dimension = 2;
  GridSpec grid;
  WallsSpec walls;
  Point gravity;  ///< [m/s2]
  SolverSpec solver;
  RelaxationSpec relaxation;
  TimeSpec time;
  std::vector<StageSpec> stages;
  OutputSpec output;
  std::vector<MaterialSpec> materials;
  std::vector<BodySpec> bodies;
  std::vector<MembraneSpec> membranes;
  std::vector<RigidSpec> rigid;
  std::vector<ContactSpec> contacts;
  std::vector<StillFluidSpec> still_fluids;
  std::vector<ViscousBoundarySpec> viscous_boundaries;
  std::vector<PumpSpec> pumps;
  std::vector<ExactSpec> exact;
  std::vector<ProbeSpec> probes;
  std::vector<ResultSpec> results;
  std::vector<ExpectSpec> expect;
  std::string as_run;  ///< the scene as TOML with overrides applied and all defaults filled in
  bool operator==(const Scene&) const = default;
};

/// Null if the scene has none of this name.
const MaterialSpec* find_material(const Scene& scene, const std::string& name);
const BodySpec* find_body(const Scene& scene, const std::string& name);
/// The exact solution that a body follows; null if it follows none.
const ExactSpec* find_exact(const Scene& scene, const std::string& body);

bool has_sharp_interface(const Scene& scene);

/// What the two names of a contact stand for.
struct ContactPair {
  enum class Kind { none, membrane_on_rigid, body_on_rigid, membranes } kind = Kind::none;
  std::string touching;  ///< the membrane or the body
  std::string other;     ///< what it touches; of own folds the same membrane
};
/// Kind::none if the two cannot touch, or one of them is not there.
ContactPair contact_pair(const Scene& scene, const ContactSpec& contact);

}  // namespace geodrop
