// From the runs of a scene to rows: errors against the reference, their order, met or not.
#pragma once

#include <geodrop/files/output.hpp>
#include <geodrop/scene/scene.hpp>

#include <string>
#include <vector>

namespace geodrop {

/// A run of a scene, and what it cost.
struct VariantRun {
  std::string name;
  bool control = false;         ///< broken on purpose
  std::vector<std::string> of;  ///< results whose targets a control has to miss; empty: that of the only [[verify]]
  std::string breaks;           ///< what a control has to break with; empty: it has to run to its end
  double spacing = 0;           ///< of the finest cells [m]
  double particles = 0, steps = 0;
  double wall_seconds = 0;
  double bytes = 0;  ///< of all particles
  RunStatus status = RunStatus::done;
  std::string message;  ///< of a run that broke
  std::vector<Result> results;
  std::string state_hash;

  double particle_steps() const { return particles * steps; }
  /// Million particle-steps per second.
  double mpps() const { return particle_steps() / wall_seconds * 1e-6; }
};

/// `coarse`: only a quick target that is looser than the target is met. `guarded`: a miss that the scene gives a reason
/// for, which is not above its guard. Only `missed` makes the command fail.
enum class Verdict { met, coarse, guarded, missed };

/// One measure of a scene over its runs, or a control beside one of its measures.
struct VerifyRow {
  std::string scene;               ///< its file's name without ending
  std::string what, result, unit;  ///< of a control, `what` is its name
  double expected = 0;
  ReferenceKind kind = ReferenceKind::reference;
  double target = 0;  ///< of a full verification
  double bar = 0;     ///< what the last error is held to: the target, the quick target or the guard of a known miss
  double least_order = 0;     ///< 0: none is asked for
  bool judges_order = false;  ///< not by quick runs of one spacing
  std::string source, shortfall, loose;
  std::vector<const VariantRun*> runs;  ///< that the errors are of
  std::vector<double> values, errors;   ///< NaN where a run broke
  double order = 0;                     ///< NaN if the runs do not differ in spacing
  bool control = false;
  std::string misses;       ///< of a control: the measure whose target it has to miss
  bool controlled = false;  ///< one of the controls belongs to this measure
  Verdict verdict = Verdict::missed;

  /// A control that has to break.
  bool judged_by_break() const { return control && !runs.back()->breaks.empty(); }
};

/// |value - expected| over the scale; NaN of a run that broke.
double error_of(const VerifySpec& spec, const VariantRun& run);

/// Slope of ln error over ln spacing, least squares; NaN unless there are two spacings with errors > 0.
double observed_order(const std::vector<double>& spacings, const std::vector<double>& errors);

/// A row for each [[verify]], then one for each target that a control has to miss: met if the control misses that very
/// target, or breaks with the message that the scene foretells. The rows point into `runs`.
std::vector<VerifyRow> judge(const Scene& scene, const std::vector<VariantRun>& runs, VerifyMode mode);

/// What the last error is held to over that error: how much worse the row could get unseen. Infinite if the error is 0,
/// NaN of a control and of a run that broke.
double slack(const VerifyRow& row);

/// The most that a target is over the error that is measured, if the scene does not say why.
inline constexpr double most_slack = 3;
/// slack > most_slack, rounding of both apart.
bool is_loose(const VerifyRow& row);

/// "yes", "coarse", "known, guarded", "NO".
std::string word_of(Verdict verdict);

}  // namespace geodrop
