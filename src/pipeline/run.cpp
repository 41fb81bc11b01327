// The loop over steps, and what surrounds it.
#include <geodrop/error.hpp>
#include <geodrop/pipeline.hpp>
#include <geodrop/run.hpp>
#include <geodrop/stop_signal.hpp>

#include <algorithm>
#include <chrono>

#include "parts.hpp"

namespace geodrop {
namespace {

template <int Dim>
void write_due_output(Output<Dim>& output, State<Dim>& state) {
  if (output.history_due(state.t)) {
    output.write_history(Frame<Dim>(state));
    for (Membrane<Dim>& membrane : state.membranes) membrane.tension_peak = 0;
  }
  if (output.frame_due(state.t)) output.write_frame(Frame<Dim>(state));
}

/// Steps until `end` or a stop signal. On a broken run the status says failed; the state is as the break left it.
template <int Dim>
RunStatistics step_until(double end, const Scene& scene, Pipeline<Dim>& pipeline, State<Dim>& state, Grids<Dim>& grids,
                         Output<Dim>& output) {
  RunStatistics statistics;
  const std::uint64_t first_step = state.step;
  const auto start = std::chrono::steady_clock::now();
  try {
    statistics.facts = state_facts(scene, state);
    while (state.t < end && !is_over(scene, state) && !stop_requested()) {
      advance(scene, pipeline, state, grids);
      write_due_output(output, state);
      output.progress(state.t, state.step);
    }
    statistics.status = state.t < end && !is_over(scene, state) ? RunStatus::stopped : RunStatus::done;
  } catch (const RunError& error) {
    statistics.status = RunStatus::failed;
    statistics.message = error.what();
  }
  statistics.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  statistics.steps = state.step - first_step;
  for (const Stage<Dim>& stage : pipeline) statistics.stages.push_back({stage.name, stage.seconds});
  return statistics;
}

template <int Dim>
RunOutcome run_in(const Scene& scene, const RunOptions& options) {
  // The state comes first: a scene that cannot be built must not touch an earlier run's directory.
  State<Dim> state;
  if (!options.resume) state = build_state<Dim>(scene);
  Output<Dim> output(scene, options);
  if (options.resume) state = output.resume();
  Grids<Dim> grids = make_grids<Dim>(scene);
  Pipeline<Dim> pipeline = build_pipeline<Dim>(scene);
  if (options.parts) record_parts(*options.parts, output.directory() / parts_name, pipeline);
  catch_stop_signals();
  if (!options.resume) output.start(Frame<Dim>(state));

  const double end = options.end > 0 ? std::min(options.end, scene.time.end) : scene.time.end;
  RunStatistics statistics = step_until(end, scene, pipeline, state, grids, output);
  // A run that ends before its scene does, by signal or by --until, can go on later.
  const bool unfinished = statistics.status == RunStatus::stopped ||
                          (statistics.status == RunStatus::done && end < scene.time.end && !is_over(scene, state));
  if (unfinished) output.checkpoint(Frame<Dim>(state));
  const Summary summary = output.finish(Frame<Dim>(state), statistics);
  return {statistics, summary};
}

}  // namespace

RunOutcome perform_run(const Scene& scene, const RunOptions& options) {
  return scene.dimension == 2 ? run_in<2>(scene, options) : run_in<3>(scene, options);
}

int run_scene(const Scene& scene, const RunOptions& options, bool verify) {
  const RunOutcome outcome = perform_run(scene, options);
  if (outcome.statistics.status == RunStatus::stopped) return exit_stopped;
  if (outcome.statistics.status == RunStatus::failed) return 1;
  return verify && !outcome.summary.expectations_met ? 1 : 0;
}

}  // namespace geodrop
