// The table of benchmarks, and the scene of each: a block of one material that shears while it moves through a box.
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/step/pipeline.hpp>

#include <string>
#include <vector>

namespace geodrop {

/// A material as benchmarks name it.
enum class BenchMaterial { water, viscous, elastic, rubber, soil, undrained };

/// Which kernels a particle passes through.
struct WorkKind {
  int dimension = 2;
  Basis basis = Basis::bspline2;
  BenchMaterial material = BenchMaterial::water;
  Transfer transfer = Transfer::tpic;
  PressureSupport pressure = PressureSupport::particle;
  bool graded = false;   ///< benchmarks: graded kernels on cells of the same width; all that differs is what they cost
  bool at_rest = false;  ///< benchmarks: soil under K0 stress, carried along, elastic; else every point yields
};

struct Benchmark : WorkKind {
  std::string name;
};

/// Every (dimension, basis, material) that ships, and the options that change the cost of a step.
std::vector<Benchmark> all_benchmarks();

/// A benchmark that is a scene file of the source tree, not a block.
struct SceneBenchmark {
  std::string name, file;
  std::vector<std::string> overrides;
};
/// The main case first, which --scene may replace; then its coarse grid, enclosed fluid in a membrane in contact
/// with the ground, two membranes in water, soil in 3D.
std::vector<SceneBenchmark> scene_benchmarks();

/// As scene files name them.
std::string name_of(Basis basis);
std::string name_of(Transfer transfer);
std::string name_of(PressureSupport pressure);
std::string name_of(BenchMaterial material);

/// Size of a benchmark's block and of the box around it.
struct BlockSize {
  double particles = 1e6;    ///< about; 4 a cell in 2D, 8 in 3D
  double domain_factor = 1;  ///< box per axis over the smallest one, which leaves 8 cells around the block
};
Scene block_scene(const Benchmark& bench, const BlockSize& size);

/// Sets the block moving: 0.15 c along every axis, so that it crosses a cell in about 16 steps, and a shear of
/// +-0.03 c across its height. `direction` +1 or -1 turns both round. All motion and strain is taken back first: what a
/// free block does after long shearing is no matter of speed, and corners of hat functions tear themselves off. Soil is
/// put on its yield surface under 10 kPa, and goes on yielding at every point. Soil at rest has cohesion and K0 stress
/// under 10 kPa, shears ten times less, and yields nowhere.
template <int Dim>
void set_in_motion(const Benchmark& bench, const Scene& scene, double direction, State<Dim>& state);

}  // namespace geodrop
