// What a scene measures: probes, results, expectations.
#pragma once

#include <geodrop/error.hpp>
#include <geodrop/scene/initial.hpp>
#include <geodrop/scene/shapes.hpp>

#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace geodrop {

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
/// How far a heap reaches to both sides, lone particles left out (2D); columns left_m, right_m.
struct FrontProbeSpec {
  std::string name;
  std::string body;
  double thickness = 0;  ///< that a heap has at its front [m]
  bool operator==(const FrontProbeSpec&) const = default;
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
/// Extremes over the particles of a body: columns volume_min_ratio, volume_max_ratio (of J), pressure_min_Pa,
/// pressure_max_Pa, tension_max_Pa (largest principal stress, in soil the effective one; negative under compression).
struct ExtremesProbeSpec {
  std::string name;
  std::string body;
  bool operator==(const ExtremesProbeSpec&) const = default;
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
               StressProbeSpec, FrontProbeSpec, ExtremesProbeSpec>
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

/// What an expected value is: a closed form, a published value or an independent computation; or a result of the code
/// itself, which can show that something has changed and no more.
enum class ReferenceKind { reference, regression };

/// What `geodrop verify` judges a scene by: a result beside its reference.
struct VerifySpec {
  std::string result;
  std::string over;     ///< another result that the value is divided by; empty: none
  std::string what;     ///< in words, with the unit of the error
  double expected = 0;  ///< in the unit of the result, or of the quotient
  ReferenceKind kind = ReferenceKind::reference;
  double scale = 0;         ///< the error is |value - expected| over this; 0: over |expected|
  double target = 0;        ///< largest error of the last variant of a full verification
  double quick_target = 0;  ///< of a quick one, which stops at a coarser grid; 0: the same
  double least_order = 0;   ///< of the error over all variants against the grid spacing; 0: none is asked for
  std::string source;
  std::string shortfall;  ///< why the target is known to be missed; empty: it is not
  double guard = 0;       ///< largest error that a known miss may have; 0 without a shortfall
  std::string loose;      ///< why the target is more than three times the error; empty: it is not
  SourceRef at;
  bool operator==(const VerifySpec&) const = default;
};
/// When `geodrop verify` runs a variant.
enum class VerifyMode { quick, full, both };

/// A run that `geodrop verify` makes of the scene.
struct VariantSpec {
  std::string name;
  std::vector<std::string> set;  ///< overrides, each as after --set
  VerifyMode in = VerifyMode::both;
  bool control = false;  ///< broken on purpose: has to miss a target
  std::vector<std::string>
      of;              ///< results whose targets a control has to miss, each; empty: that of the only [[verify]]
  std::string breaks;  ///< part of the message that a control has to break with; empty: it has to run to its end
  SourceRef at;
  bool operator==(const VariantSpec&) const = default;
};

}  // namespace geodrop
