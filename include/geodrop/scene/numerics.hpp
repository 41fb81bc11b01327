// Grid, time integration, stages in time and output.
#pragma once

#include <geodrop/base/error.hpp>
#include <geodrop/geometry/shape.hpp>

#include <string>
#include <vector>

namespace geodrop {

enum class Basis { bspline2, gimp, linear, tri3, tet4 };
inline bool is_simplex(Basis basis) { return basis == Basis::tri3 || basis == Basis::tet4; }
enum class WallKind { slip, no_slip, periodic };
enum class Transfer { tpic, blend, musl };
/// What gravity pulls at where fluid fills all cells around a node: the particles there, or the volume of the cells.
enum class Weight { particle, cell };
/// Two terms of the series for the inverse of the consistent one: see grid/mass_correction and cut/mass_at_membranes.
enum class MassMatrix { lumped, consistent, consistent_at_membranes };

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
  Weight weight = Weight::particle;
  bool even_out_volumes = false;  ///< of the fluids' particles in a cell, see step/step; always beside sharp membranes
  bool operator==(const SolverSpec&) const = default;
};
/// How a run comes to rest: kinetic damping until both ratios are met, see step/relaxation.
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
  double frame_interval = 0;        ///< time between VTU frames [s]
  double history_interval = 0;      ///< time between rows of history.csv [s]
  bool compress = false;            ///< zlib in VTU files
  std::vector<std::string> fields;  ///< of particles in VTU files; empty: all
  bool operator==(const OutputSpec&) const = default;
};
/// When a run keeps what a later one can go on from.
struct CheckpointSpec {
  double interval = 0;  ///< wall time between checkpoints [s]; 0: none by wall time
  double every = 0;     ///< simulated time between checkpoints [s]; 0: none by simulated time
  bool operator==(const CheckpointSpec&) const = default;
};

}  // namespace geodrop
