// Figures that throughput rests on: steps that were timed, seconds to ns per particle-step, bytes of a particle-step.
#include <doctest/doctest.h>

#include "bench/measure_speed.hpp"
#include "bench/work_counts.hpp"
#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

TEST_CASE("Seconds of a stretch over its steps and particles are ns per particle-step, stages too") {
  const SpeedSample sample = sample_of({200000, 50, 0.4, 0.3, {{"scatter", 0.1}, {"gather", 0.25}}});
  CHECK(sample.ns == near(40, 1e-14));  // 0.4 s / 1e7
  CHECK(sample.processor_ns == near(30, 1e-14));
  CHECK(sample.steps == 50);
  CHECK(stage_ns(sample, "scatter") == near(10, 1e-14));
  CHECK(stage_ns(sample, "gather") == near(25, 1e-14));
  CHECK(stage_ns(sample, "sort") == 0);
}

TEST_CASE("The steps of a timed stretch are the steps that were made") {
  ReferenceKernels reference(1);
  const Scene scene = read_scene(source_path("cases/verification/edge_drift.toml"));
  const SpeedMeasurement of_case = measure_scene(scene, {1, 2}, reference);
  REQUIRE(of_case.samples.size() == 1);
  CHECK(of_case.samples[0].steps == 200);  // 100 a cycle
  // A block moves by 0.15 c + 0.03 c of shear along each axis with steps of h / 2 / (c + |v|), |v| = 0.23 to 0.28 c:
  // it drifts a cell in about 16 steps.
  Benchmark water;
  const SpeedMeasurement of_block = measure_block(water, {1e3, 1}, {1, 2}, reference);
  CHECK(of_block.samples[0].steps == within(32, 8));
}

TEST_CASE("Bytes of a particle-step, counted by hand") {
  // Water: scatter reads x 2, v 2, C 4, m, J; gather renews x 2 and J (twice each: 6) and writes v 2, C 4: 12. Every
  // 16th step all 10 are read and written. A node of four particles has six records of four.
  WorkKind kind;
  const double sorts = 2.0 / 16;
  CHECK(work_of(kind).bytes == near(8 * (10 + 12 + sorts * 10) + 6 * 32 / 4.0, 1e-14));
  // In space x 3, v 3, C 9; eight particles a node.
  kind.dimension = 3;
  CHECK(work_of(kind).bytes == near(8 * (17 + 20 + sorts * 17) + 6 * 32 / 8.0, 1e-14));
  // Soil has stress 4 and strain: scatter 14, gather renews both, 22; the pressure of cells reads x, m, J and three
  // stresses, 7, and 14 numbers a node; blend has the velocity once more and seven records more.
  kind = {2, Basis::bspline2, BenchMaterial::soil, Transfer::blend, PressureSupport::cell};
  CHECK(work_of(kind).bytes == near(8 * (14 + 24 + 7 + sorts * 15) + (13 * 32 + 14 * 8) / 4.0, 1e-14));
}
