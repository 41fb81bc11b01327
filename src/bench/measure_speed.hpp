// Times whole steps of a benchmark, sort and grid included, in turn with the reference kernels.
#pragma once

#include "benchmarks.hpp"
#include "reference_kernels.hpp"
#include "work_counts.hpp"

#include <filesystem>

namespace geodrop {

/// A stretch of steps as the clocks saw it.
struct TimedSteps {
  std::size_t particles = 0;
  int steps = 0;
  double wall_seconds = 0, processor_seconds = 0;
  std::vector<StageTime> stages;
};

/// One timed stretch of steps; all times in ns per particle-step, wall time of all threads together.
struct SpeedSample {
  double ns = 0;
  double processor_ns = 0;  ///< processor time, the sum over the threads
  int steps = 0;
  std::vector<StageTime> stages;  ///< `seconds` holds ns per particle-step here, too
};

SpeedSample sample_of(const TimedSteps& timed);

struct SpeedMeasurement {
  std::size_t particles = 0, nodes = 0, active_blocks = 0;
  double bytes_per_particle = 0;     ///< resident particle data [byte]
  WorkCount work;                    ///< of a particle-step
  MachineRoofs roofs;                ///< best of the samples taken in turn
  std::vector<SpeedSample> samples;  ///< fastest first

  const SpeedSample& median() const { return samples[samples.size() / 2]; }
  double mpps() const { return 1e3 / median().ns; }
  double arithmetic_fraction() const { return work.flops / roofs.gflops / median().ns; }
  double memory_fraction() const { return work.bytes / roofs.gbytes_s / median().ns; }
};

/// Appends the stages that are not among `names` yet.
void add_stage_names(const SpeedMeasurement& measurement, std::vector<std::string>& names);

/// ns per particle-step of a stage; 0 if there was none of that name.
double stage_ns(const SpeedSample& sample, const std::string& name);

/// How long to measure. A stretch is a whole number of sort cycles, so that each holds its share of sorting.
struct Sampling {
  int samples = 5;
  int cycles = 1;  ///< from one sort to the next, about 16 steps
};

SpeedMeasurement measure_block(const Benchmark& bench, const BlockSize& size, const Sampling& sampling,
                               ReferenceKernels& reference);

/// A scene in stretches of 100 steps after its first 600, in which the container of the main case starts to fall.
SpeedMeasurement measure_scene(const Scene& scene, const Sampling& sampling, ReferenceKernels& reference);

/// What a fixed number of steps took on one thread, and nothing around them.
struct StepTime {
  std::string name;
  std::size_t particles = 0;
  int steps = 0;
  double seconds = 0;  ///< of processor time, had all stretches of 16 steps been as fast as the fastest
};

/// The block is set in motion again every 16 steps, so that it stays clear of the walls; the first of them sorts.
StepTime time_block(const Benchmark& bench, const BlockSize& size, int steps);

/// After eight steps, in which contacts are found and memory is touched.
StepTime time_scene(const std::string& name, const Scene& scene, int steps);

}  // namespace geodrop
