#include "measure_speed.hpp"

#include "../grid/sort_particles.hpp"
#include "stopwatch.hpp"

#include <algorithm>
#include <limits>

namespace geodrop {
namespace {

template <int Dim>
struct Subject {
  explicit Subject(Scene s)
      : scene(std::move(s)),
        state(build_state<Dim>(scene)),
        grids(make_grids<Dim>(scene)),
        pipeline(build_pipeline<Dim>(scene)) {}

  Scene scene;
  State<Dim> state;
  Grids<Dim> grids;
  Pipeline<Dim> pipeline;
  bool at_rest = false;
};

BenchMaterial kind_of(const Material& material) {
  if (const auto* water = std::get_if<Newtonian>(&material))
    return water->viscosity > 0 ? BenchMaterial::viscous : BenchMaterial::water;
  if (const auto* soil = std::get_if<MohrCoulomb>(&material))
    return soil->pore_stiffness > 0 ? BenchMaterial::undrained : BenchMaterial::soil;
  return std::holds_alternative<NeoHookean>(material) ? BenchMaterial::rubber : BenchMaterial::elastic;
}

template <int Dim>
SpeedMeasurement describe(const Subject<Dim>& subject) {
  SpeedMeasurement m;
  m.particles = subject.state.particles();
  m.nodes = subject.grids.front().layout.nodes();
  m.active_blocks = subject.grids.front().active_blocks.size();
  const double all = static_cast<double>(m.particles);
  for (const Body<Dim>& body : subject.state.bodies) {
    m.bytes_per_particle += particle_bytes(body) / all;
    m.work += work_of({Dim, subject.scene.grid.basis, kind_of(body.material), subject.scene.solver.transfer,
                       body.pressure, subject.grids.front().layout.graded(), subject.at_rest}) *
              (static_cast<double>(body.size()) / all);
  }
  return m;
}

/// Steps through a number of sort cycles; the first step sorts.
template <int Dim>
int step_cycles(Subject<Dim>& subject, int cycles) {
  const double due = allowed_drift_cells * subject.grids.front().layout.finest;
  int steps = 0;
  for (int cycle = 0; cycle < cycles; ++cycle) do {
      advance(subject.scene, subject.pipeline, subject.state, subject.grids);
      ++steps;
    } while (subject.state.drift < due);
  return steps;
}

/// `run` returns the number of steps that it made.
template <int Dim, class Run>
SpeedSample time_steps(Subject<Dim>& subject, int threads, Run&& run) {
  for (Stage<Dim>& stage : subject.pipeline) stage.seconds = 0;
  const Stopwatch watch(threads);
  const int steps = run();
  TimedSteps timed{subject.state.particles(), steps, watch.wall_seconds(), watch.judged_seconds(), {}};
  for (const Stage<Dim>& stage : subject.pipeline) timed.stages.push_back({stage.name, stage.seconds});
  return sample_of(timed);
}

/// `sample` times one stretch; it comes between two samples of the reference kernels.
template <int Dim, class Sample>
SpeedMeasurement take_samples(Subject<Dim>& subject, int count, ReferenceKernels& reference, Sample&& sample) {
  std::vector<ReferenceSample> roofs{reference.sample()};
  std::vector<SpeedSample> samples;
  for (int k = 0; k < count; ++k) {
    samples.push_back(sample(k));
    roofs.push_back(reference.sample());
  }
  SpeedMeasurement m = describe(subject);
  std::sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a.ns < b.ns; });
  m.samples = std::move(samples);
  const ReferenceSample best = best_of(roofs);
  m.roofs = best.wall;
  m.judged_roofs = best.judged;
  return m;
}

template <int Dim>
SpeedMeasurement measure_block_in(const Benchmark& bench, const BlockSize& size, const Effort& effort,
                                  ReferenceKernels& reference) {
  Subject<Dim> subject(block_scene(bench, size));
  subject.at_rest = bench.at_rest;
  set_in_motion<Dim>(bench, subject.scene, 1, subject.state);
  step_cycles(subject, 1);
  return take_samples(subject, effort.samples, reference, [&](int k) {
    set_in_motion<Dim>(bench, subject.scene, k % 2 ? 1 : -1, subject.state);
    return time_steps(subject, reference.threads(), [&] { return step_cycles(subject, effort.cycles); });
  });
}

template <int Dim>
SpeedMeasurement measure_case_in(const Scene& scene, const Effort& effort, ReferenceKernels& reference) {
  constexpr int warm_up = 600, stretch = 100;
  Subject<Dim> subject(scene);
  const auto run = [&](int steps) {
    for (int s = 0; s < steps; ++s) advance(subject.scene, subject.pipeline, subject.state, subject.grids);
    return steps;
  };
  run(warm_up);
  return take_samples(subject, effort.samples, reference, [&](int) {
    return time_steps(subject, reference.threads(), [&] { return run(stretch * effort.cycles); });
  });
}

}  // namespace

SpeedSample sample_of(const TimedSteps& timed) {
  const double to_ns = 1e9 / (static_cast<double>(timed.particles) * timed.steps);
  SpeedSample sample{timed.wall_seconds * to_ns, timed.judged_seconds * to_ns, timed.steps, {}};
  for (const StageTime& stage : timed.stages) sample.stages.push_back({stage.name, stage.seconds * to_ns});
  return sample;
}

double SpeedMeasurement::ratio() const {
  double best = std::numeric_limits<double>::infinity();
  for (const SpeedSample& sample : samples) best = std::min(best, sample.judged_ns);
  return (work.flops / judged_roofs.gflops + work.bytes / judged_roofs.gbytes_s) / best;
}

void add_stage_names(const SpeedMeasurement& measurement, std::vector<std::string>& names) {
  for (const StageTime& stage : measurement.median().stages)
    if (std::find(names.begin(), names.end(), stage.name) == names.end()) names.push_back(stage.name);
}

double stage_ns(const SpeedSample& sample, const std::string& name) {
  for (const StageTime& stage : sample.stages)
    if (stage.name == name) return stage.seconds;
  return 0;
}

SpeedMeasurement measure_block(const Benchmark& bench, const BlockSize& size, const Effort& effort,
                               ReferenceKernels& reference) {
  return bench.dimension == 2 ? measure_block_in<2>(bench, size, effort, reference)
                              : measure_block_in<3>(bench, size, effort, reference);
}

SpeedMeasurement measure_main_case(const Scene& scene, const Effort& effort, ReferenceKernels& reference) {
  return scene.dimension == 2 ? measure_case_in<2>(scene, effort, reference)
                              : measure_case_in<3>(scene, effort, reference);
}

}  // namespace geodrop
