// Joins the parts of the output room for the step loop.
#include <geodrop/base/error.hpp>
#include <geodrop/files/output.hpp>

#include "base/atomic_file.hpp"
#include "base/schedule.hpp"
#include "base/text.hpp"
#include "console.hpp"
#include "frame_writer.hpp"
#include "hash_file.hpp"
#include "history_file.hpp"
#include "measure/limit_warnings.hpp"
#include "measure/mach_numbers.hpp"
#include "measure/membrane_peaks.hpp"
#include "measure/probes/probes.hpp"
#include "run_directory.hpp"
#include "run_report.hpp"
#include "summary.hpp"
#include "take_over.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

namespace geodrop {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<std::string> names(const std::vector<MaterialSpec>& materials) {
  std::vector<std::string> list;
  for (const MaterialSpec& material : materials) list.push_back(material.name);
  return list;
}

/// The lines that a scene begins with to say what it is about; a report shows them.
std::string leading_comment(const std::string& toml) {
  std::size_t end = 0;
  while (end < toml.size() && toml[end] == '#') end = std::min(toml.find('\n', end), toml.size() - 1) + 1;
  return end > 0 && toml[end - 1] != '\n' ? "" : toml.substr(0, end);
}

LogMode log_mode(bool resume) { return resume ? LogMode::append : LogMode::begin; }

double end_of_run(const Scene& scene, const RunOptions& options) {
  return options.end > 0 ? std::min(options.end, scene.time.end) : scene.time.end;
}

}  // namespace

template <int Dim>
struct Output<Dim>::Parts {
  Parts(const Scene& scene_, const RunOptions& options_, const FaultOf<Dim>& fault_of)
      : scene(scene_),
        options(options_),
        directory(choose_directory(scene, options.directory)),
        place(take_place(scene, options, directory)),
        resumed(check_resume<Dim>(scene, options, directory, fault_of)),
        console(directory / "run.log", log_mode(options.resume), options.telling),
        progress(end_of_run(scene, options), 0),
        rows_due(scene.output.history_interval),
        frames_due(scene.output.frame_interval),
        checkpoints_due(scene.checkpoints.every),
        history{history_columns(scene), {}},
        frames(directory, scene.output.compress ? Compression::lz4 : Compression::none,
               resumed ? resumed->checkpoint.output.frame_times : std::vector<double>{}),
        checkpoints(directory) {
    identity.started = date_and_time();
    identity.host = host_name();
    identity.command = options.command;
    identity.threads = options.threads;
  }

  void begin(const State<Dim>& state) {
    identity.particles = state.particles();
    progress = Progress(end_of_run(scene, options), state.particles());
    progress.begin(state.t, state.step);
    checkpoints_due.pass(state.t);
    write_file_atomically(directory / "scene.toml", leading_comment(text_of_file(scene.file)) + scene.as_run);
    history_file.emplace(directory / "history.csv", history);
    hash_file.emplace(directory / hashes_name, history.rows.empty() ? -1.0 : history.rows.back().front());
    write_summary(state, RunStatistics{RunStatus::running, "", 0, 0, {}, {}}, {});
  }
  void write_summary(const State<Dim>& state, const RunStatistics& statistics, const Summary& summary) {
    identity.steps = state.step;
    identity.t = state.t;
    write_file_atomically(directory / "summary.json", summary_json(scene, identity, statistics, summary));
  }
  /// Room for a checkpoint, the frames that may wait to be written, and the end of log and history.
  void keep_room(const State<Dim>& state) {
    constexpr std::size_t waiting_frames = 3, ends_of_files = 1 << 18;
    checkpoints.keep_room(state, record(), waiting_frames * frames.frame_bytes() + ends_of_files);
  }
  OutputRecord record() const { return {frames.times(), history.rows}; }
  /// What the disk refuses while a run goes on is remembered, see the top of output.hpp.
  template <class Write>
  void attempt(const Write& write) {
    try {
      write();
    } catch (const WriteError& error) {
      if (refused.empty()) refused = error.what();
    }
  }
  void warn(const std::string& line) {
    warnings.push_back(line);
    console.print(line);
  }
  bool has_frame(double t) const { return !frames.times().empty() && frames.times().back() == t; }
  bool has_row(double t) const { return !history.rows.empty() && history.rows.back().front() == t; }

  const Scene& scene;
  RunOptions options;
  std::filesystem::path directory;
  RunPlace place;
  std::optional<FoundCheckpoint<Dim>> resumed;
  RunIdentity identity;
  Console console;
  Progress progress;
  Schedule rows_due, frames_due, checkpoints_due;
  Clock::time_point last_checkpoint = Clock::now();
  HistoryTable history;
  std::optional<HistoryFile> history_file;
  std::optional<HashFile> hash_file;
  FrameWriter frames;
  CheckpointFiles checkpoints;
  LimitWatch limits;
  std::vector<std::string> warnings;  ///< so far, as printed
  std::string refused;
};

template <int Dim>
Output<Dim>::Output(const Scene& scene, const RunOptions& options, const FaultOf<Dim>& fault_of)
    : parts_(std::make_unique<Parts>(scene, options, fault_of)) {
  log(describe_run(scene, options));
  if (!parts_->place.notice.empty()) log(parts_->place.notice);
  if (options.end > scene.time.end)
    parts_->warn("warning: --until " + format_number(options.end, time_digits) +
                 " is beyond time.end; the run ends at t = " + format_number(scene.time.end, time_digits) + " s");
}

template <int Dim>
Output<Dim>::~Output() = default;

template <int Dim>
const std::filesystem::path& Output<Dim>::directory() const {
  return parts_->directory;
}

template <int Dim>
State<Dim> Output<Dim>::resume() {
  Parts& parts = *parts_;
  FoundCheckpoint<Dim> found = std::move(parts.resumed.value());
  if (!found.warning.empty()) parts.warn(found.warning);
  if (!found.checkpoint.warning.empty()) parts.warn(found.checkpoint.warning);
  State<Dim>& state = found.checkpoint.state;
  parts.checkpoints.begin_with(found.name, state.t);
  cut_back_frames(directory(), parts.frames.times());
  parts.history.rows = std::move(found.checkpoint.output.rows);
  parts.rows_due.pass(state.t);
  parts.frames_due.pass(state.t);
  parts.begin(state);
  parts.attempt([&] { parts.keep_room(state); });
  log("resumed at t = " + format_number(state.t) + " s, step " + std::to_string(state.step));
  return std::move(state);
}

template <int Dim>
void Output<Dim>::start(Frame<Dim> frame) {
  parts_->begin(*frame);
  write_history(frame);
  write_frame(frame);
  parts_->attempt([&] { parts_->keep_room(*frame); });
}

template <int Dim>
bool Output<Dim>::history_due(double t) const {
  return parts_->rows_due.due(t);
}

template <int Dim>
bool Output<Dim>::frame_due(double t) const {
  return parts_->frames_due.due(t);
}

template <int Dim>
bool Output<Dim>::checkpoint_due(double t) const {
  const double interval = parts_->scene.checkpoints.interval;
  return parts_->checkpoints_due.due(t) ||
         (interval > 0 && std::chrono::duration<double>(Clock::now() - parts_->last_checkpoint).count() >= interval);
}

template <int Dim>
void Output<Dim>::write_history(Frame<Dim> frame) {
  parts_->history.rows.push_back(history_row(parts_->scene, *frame, parts_->history));
  parts_->history_file->append(parts_->history.rows.back());
  parts_->hash_file->append({frame->t, frame->step, state_hash(*frame)});
  parts_->rows_due.pass(frame->t);
  for (const std::string& warning : strength_warnings(parts_->scene, parts_->history)) parts_->warn(warning);
  for (const std::string& warning : parts_->limits.look(parts_->scene, *frame, parts_->history)) parts_->warn(warning);
}

template <int Dim>
void Output<Dim>::write_frame(Frame<Dim> frame) {
  Parts& parts = *parts_;
  Snapshot snapshot = take_snapshot(*frame, names(parts.scene.materials), parts.scene.output.fields);
  add_balance(parts.scene, *frame, snapshot);
  parts.frames.submit(std::move(snapshot));
  parts.frames_due.pass(frame->t);
  log(parts.progress.line(frame->t, frame->step) + "  frame " + std::to_string(parts.frames.times().size() - 1));
}

template <int Dim>
void Output<Dim>::checkpoint(Frame<Dim> frame) {
  Parts& parts = *parts_;
  parts.frames.wait();  // a checkpoint names only frames that are on disk
  if (parts.checkpoints.newest_time() != frame->t)
    parts.attempt([&] {
      parts.checkpoints.write(parts.scene, *frame, parts.record());
      if (!blocked()) parts.keep_room(*frame);
    });
  if (blocked()) write_pending();
  parts.checkpoints_due.pass(frame->t);
  parts.last_checkpoint = Clock::now();
}

/// The room that was kept free is for this: a checkpoint has its share already, or cannot be had.
template <int Dim>
void Output<Dim>::write_pending() {
  parts_->checkpoints.give_room_back();
  const std::size_t missing = parts_->frames.try_again();
  parts_->history_file->catch_up();
  parts_->hash_file->catch_up();
  if (missing > 0) log("warning: no room for all frames, missing: " + std::to_string(missing));
}

template <int Dim>
bool Output<Dim>::blocked() const {
  const Parts& parts = *parts_;
  return !parts.refused.empty() || parts.frames.failed() || !parts.console.failure().empty() ||
         (parts.history_file && !parts.history_file->failure().empty());
}

template <int Dim>
std::string Output<Dim>::trouble() const {
  if (parts_->frames.failed()) return parts_->frames.failure();
  if (parts_->history_file && !parts_->history_file->failure().empty()) return parts_->history_file->failure();
  return parts_->refused.empty() ? parts_->console.failure() : parts_->refused;
}

template <int Dim>
void Output<Dim>::progress(double t, std::uint64_t step) {
  if (parts_->console.is_terminal() && parts_->progress.due()) parts_->console.show(parts_->progress.line(t, step));
}

template <int Dim>
void Output<Dim>::warn(const std::string& line) {
  parts_->warn(line);
}

template <int Dim>
void Output<Dim>::log(const std::string& line) {
  parts_->console.print(line);
}

template <int Dim>
Summary Output<Dim>::finish(Frame<Dim> frame, const RunStatistics& of_step_loop) {
  Parts& parts = *parts_;
  RunStatistics statistics = of_step_loop;
  write_last(frame, statistics.status);
  for (const Fact& fact : membrane_peaks(parts.scene, parts.history)) statistics.facts.push_back(fact);
  for (const Fact& fact : mach_numbers(parts.scene, parts.history)) statistics.facts.push_back(fact);
  if (blocked() && statistics.status != RunStatus::failed) {
    statistics.status = RunStatus::blocked;
    statistics.message = trouble();
  }

  Summary summary;
  summary.warnings = parts.warnings;
  summary.state_hash = state_hash(*frame);
  summary.results = reduce_all(parts.scene, parts.history);
  if (statistics.status == RunStatus::done) {
    summary.expectations = compare(parts.scene, summary.results);
    parts.checkpoints.keep_newest_only();
  }
  for (const Expectation& expectation : summary.expectations) summary.expectations_met &= expectation.met;
  parts.identity.ended = date_and_time();
  parts.attempt([&] { parts.write_summary(*frame, statistics, summary); });
  print_end(frame, statistics, summary);
  return summary;
}

template <int Dim>
void Output<Dim>::write_last(Frame<Dim> frame, RunStatus status) {
  Parts& parts = *parts_;
  if (status == RunStatus::done && !parts.has_row(frame->t)) write_history(frame);
  if (!blocked() && !parts.has_frame(frame->t)) write_frame(frame);
  parts.frames.wait();
  const auto write_profile = [&](const auto& probe) {
    if constexpr (requires { probe.write_profile(parts.scene, *frame, directory()); })
      probe.write_profile(parts.scene, *frame, directory());
  };
  parts.attempt([&] {
    for (const ProbeSpec& spec : parts.scene.probes) std::visit(write_profile, spec.probe);
  });
}

template <int Dim>
void Output<Dim>::print_end(Frame<Dim> frame, const RunStatistics& statistics, const Summary& summary) {
  const std::size_t particles = parts_->identity.particles;
  log("");
  log(stage_table(statistics.stages, static_cast<double>(statistics.steps) * static_cast<double>(particles)));
  if (!statistics.facts.empty()) log(facts_text(statistics.facts));
  log(status_name(statistics.status) + " at t = " + format_number(frame->t, 6) + " s after " +
      std::to_string(frame->step) + " steps of " + std::to_string(particles) + " particles in " +
      format_duration(statistics.wall_seconds) + ", state " + summary.state_hash + ", files in " +
      directory().string());
  if (!statistics.message.empty()) log(statistics.message);
  if (statistics.status == RunStatus::blocked && !parts_->checkpoints.newest_time())
    log("no checkpoint could be written");
  const std::string how = how_to_go_on(statistics.status, parts_->checkpoints.newest_time());
  if (!how.empty()) log(how + parts_->options.resume_command);
  if (statistics.status == RunStatus::done && !summary.results.empty())
    log("\n" + results_table(summary.results, summary.expectations));
}

template class Output<2>;
template class Output<3>;

}  // namespace geodrop
