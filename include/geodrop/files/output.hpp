// Everything that a run leaves behind: its directory, frames, history, checkpoints, log, progress, summary.
//
// How the step loop uses it:
//
//     Output<Dim> output(scene, options);                     // makes or takes over the run directory
//     if (options.resume) state = output.resume();            // else: output.start(Frame(state)) writes frame and row
//     while (state.t < end && !stop_requested() && !output.blocked()) {
//       advance(...);
//       if (output.history_due(state.t)) { output.write_history(Frame(state)); reset tension peaks }
//       if (output.frame_due(state.t)) output.write_frame(Frame(state));
//       if (output.checkpoint_due(state.t)) output.checkpoint(Frame(state));
//       output.progress(state.t, state.step);
//     }
//     not failed: output.checkpoint(Frame(state));
//     Summary summary = output.finish(Frame(state), statistics);
//
// What the disk does not take once a run has begun throws nothing, since the state would be left between two outputs:
// it is kept in memory, `blocked` says so, and the step loop ends at the end of its step.
#pragma once

#include <cstdint>
#include <filesystem>
#include <geodrop/files/checkpoint.hpp>
#include <geodrop/measure/measure.hpp>
#include <geodrop/measure/results.hpp>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace geodrop {

/// Exit code of a run that was stopped and can be resumed.
inline constexpr int exit_stopped = 75;

/// Exit code of a run (or another command) whose files the disk does not take.
inline constexpr int exit_not_written = 74;

/// What becomes of the files of an earlier run in the same directory: the whole directory is renamed, or they go.
enum class EarlierRun { move_aside, overwrite };

/// Where a run tells of itself: run.log always.
enum class Telling { terminal, log_only };

/// Steps first to last, counted from 0.
struct StepWindow {
  std::uint64_t first = 0, last = 0;
};

struct RunOptions {
  std::filesystem::path directory;  ///< empty: `runs/NAME`, NAME that of the scene file
  int threads = 1;
  bool fewer_threads = false;  ///< takes fewer where they are faster
  bool resume = false;
  double end = 0;  ///< simulated time at which the run ends, for the progress line [s]; 0: the scene's
  EarlierRun earlier = EarlierRun::move_aside;
  std::string command;         ///< as it was typed, for the summary
  std::string resume_command;  ///< how to go on, shown when the run was stopped
  Telling telling = Telling::terminal;
  std::optional<StepWindow> parts;  ///< of which a hash after each stage is written to parts.csv
};

/// How a run ended. A run that was killed is `running` for ever in its summary. `blocked`: the disk did not take a
/// file; it can go on as one that was stopped.
enum class RunStatus { running, done, stopped, blocked, failed };

/// Wall time of one stage of the step.
struct StageTime {
  std::string name;
  double seconds = 0;
};

/// What only the step loop knows about a run.
struct RunStatistics {
  RunStatus status = RunStatus::done;
  std::string message;      ///< of the error, if status is failed or blocked
  double wall_seconds = 0;  ///< of the step loop in this process, output included
  std::uint64_t steps = 0;  ///< in this process
  std::vector<StageTime> stages;
  std::vector<Fact> facts;
};

struct Summary {
  std::vector<Result> results;
  std::vector<Expectation> expectations;  ///< of a run that is done; others are not judged
  std::vector<std::string> warnings;      ///< of this process, as in the log
  std::string state_hash;
  bool expectations_met = true;
};

/// Aligned table of stages: seconds, percent of their sum, ns per particle and step.
std::string stage_table(const std::vector<StageTime>& stages, double particle_steps);

template <int Dim>
class Output {
 public:
  /// Keeps a reference to the scene. Throws SceneError if a result names no column, if the directory holds other things
  /// than an earlier run, if another run is at work there, or, with `resume`, there is no good checkpoint, the run is
  /// finished, or the checkpoint is not before the time `end`. Nothing was written then. Throws WriteError if the disk
  /// refuses. A checkpoint in whose state `fault_of` finds a fault is not good.
  Output(const Scene& scene, const RunOptions& options, const FaultOf<Dim>& fault_of = {});
  ~Output();

  const std::filesystem::path& directory() const;
  /// State of the newest good checkpoint; frames, their collections and rows are cut back to it.
  State<Dim> resume();
  /// Writes frame 0 and row 0.
  void start(Frame<Dim> frame);

  /// True at the first time at or after each multiple of the interval; never changes a time step.
  bool history_due(double t) const;
  bool frame_due(double t) const;
  /// Adds a row; the peak of the membranes' gauges counts from the row before, so restart it afterwards.
  void write_history(Frame<Dim> frame);
  /// Copies the frame and hands it to the writer thread; waits if two are queued.
  void write_frame(Frame<Dim> frame);
  /// True when an interval of wall time or of simulated time has passed since the last one.
  bool checkpoint_due(double t) const;
  /// Waits until the frames so far are on disk, then writes checkpoint.bin and keeps the one before. Makes no frame and
  /// no row: a resumed run leaves those of an uninterrupted one.
  void checkpoint(Frame<Dim> frame);
  /// Whether the disk did not take something; cheap enough for every step.
  bool blocked() const;
  /// What it did not take first, and why.
  std::string trouble() const;
  /// To be called after every step: on a terminal renews the progress line a few times a second.
  void progress(double t, std::uint64_t step);
  /// A line for run.log and the terminal.
  void log(const std::string& line);
  /// Likewise, and for summary.json.
  void warn(const std::string& line);

  /// Writes the last frame and row (no row when stopped), which a resumed run takes back, waits for the writer, prints
  /// the tables, writes summary.json. A run that reached the end of its scene keeps its last checkpoint only.
  Summary finish(Frame<Dim> frame, const RunStatistics& statistics);

 private:
  void write_last(Frame<Dim> frame, RunStatus status);
  void write_pending();
  void print_end(Frame<Dim> frame, const RunStatistics& statistics, const Summary& summary);

  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace geodrop
