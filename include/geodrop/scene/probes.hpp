// Probes of a scene. Only what reads or measures them includes this: a new probe is not to recompile the rest.
#pragma once

#include <geodrop/error.hpp>
#include <geodrop/scene/initial.hpp>
#include <geodrop/scene/shapes.hpp>

#include <string>
#include <variant>

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

}  // namespace geodrop
