#include "effort.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/step/pipeline.hpp>

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>

#include "base/text.hpp"
#include "doubts/doubtful_setting.hpp"
#include "initial_state.hpp"
#include "setup/memory_estimate.hpp"

namespace geodrop {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The first step allocates and sorts: it does not count.
template <int Dim>
void try_steps(const Scene& scene, Effort& effort) {
  constexpr double longest_trial = 0.7;  // [s]
  constexpr int most_steps = 50;
  State<Dim> state = initial_state<Dim>(scene);
  effort.particles = static_cast<double>(state.particles());
  Grids<Dim> grids = make_grids<Dim>(scene);
  Pipeline<Dim> pipeline = build_pipeline<Dim>(scene);
  advance(pipeline, state, grids);
  const double begin = state.t;
  const Clock::time_point start = Clock::now();
  int steps = 0;
  for (; steps < most_steps && (steps == 0 || seconds_since(start) < longest_trial); ++steps)
    advance(pipeline, state, grids);
  effort.steps = scene.time.end / (state.t - begin) * steps;
  effort.seconds = effort.steps * seconds_since(start) / steps;
}

/// A trial gives no more than three.
double in_digits(double estimate) {
  constexpr int digits = 3;
  return std::strtod(format_number(estimate, digits).c_str(), nullptr);
}

std::string in_bytes(double bytes) {
  constexpr double mega = 1e6, giga = 1e9;
  return bytes < giga ? format_number(std::max(1.0, bytes / mega), 3) + " MB" : format_number(bytes / giga, 3) + " GB";
}

}  // namespace

Effort estimate_effort(const Scene& scene, int threads) {
  Effort effort;
  effort.memory_bytes = estimate_memory(scene).bytes;
  omp_set_num_threads(threads);
  try {
    if (scene.dimension == 2)
      try_steps<2>(scene, effort);
    else
      try_steps<3>(scene, effort);
  } catch (const RunError& error) {
    effort.seconds = std::numeric_limits<double>::quiet_NaN();
    effort.failure = error.what();
  }
  effort.steps = in_digits(effort.steps);
  effort.seconds = in_digits(effort.seconds);
  const double frames = std::min(scene.time.end / scene.output.frame_interval, effort.steps) + 1;
  effort.output_bytes = output_bytes(scene) * frames / (scene.time.end / scene.output.frame_interval + 1);
  return effort;
}

std::string effort_in_words(const Effort& effort) {
  if (!effort.failure.empty()) return "its first steps break: " + effort.failure;
  return format_number(effort.particles) + " particles, about " + format_number(effort.steps) + " steps, " +
         format_duration(effort.seconds) + " on this machine as busy as it is, " + in_bytes(effort.memory_bytes) +
         " of memory, " + in_bytes(effort.output_bytes) + " of frames";
}

}  // namespace geodrop
