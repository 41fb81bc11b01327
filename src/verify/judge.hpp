// From the runs of a scene to rows: errors against the reference, their order, met or not.
#pragma once

#include <geodrop/output.hpp>
#include <geodrop/scene.hpp>

#include <string>
#include <vector>

namespace geodrop {

/// A run of a scene, and what it cost.
struct VariantRun {
  std::string name;
  bool control = false;  ///< broken on purpose
  double spacing = 0;    ///< of the finest cells [m]
  double particles = 0, steps = 0;
  double wall_seconds = 0;
  double bytes = 0;  ///< of all particles
  RunStatus status = RunStatus::done;
  std::vector<Result> results;
  std::string state_hash;

  double particle_steps() const { return particles * steps; }
  /// Million particle-steps per second.
  double mpps() const { return particle_steps() / wall_seconds * 1e-6; }
};

/// `known` is a miss that the scene gives a reason for.
enum class Verdict { met, missed, known };

/// One measure of a scene over its runs, or a control.
struct VerifyRow {
  std::string scene;               ///< its file's name without ending
  std::string what, result, unit;  ///< of a control, `what` is its name
  double expected = 0;
  double target = 0, least_order = 0;
  std::string source, shortfall;
  std::vector<const VariantRun*> runs;  ///< that the errors are of
  std::vector<double> values, errors;   ///< NaN where a run broke
  double order = 0;                     ///< NaN if the runs do not differ in spacing
  bool control = false;
  Verdict verdict = Verdict::missed;
};

/// |value - expected| over the scale; NaN of a run that broke.
double error_of(const VerifySpec& spec, const VariantRun& run);

/// Slope of ln error over ln spacing, least squares; NaN unless there are two spacings with errors > 0.
double observed_order(const std::vector<double>& spacings, const std::vector<double>& errors);

/// A row for each [[verify]], by its target of the mode, then one for each control, which is met if one of the targets
/// is missed by it (also by breaking). The rows point into `runs`.
std::vector<VerifyRow> judge(const Scene& scene, const std::vector<VariantRun>& runs, VerifyMode mode);

/// "yes", "NO", "no, known".
std::string word_of(Verdict verdict);

}  // namespace geodrop
