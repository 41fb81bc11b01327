// Joins the parts of the output room for the step loop.
#include <geodrop/checkpoint.hpp>
#include <geodrop/error.hpp>
#include <geodrop/output.hpp>
#include <geodrop/pipeline.hpp>
#include <geodrop/scene_reader.hpp>
#include <geodrop/version.hpp>

#include "atomic_file.hpp"
#include "console.hpp"
#include "frame_writer.hpp"
#include "geotube_probe.hpp"
#include "hash_file.hpp"
#include "mach_numbers.hpp"
#include "membrane_peaks.hpp"
#include "run_directory.hpp"
#include "summary.hpp"
#include "text.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <thread>
#include <utility>

namespace geodrop {
namespace {

constexpr const char* checkpoint_name = "checkpoint.bin";
constexpr int time_digits = 6;

/// The multiples of an interval, each of which is due once: at the first time at or after it.
class Schedule {
 public:
  explicit Schedule(double interval) : interval_(interval) {}
  bool due(double t) const { return interval_ > 0 && t >= (next_ - rounding) * interval_; }
  void pass(double t) {
    if (interval_ <= 0) return;
    next_ = std::max(next_, std::floor(t / interval_));
    while (due(t)) ++next_;
  }

 private:
  static constexpr double rounding = 1e-9;  ///< 6 times 0.1 is more than 0.6
  double interval_;
  double next_ = 0;  ///< a whole number
};

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

std::string describe_run(const Scene& scene, const RunOptions& options) {
  return std::string("geodrop ") + GEODROP_VERSION + " on " + host_name() + ", " + std::to_string(options.threads) +
         " of " + std::to_string(std::thread::hardware_concurrency()) + " threads, scene " + scene.file;
}

std::string facts_text(const std::vector<Fact>& facts) {
  std::vector<std::vector<std::string>> lines;
  for (const Fact& fact : facts) lines.push_back({fact.name, format_number(fact.value, 6), unit_of_name(fact.name)});
  return format_table(lines, "lrl");
}

std::vector<std::string> names(const std::vector<MaterialSpec>& materials) {
  std::vector<std::string> list;
  for (const MaterialSpec& material : materials) list.push_back(material.name);
  return list;
}

LogMode log_mode(bool resume) { return resume ? LogMode::append : LogMode::begin; }

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& option, const std::string& found,
                         const std::string& allowed) {
  throw SceneError(path.string(), {{{}, option, found, allowed, ProblemSource::elsewhere}});
}

template <int Dim>
Checkpoint<Dim> check_resume(const Scene& scene, const RunOptions& options, const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / checkpoint_name;
  if (const auto t = done_at(directory); t && !std::filesystem::exists(path))
    refuse(directory, "--resume", "a run that is finished (t = " + format_number(*t, time_digits) + " s)",
           "a run that was stopped with a checkpoint");
  Checkpoint<Dim> checkpoint = read_checkpoint<Dim>(path, scene);
  if (const double t = checkpoint.state.t; options.end > 0 && options.end <= t)
    refuse(path, "--until", format_number(options.end, time_digits),
           "a time after the checkpoint's, " + format_number(t, time_digits) + " s");
  return checkpoint;
}

/// All that can refuse a run, before anything is written.
template <int Dim>
std::optional<Checkpoint<Dim>> check_run(const Scene& scene, const RunOptions& options,
                                         const std::filesystem::path& directory) {
  check_results(scene);
  if (options.resume) return check_resume<Dim>(scene, options, directory);
  check_replaceable(directory);
  return std::nullopt;
}

double end_of_run(const Scene& scene, const RunOptions& options) {
  return options.end > 0 ? std::min(options.end, scene.time.end) : scene.time.end;
}

}  // namespace

template <int Dim>
struct Output<Dim>::Parts {
  Parts(const Scene& scene_, const RunOptions& options_)
      : scene(scene_),
        options(options_),
        directory(choose_directory(scene, options.directory)),
        resumed(check_run<Dim>(scene, options, directory)),
        replaced(options.resume ? 0 : prepare_directory(directory)),
        console(directory / "run.log", log_mode(options.resume), options.telling),
        progress(end_of_run(scene, options), 0),
        rows_due(scene.output.history_interval),
        frames_due(scene.output.frame_interval),
        history{history_columns(scene), {}},
        frames(directory, scene.output.compress ? Compression::zlib : Compression::none,
               resumed ? resumed->output.frame_times : std::vector<double>{}) {}

  void begin(const State<Dim>& state) {
    particles = state.particles();
    progress = Progress(end_of_run(scene, options), particles);
    progress.begin(state.t, state.step);
    for (const double t : frames.times()) frames_due.pass(t);
    for (const std::vector<double>& row : history.rows) rows_due.pass(row.front());
    history_file.emplace(directory / "history.csv", history);
    hash_file.emplace(directory / hashes_name, history.rows.empty() ? -1.0 : history.rows.back().front());
  }
  bool has_frame(double t) const { return !frames.times().empty() && frames.times().back() == t; }
  bool has_row(double t) const { return !history.rows.empty() && history.rows.back().front() == t; }

  const Scene& scene;
  RunOptions options;
  std::filesystem::path directory;
  std::optional<Checkpoint<Dim>> resumed;
  std::size_t replaced;  ///< files of an earlier run
  Console console;
  Progress progress;
  Schedule rows_due, frames_due;
  HistoryTable history;
  std::optional<HistoryFile> history_file;
  std::optional<HashFile> hash_file;
  FrameWriter frames;
  std::size_t particles = 0;
};

template <int Dim>
Output<Dim>::Output(const Scene& scene, const RunOptions& options) : parts_(std::make_unique<Parts>(scene, options)) {
  parts_->console.print(describe_run(scene, options));
  if (parts_->replaced > 0)
    parts_->console.print("replaced an earlier run in " + directory().string() + " (" +
                          std::to_string(parts_->replaced) + " files)");
  if (options.end > scene.time.end)
    parts_->console.print("warning: --until " + format_number(options.end, time_digits) +
                          " is beyond time.end; the run ends at t = " + format_number(scene.time.end, time_digits) +
                          " s");
  if (!options.resume) write_file_atomically(directory() / "scene.toml", scene.as_run);
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
  Checkpoint<Dim> checkpoint = std::move(parts.resumed.value());
  remove_frames(directory(), checkpoint.output.frame_times.size());
  parts.history.rows = std::move(checkpoint.output.rows);
  parts.begin(checkpoint.state);
  log("resumed at t = " + format_number(checkpoint.state.t) + " s, step " + std::to_string(checkpoint.state.step));
  return std::move(checkpoint.state);
}

template <int Dim>
void Output<Dim>::start(Frame<Dim> frame) {
  parts_->begin(*frame);
  write_history(frame);
  write_frame(frame);
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
void Output<Dim>::write_history(Frame<Dim> frame) {
  parts_->history.rows.push_back(history_row(parts_->scene, *frame, parts_->history));
  parts_->history_file->append(parts_->history.rows.back());
  parts_->hash_file->append({frame->t, frame->step, state_hash(*frame)});
  parts_->rows_due.pass(frame->t);
  for (const std::string& warning : strength_warnings(parts_->scene, parts_->history)) log(warning);
}

template <int Dim>
void Output<Dim>::write_frame(Frame<Dim> frame) {
  Parts& parts = *parts_;
  parts.frames.submit(take_snapshot(*frame, names(parts.scene.materials)));
  parts.frames_due.pass(frame->t);
  log(parts.progress.line(frame->t, frame->step) + "  frame " + std::to_string(parts.frames.times().size() - 1));
}

template <int Dim>
void Output<Dim>::checkpoint(Frame<Dim> frame) {
  Parts& parts = *parts_;
  if (!parts.has_frame(frame->t)) write_frame(frame);
  parts.frames.wait();  // a checkpoint names only frames that are on disk
  write_checkpoint(directory() / checkpoint_name, parts.scene, *frame, {parts.frames.times(), parts.history.rows});
}

template <int Dim>
void Output<Dim>::progress(double t, std::uint64_t step) {
  if (parts_->console.is_terminal() && parts_->progress.due()) parts_->console.show(parts_->progress.line(t, step));
}

template <int Dim>
void Output<Dim>::log(const std::string& line) {
  parts_->console.print(line);
}

template <int Dim>
Summary Output<Dim>::finish(Frame<Dim> frame, const RunStatistics& of_step_loop) {
  Parts& parts = *parts_;
  RunStatistics statistics = of_step_loop;
  if (statistics.status == RunStatus::done && !parts.has_row(frame->t)) write_history(frame);
  write_last_frame(frame, statistics.status);
  if constexpr (Dim == 2)
    for (const ProbeSpec& spec : parts.scene.probes)
      if (const auto* probe = std::get_if<GeotubeProbeSpec>(&spec.probe))
        write_geotube_profile(parts.scene, *probe, *frame, directory());
  for (const Fact& fact : membrane_peaks(parts.scene, parts.history)) statistics.facts.push_back(fact);
  for (const Fact& fact : mach_numbers(parts.scene, parts.history)) statistics.facts.push_back(fact);

  Summary summary;
  summary.state_hash = state_hash(*frame);
  summary.results = reduce_all(parts.scene, parts.history);
  summary.expectations = compare(parts.scene, summary.results);
  for (const Expectation& expectation : summary.expectations) summary.expectations_met &= expectation.met;
  const RunIdentity run{parts.options.threads, frame->step, frame->t, parts.particles};
  write_file_atomically(directory() / "summary.json", summary_json(parts.scene, run, statistics, summary));
  // What a finished run was resumed from is of no use any more: it would only repeat the same end.
  if (statistics.status == RunStatus::done && is_over(parts.scene, *frame))
    std::filesystem::remove(directory() / checkpoint_name);
  print_end(frame, statistics, summary);
  return summary;
}

template <int Dim>
void Output<Dim>::write_last_frame(Frame<Dim> frame, RunStatus status) {
  try {
    if (!parts_->has_frame(frame->t)) write_frame(frame);
    parts_->frames.wait();
  } catch (const RunError& error) {
    // A run may have failed because frames cannot be written: the first reason is the one to tell.
    if (status != RunStatus::failed) throw;
    log(error.what());
  }
}

template <int Dim>
void Output<Dim>::print_end(Frame<Dim> frame, const RunStatistics& statistics, const Summary& summary) {
  const double particle_steps = static_cast<double>(statistics.steps) * static_cast<double>(parts_->particles);
  log("");
  log(stage_table(statistics.stages, particle_steps));
  if (!statistics.facts.empty()) log(facts_text(statistics.facts));
  log(status_name(statistics.status) + " at t = " + format_number(frame->t, 6) + " s after " +
      std::to_string(frame->step) + " steps of " + std::to_string(parts_->particles) + " particles in " +
      format_duration(statistics.wall_seconds) + ", state " + summary.state_hash + ", files in " +
      directory().string());
  if (!statistics.message.empty()) log(statistics.message);
  if (statistics.status == RunStatus::stopped) log("go on with: " + parts_->options.resume_command);
  if (statistics.status == RunStatus::done && !summary.results.empty())
    log("\n" + results_table(summary.results, summary.expectations));
}

template class Output<2>;
template class Output<3>;

}  // namespace geodrop
