// Everything that a run leaves behind: its directory, frames, history, checkpoint, log, progress, summary.
//
// How the step loop uses it:
//
//     Output<Dim> output(scene, options);                     // makes or takes over the run directory
//     if (options.resume) state = output.resume();            // else: output.start(Frame(state)) writes frame and row
//     0 while (state.t < end && !stop_requested()) {
//       advance(...);
//       if (output.history_due(state.t)) { output.write_history(Frame(state)); reset tension peaks }
//       if (output.frame_due(state.t)) output.write_frame(Frame(state));
//       output.progress(state.t, state.step);
//     }
//     stopped: output.checkpoint(Frame(state));               // writes a frame, too
//     Summary summary = output.finish(Frame(state), statistics);
#pragma once

#include <cstdint>
#include <filesystem>
#include <geodrop/results.hpp>
#include <geodrop/scene.hpp>
#include <geodrop/state.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace geodrop {

/// Exit code of a run that was stopped and can be resumed.
inline constexpr int exit_stopped = 75;

/// Where a run tells of itself: run.log always.
enum class Telling { terminal, log_only };

/// Steps first to last, counted from 0.
struct StepWindow {
  std::uint64_t first = 0, last = 0;
};

struct RunOptions {
  std::filesystem::path directory;  ///< empty: runs/<name of the scene file>
  int threads = 1;
  bool resume = false;
  double end = 0;              ///< simulated time at which the run ends, for the progress line [s]; 0: the scene's
  std::string resume_command;  ///< how to go on, shown when the run was stopped
  Telling telling = Telling::terminal;
  std::optional<StepWindow> parts;  ///< of which a hash after each stage is written to parts.csv
};

/// How a run ended.
enum class RunStatus { done, stopped, failed };

/// Wall time of one stage of the step.
struct StageTime {
  std::string name;
  double seconds = 0;
};

/// A number worth knowing that is no result of the history: "bed.skempton_b", "density_rise_ratio", ...
struct Fact {
  std::string name;  ///< ends in its unit
  double value = 0;
};

/// What only the step loop knows about a run.
struct RunStatistics {
  RunStatus status = RunStatus::done;
  std::string message;      ///< of the error, if status is failed
  double wall_seconds = 0;  ///< of the step loop in this process, output included
  std::uint64_t steps = 0;  ///< in this process
  std::vector<StageTime> stages;
  std::vector<Fact> facts;
};

struct Summary {
  std::vector<Result> results;
  std::vector<Expectation> expectations;
  std::string state_hash;
  bool expectations_met = true;
};

/// Aligned table of stages: seconds, percent of their sum, ns per particle and step.
std::string stage_table(const std::vector<StageTime>& stages, double particle_steps);

template <int Dim>
class Output {
 public:
  /// Keeps a reference to the scene. Throws SceneError if a result names no column, if the directory holds other things
  /// than an earlier run, or, with `resume`, no checkpoint (a finished run has none) or one that is not before the time
  /// `end`. Nothing was written then. An earlier run's files are
  /// replaced; says so in the log.
  Output(const Scene& scene, const RunOptions& options);
  ~Output();

  const std::filesystem::path& directory() const;
  /// State of the checkpoint; the record of frames and rows is cut back to it.
  State<Dim> resume();
  /// Writes frame 0 and row 0.
  void start(Frame<Dim> frame);

  /// True at the first time at or after each multiple of the interval; never changes a time step.
  bool history_due(double t) const;
  bool frame_due(double t) const;
  /// Adds a row; `tension_peak` of the membranes counts from the row before, so reset it to zero afterwards.
  void write_history(Frame<Dim> frame);
  /// Copies the frame and hands it to the writer thread; waits if two are queued. Throws RunError if an earlier frame
  /// could not be written.
  void write_frame(Frame<Dim> frame);
  /// Writes a frame (unless this time has one) and checkpoint.bin.
  void checkpoint(Frame<Dim> frame);
  /// To be called after every step: on a terminal renews the progress line a few times a second.
  void progress(double t, std::uint64_t step);
  /// A line for run.log and the terminal.
  void log(const std::string& line);

  /// Writes the last frame and row (no row when stopped: a resumed run then has the rows of an uninterrupted one),
  /// waits for the writer, prints the tables, writes summary.json. Removes the checkpoint if the run reached the end of
  /// its scene.
  Summary finish(Frame<Dim> frame, const RunStatistics& statistics);

 private:
  void write_last_frame(Frame<Dim> frame, RunStatus status);
  void print_end(Frame<Dim> frame, const RunStatistics& statistics, const Summary& summary);

  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace geodrop
