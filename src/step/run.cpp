// The loop over steps, and what surrounds it.
#include <geodrop/base/error.hpp>
#include <geodrop/base/stop_signal.hpp>
#include <geodrop/step/pipeline.hpp>
#include <geodrop/step/run.hpp>

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <utility>

#include "check_resumable.hpp"
#include "doubts/doubts.hpp"
#include "initial_state.hpp"
#include "membrane/tension_gauge.hpp"
#include "parts.hpp"
#include "setup/memory_estimate.hpp"
#include "thread_choice.hpp"

namespace geodrop {
namespace {

template <int Dim>
void write_due_output(Output<Dim>& output, State<Dim>& state) {
  if (output.history_due(state.t)) {
    output.write_history(Frame<Dim>(state));
    for (Membrane<Dim>& membrane : state.membranes) restart_peak(membrane.gauge);
  }
  if (output.frame_due(state.t)) output.write_frame(Frame<Dim>(state));
}

template <int Dim>
void advance_with(ThreadChoice& choice, Pipeline<Dim>& pipeline, State<Dim>& state, Grids<Dim>& grids) {
  omp_set_num_threads(choice.threads());
  const auto start = std::chrono::steady_clock::now();
  advance(pipeline, state, grids);
  choice.took(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

/// Steps until `end`, a signal, or a file that the disk does not take. On a broken run the status says failed; the
/// state is as the break left it.
template <int Dim>
RunStatistics step_until(double end, const Scene& scene, Pipeline<Dim>& pipeline, State<Dim>& state, Grids<Dim>& grids,
                         ThreadChoice* choice, Output<Dim>& output) {
  RunStatistics statistics;
  const std::uint64_t first_step = state.step;
  const auto start = std::chrono::steady_clock::now();
  try {
    statistics.facts = state_facts(scene, state);
    while (state.t < end && !is_over(scene, state) && !stop_requested() && !output.blocked()) {
      if (choice)
        advance_with(*choice, pipeline, state, grids);
      else
        advance(pipeline, state, grids);
      write_due_output(output, state);
      if (take_checkpoint_request() || output.checkpoint_due(state.t)) output.checkpoint(Frame<Dim>(state));
      output.progress(state.t, state.step);
    }
    statistics.status = is_over(scene, state) ? RunStatus::done : RunStatus::stopped;
  } catch (const RunError& error) {
    statistics.status = RunStatus::failed;
    statistics.message = error.what();
  }
  statistics.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  statistics.steps = state.step - first_step;
  for (const Row<Dim>& row : pipeline) statistics.stages.push_back({row.name, row.seconds});
  return statistics;
}

template <int Dim>
RunOutcome run_in(const Scene& scene, const RunOptions& options) {
  // The state comes first: a scene that cannot be built must not touch an earlier run's directory.
  State<Dim> state;
  if (!options.resume) state = initial_state<Dim>(scene);
  catch_signals();
  Output<Dim> output(scene, options,
                     [&](const State<Dim>& read) { return fault_in_state(scene, initial_state<Dim>(scene), read); });
  for (const std::string& note : scene_notes(scene)) output.log("note: " + note);
  for (const std::string& doubt : doubts(scene)) output.warn("warning: " + doubt);
  if (options.resume) state = output.resume();
  Grids<Dim> grids = make_grids<Dim>(scene);
  Pipeline<Dim> pipeline = build_pipeline<Dim>(scene);
  if (options.parts) record_parts(*options.parts, output.directory() / parts_name, pipeline);
  if (!options.resume) output.start(Frame<Dim>(state));

  const double end = options.end > 0 ? std::min(options.end, scene.time.end) : scene.time.end;
  RunOutcome outcome;
  ThreadChoice choice(options.threads);
  outcome.statistics =
      step_until(end, scene, pipeline, state, grids, options.fewer_threads ? &choice : nullptr, output);
  if (options.fewer_threads) {
    omp_set_num_threads(options.threads);
    output.log(choice.text());
  }
  // A broken state is of no use: the checkpoint before it stays.
  if (outcome.statistics.status != RunStatus::failed) output.checkpoint(Frame<Dim>(state));
  outcome.summary = output.finish(Frame<Dim>(state), outcome.statistics);
  if (output.blocked() && outcome.statistics.status != RunStatus::failed) {
    outcome.statistics.status = RunStatus::blocked;
    outcome.statistics.message = output.trouble();
  }
  return outcome;
}

}  // namespace

RunOutcome perform_run(const Scene& scene, const RunOptions& options) {
  require_memory(scene);
  try {
    return scene.dimension == 2 ? run_in<2>(scene, options) : run_in<3>(scene, options);
  } catch (const std::bad_alloc&) {
    throw RunError("not enough memory: the scene takes " + describe(estimate_memory(scene)));
  }
}

int run_scene(const Scene& scene, const RunOptions& options, bool verify) {
  const RunOutcome outcome = perform_run(scene, options);
  if (outcome.statistics.status == RunStatus::stopped) return exit_stopped;
  if (outcome.statistics.status == RunStatus::blocked) return exit_not_written;
  if (outcome.statistics.status == RunStatus::failed) return 1;
  return verify && !outcome.summary.expectations_met ? 1 : 0;
}

}  // namespace geodrop
