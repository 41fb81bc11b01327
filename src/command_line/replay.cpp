#include "replay.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/files/checkpoint.hpp>
#include <geodrop/reader/scene_reader.hpp>
#include <geodrop/step/pipeline.hpp>

#include "base/text.hpp"
#include "files/build_identity.hpp"
#include "files/hash_file.hpp"
#include "membrane/tension_gauge.hpp"
#include "step/initial_state.hpp"
#include "step/parts.hpp"

#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>
#include <vector>

namespace geodrop {
namespace {

namespace fs = std::filesystem;

/// What a run recorded.
struct Recorded {
  std::vector<HashRow> rows;
  std::vector<PartHash> parts;
};

struct PartDifference {
  PartHash recorded, now;
};

/// Compares the stages of the recorded steps as they run again.
class PartComparison {
 public:
  explicit PartComparison(const std::vector<PartHash>& recorded) : recorded_(recorded) {}

  StepWindow window() const { return {recorded_.front().step, recorded_.back().step}; }
  void take(const PartHash& now) {
    if (first_ || next_ == recorded_.size()) return;
    if (recorded_[next_] != now) first_ = PartDifference{recorded_[next_], now};
    ++next_;
  }
  const std::optional<PartDifference>& first() const { return first_; }

 private:
  const std::vector<PartHash>& recorded_;
  std::size_t next_ = 0;
  std::optional<PartDifference> first_;
};

/// How far a replay came: all rows before `equal` have the recorded hashes.
struct Replay {
  std::size_t equal = 0;
  HashRow now;         ///< at the first row that differs
  std::string broken;  ///< why it did not come to that row
  std::optional<PartDifference> part;
};

/// As the step loop of a run, output left out; the membranes' peaks count from row to row there.
template <int Dim>
HashRow step_to(const HashRow& row, Pipeline<Dim>& pipeline, State<Dim>& state, Grids<Dim>& grids) {
  if (state.step > 0)
    for (Membrane<Dim>& membrane : state.membranes) restart_peak(membrane.gauge);
  while (state.step < row.step) advance(pipeline, state, grids);
  return {state.t, state.step, state_hash(state)};
}

template <int Dim>
Replay replay(const Scene& scene, const Recorded& recorded) {
  State<Dim> state = initial_state<Dim>(scene);
  Grids<Dim> grids = make_grids<Dim>(scene);
  Pipeline<Dim> pipeline = build_pipeline<Dim>(scene);
  PartComparison parts(recorded.parts);
  if (!recorded.parts.empty())
    watch_parts<Dim>(
        parts.window(), [&](const PartHash& part) { parts.take(part); }, pipeline);
  Replay result;
  try {
    for (const HashRow& row : recorded.rows) {
      result.now = step_to(row, pipeline, state, grids);
      if (result.now.hash != row.hash) break;
      ++result.equal;
    }
  } catch (const RunError& error) {
    result.broken = error.what();
  }
  result.part = parts.first();
  return result;
}

std::string place(const HashRow& row) {
  return "t = " + format_number(row.t) + " s (step " + std::to_string(row.step) + ")";
}

void tell_part(const Replay& result, const Recorded& recorded) {
  const std::uint64_t to = recorded.rows[result.equal].step;
  const std::uint64_t from = result.equal == 0 ? 0 : recorded.rows[result.equal - 1].step;
  if (result.part)
    std::cout << "first in step " << result.part->recorded.step << ", after the stage " << result.part->recorded.stage
              << ": " << result.part->recorded.hash << " recorded, " << result.part->now.hash << " now\n";
  else if (to > from)
    std::cout << "to see in which stage, add --record-parts " << from << ":" << to - 1
              << " to the recorded run and replay that one\n";
}

void tell_difference(const Replay& result, const Recorded& recorded) {
  const HashRow& row = recorded.rows[result.equal];
  if (result.equal == 0)
    std::cout << "differs from the start, " << place(row);
  else
    std::cout << "differs first between " << place(recorded.rows[result.equal - 1]) << " and " << place(row);
  if (result.broken.empty())
    std::cout << ": " << row.hash << " recorded, " << result.now.hash << " now\n";
  else
    std::cout << ", where it breaks now: " << result.broken << '\n';
  tell_part(result, recorded);
  const BuildIdentity now = this_build();
  std::cout << "now: geodrop " << now.version << ", compiler " << now.compiler << ", sums " << now.sums << '\n';
}

Recorded read_recorded(const fs::path& run) {
  Recorded recorded{read_hashes(run / hashes_name), read_parts(run / parts_name)};
  if (recorded.rows.empty() || !fs::exists(run / "scene.toml"))
    throw SceneError(run.string(), {{{},
                                     "replay",
                                     "no recorded run",
                                     std::string("the directory of a run, with scene.toml and ") + hashes_name,
                                     ProblemSource::elsewhere}});
  return recorded;
}

}  // namespace

void add_replay_options(CLI::App& command, ReplayArguments& arguments) {
  command.add_option("run", arguments.run, "run directory")->required();
}

int run_replay(const ReplayArguments& arguments) {
  const fs::path run = arguments.run;
  const Recorded recorded = read_recorded(run);
  const Scene scene = read_scene((run / "scene.toml").string());
  const Replay result = scene.dimension == 2 ? replay<2>(scene, recorded) : replay<3>(scene, recorded);
  if (result.equal < recorded.rows.size()) {
    tell_difference(result, recorded);
    return 1;
  }
  std::cout << "the same states: " << result.equal << " hashes, to " << place(recorded.rows.back()) << '\n';
  return 0;
}

}  // namespace geodrop
