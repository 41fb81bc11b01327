// Benchmarks: a block of one material moves through a box; whole steps are timed, sort and grid included.
#include <geodrop/bench.hpp>
#include <geodrop/pipeline.hpp>

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>

namespace geodrop {
namespace {

struct Benchmark {
  const char* name;
  int dimension;
  const char* material;
  Transfer transfer;
  PressureSupport pressure;
};

// Every (dimension, basis, material) pair that ships, and the options that change the cost of a step.
constexpr Benchmark benchmarks[] = {
    {"water_2d", 2, "newtonian", Transfer::apic, PressureSupport::particle},
    {"water_2d_cell", 2, "newtonian", Transfer::apic, PressureSupport::cell},
    {"water_2d_cell_blend", 2, "newtonian", Transfer::blend, PressureSupport::cell},
    {"elastic_2d", 2, "linear_elastic", Transfer::apic, PressureSupport::particle},
    {"soil_2d", 2, "mohr_coulomb", Transfer::apic, PressureSupport::particle},
    {"soil_2d_cell", 2, "mohr_coulomb", Transfer::apic, PressureSupport::cell},
    {"water_3d", 3, "newtonian", Transfer::apic, PressureSupport::particle},
    {"water_3d_cell", 3, "newtonian", Transfer::apic, PressureSupport::cell},
    {"elastic_3d", 3, "linear_elastic", Transfer::apic, PressureSupport::particle},
    {"soil_3d", 3, "mohr_coulomb", Transfer::apic, PressureSupport::particle},
};

MaterialSpec make_spec(const std::string& model) {
  MaterialSpec spec;
  spec.name = model;
  if (model == "newtonian")
    spec.model = NewtonianSpec{1000, 3.6e6, 0};
  else if (model == "linear_elastic")
    spec.model = LinearElasticSpec{2000, 10e6, 0.33};
  else
    spec.model = MohrCoulombSpec{2000, 10e6, 0.33, 0, 30, 0, 0, std::nullopt};
  return spec;
}

/// A cube of about `particles` particles, 2 per cell and axis, at 0.15 c along every axis: it crosses a cell in 13
/// steps.
Scene bench_scene(const Benchmark& bench, double particles) {
  const int d = bench.dimension;
  const int cells = static_cast<int>(std::lround(std::pow(particles, 1.0 / d) / 2));
  constexpr int margin = 8;
  Scene scene;
  scene.dimension = d;
  scene.grid.lower.assign(d, 0.0);
  scene.grid.upper.assign(d, cells + 2.0 * margin);
  scene.grid.spacing = 1;
  scene.walls.lower.assign(d, WallKind::slip);
  scene.walls.upper = scene.walls.lower;
  scene.gravity.assign(d, 0.0);
  scene.gravity[1] = -9.81;
  scene.solver.transfer = bench.transfer;
  scene.solver.blend_rate = bench.transfer == Transfer::blend ? 10 : 0;
  scene.time.end = 1e3;
  scene.materials.push_back(make_spec(bench.material));
  BodySpec body;
  body.name = "block";
  body.material = bench.material;
  body.shape = BoxShape{Point(d, double(margin)), Point(d, cells + double(margin))};
  body.pressure = bench.pressure;
  body.initial_velocity = UniformVelocitySpec{Point(d, 0.15 * wave_speed(make_material(scene.materials[0])))};
  body.initial_stress = ZeroStressSpec{};
  if (d == 2 && std::string(bench.material) == "mohr_coulomb")
    body.initial_stress = K0StressSpec{cells + double(margin), 0.5, std::nullopt};
  scene.bodies.push_back(body);
  return scene;
}

template <int Dim>
double bytes_of(const Body<Dim>& body) {
  const int scalars = Dim * Dim + 2 * Dim + 2 +
                      (body.stress[0].empty() ? 0 : stress_components<Dim>)+(body.pore_pressure.empty() ? 0 : 1) +
                      (body.deviatoric_strain.empty() ? 0 : 1);
  return scalars * sizeof(double);
}

template <int Dim>
BenchRow time_benchmark(const Benchmark& bench, const BenchOptions& options, const MachineRoofs& roofs) {
  const Scene scene = bench_scene(bench, options.quick ? 1e5 : 1e6);
  State<Dim> state = build_state<Dim>(scene);
  Grid<Dim> grid = make_grid<Dim>(scene);
  Pipeline<Dim> pipeline = build_pipeline<Dim>(scene);
  const int steps = options.quick ? 20 : 30, repeats = options.quick ? 3 : 5;
  advance(scene, pipeline, state, grid);
  for (Stage<Dim>& stage : pipeline) stage.seconds = 0;
  std::vector<double> speeds;
  const double n = static_cast<double>(state.bodies[0].size());
  for (int r = 0; r < repeats; ++r) {
    const auto start = std::chrono::steady_clock::now();
    for (int s = 0; s < steps; ++s) advance(scene, pipeline, state, grid);
    speeds.push_back(n * steps / std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() *
                     1e-6);
  }
  std::sort(speeds.begin(), speeds.end());
  const auto slowest = std::max_element(pipeline.begin(), pipeline.end(),
                                        [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  BenchRow row{bench.name,
               Dim,
               "bspline2",
               bench.material,
               bench.transfer == Transfer::apic ? "apic" : "blend",
               bench.pressure == PressureSupport::cell ? "cell" : "particle",
               state.bodies[0].size(),
               options.threads,
               speeds[speeds.size() / 2],
               speeds.front(),
               speeds.back(),
               0,
               bytes_of(state.bodies[0]),
               0,
               0,
               slowest->name};
  row.ns_per_particle_step = 1e3 / row.mpps;
  row.memory_share = row.mpps * 1e6 * 2 * row.bytes_per_particle / (roofs.gbytes_s * 1e9);
  row.arithmetic_ratio = row.mpps / roofs.gflops;
  return row;
}

void write_csv(const std::filesystem::path& file, const std::vector<BenchRow>& rows, const MachineRoofs& roofs) {
  std::ofstream out(file);
  out << "name,dimension,basis,material,transfer,pressure,particles,threads,mpps,mpps_min,mpps_max,ns_per_particle_"
         "step,bytes_per_particle,"
         "memory_share,mpps_per_gflops,slowest_stage,roof_gflops,roof_gbytes_s\n";
  for (const BenchRow& r : rows)
    out << r.name << ',' << r.dimension << ',' << r.basis << ',' << r.material << ',' << r.transfer << ',' << r.pressure
        << ',' << r.particles << ',' << r.threads << ',' << r.mpps << ',' << r.mpps_min << ',' << r.mpps_max << ','
        << r.ns_per_particle_step << ',' << r.bytes_per_particle << ',' << r.memory_share << ',' << r.arithmetic_ratio
        << ',' << r.slowest_stage << ',' << roofs.gflops << ',' << roofs.gbytes_s << '\n';
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace

int run_bench(const BenchOptions& options) {
  std::filesystem::create_directories(options.directory);
  const MachineRoofs roofs = measure_roofs(options.threads);
  std::printf("roofs on %d threads: %.1f Gflop/s, %.1f Gbyte/s\n", options.threads, roofs.gflops, roofs.gbytes_s);
  std::printf("%-20s %9s %8s %8s %8s %8s  %s\n", "name", "particles", "mpps", "min", "max", "ns", "slowest stage");
  std::vector<BenchRow> rows;
  for (const Benchmark& bench : benchmarks) {
    if (std::string(bench.name).find(options.only) == std::string::npos) continue;
    rows.push_back(bench.dimension == 2 ? time_benchmark<2>(bench, options, roofs)
                                        : time_benchmark<3>(bench, options, roofs));
    const BenchRow& r = rows.back();
    std::printf("%-20s %9zu %8.2f %8.2f %8.2f %8.2f  %s\n", r.name.c_str(), r.particles, r.mpps, r.mpps_min, r.mpps_max,
                r.ns_per_particle_step, r.slowest_stage.c_str());
    std::fflush(stdout);
  }
  write_csv(options.directory / "bench.csv", rows, roofs);
  return 0;
}

}  // namespace geodrop
