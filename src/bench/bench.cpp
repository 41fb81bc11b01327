// Runs the table of benchmarks: prints, writes bench.csv.
#include <geodrop/bench/bench.hpp>

#include "machine.hpp"
#include "measure_speed.hpp"
#include "steps.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <stdexcept>

namespace geodrop {
namespace {

/// What a row of bench.csv says of the benchmark itself.
struct Labels {
  std::string name;
  int dimension = 2;
  std::string basis, material, transfer, pressure;
};

/// A benchmark, and how to measure it.
struct Candidate {
  Labels labels;
  std::function<SpeedMeasurement()> measure;
};

struct TableRow {
  Labels labels;
  SpeedMeasurement speed;
};

Labels labels_of(const Benchmark& bench) {
  return {bench.name,
          bench.dimension,
          name_of(bench.basis) + (bench.graded ? "_graded" : ""),
          name_of(bench.material) + (bench.at_rest ? "_at_rest" : ""),
          name_of(bench.transfer),
          name_of(bench.pressure)};
}

Labels labels_of(const SceneBenchmark& bench, const Scene& scene) {
  return {bench.name, scene.dimension, name_of(scene.grid.basis), "mixed", name_of(scene.solver.transfer), "mixed"};
}

std::vector<Candidate> candidates(const BenchOptions& options, ReferenceKernels& reference) {
  const Sampling sampling = options.quick ? Sampling{3, 1} : Sampling{7, 2};
  BlockSize size;
  size.particles = options.particles > 0 ? options.particles : options.quick ? 1e5 : 1e6;
  std::vector<Candidate> all;
  for (const Benchmark& bench : all_benchmarks())
    if (selected(options, bench.name))
      all.push_back({labels_of(bench), [=, &reference] { return measure_block(bench, size, sampling, reference); }});
  for (const SceneBenchmark& bench : scene_benchmarks())
    if (selected(options, bench.name))
      if (const std::optional<Scene> scene = scene_of(bench, options))
        all.push_back(
            {labels_of(bench, *scene), [=, &reference] { return measure_scene(*scene, sampling, reference); }});
  return all;
}

void write_csv(const std::filesystem::path& file, const std::vector<TableRow>& rows, int threads) {
  std::vector<std::string> stages;
  for (const TableRow& row : rows) add_stage_names(row.speed, stages);
  const std::string processor = processor_name();
  std::ofstream out(file);
  out << "name,dimension,basis,material,transfer,pressure,particles,threads,mpps,mpps_min,mpps_max,"
         "ns_per_particle_step,bytes_per_particle,arithmetic_fraction,memory_fraction,processor_ns,flops_per_particle_"
         "step,"
         "bytes_per_particle_step,roof_gflops,roof_gbytes_s,processor";
  for (const std::string& stage : stages) out << ",ns_" << stage;
  out << '\n';
  for (const auto& [labels, m] : rows) {
    out << labels.name << ',' << labels.dimension << ',' << labels.basis << ',' << labels.material << ','
        << labels.transfer << ',' << labels.pressure << ',' << m.particles << ',' << threads << ',' << m.mpps() << ','
        << 1e3 / m.samples.back().ns << ',' << 1e3 / m.samples.front().ns << ',' << m.median().ns << ','
        << m.bytes_per_particle << ',' << m.arithmetic_fraction() << ',' << m.memory_fraction() << ','
        << m.median().processor_ns << ',' << m.work.flops << ',' << m.work.bytes << ',' << m.roofs.gflops << ','
        << m.roofs.gbytes_s << ',' << processor;
    for (const std::string& stage : stages) out << ',' << stage_ns(m.median(), stage);
    out << '\n';
  }
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

void print_head() {
  std::printf("%-28s %9s %7s %7s %7s %7s %6s %6s %7s  %s\n", "name", "particles", "mpps", "min", "max", "ns", "arith.",
              "memory", "cpu", "slowest stage");
}

void print_row(const TableRow& row) {
  const SpeedMeasurement& m = row.speed;
  const auto& stages = m.median().stages;
  const auto slowest = std::max_element(stages.begin(), stages.end(),
                                        [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  std::printf("%-28s %9zu %7.2f %7.2f %7.2f %7.2f %6.3f %6.3f %7.2f  %s %.0f %%\n", row.labels.name.c_str(),
              m.particles, m.mpps(), 1e3 / m.samples.back().ns, 1e3 / m.samples.front().ns, m.median().ns,
              m.arithmetic_fraction(), m.memory_fraction(), m.median().processor_ns, slowest->name.c_str(),
              100 * slowest->seconds / m.median().ns);
  std::fflush(stdout);
}

/// Pairs that differ in the support of pressure only.
void print_cost_of_averages(const std::vector<TableRow>& rows) {
  for (const TableRow& cell : rows) {
    const auto twin = std::find_if(rows.begin(), rows.end(), [&](const TableRow& row) {
      const Labels &a = row.labels, &b = cell.labels;
      return b.pressure != "particle" && a.pressure == "particle" && a.dimension == b.dimension && a.basis == b.basis &&
             a.material == b.material && a.transfer == b.transfer;
    });
    if (twin == rows.end()) continue;
    const double with = cell.speed.median().ns, without = twin->speed.median().ns;
    std::printf("%s pressure, %s: %.2f ns per particle-step more than %.2f (%+.0f %%)\n", cell.labels.pressure.c_str(),
                cell.labels.name.c_str(), with - without, without, 100 * (with / without - 1));
  }
}

}  // namespace

int run_bench(const BenchOptions& options) {
  std::filesystem::create_directories(options.directory);
  ReferenceKernels reference(options.threads);
  const std::vector<Candidate> table = candidates(options, reference);
  if (table.empty()) return no_benchmark(options);
  const MachineRoofs roofs = best_of({reference.sample(), reference.sample(), reference.sample()});
  std::printf("roofs on %d threads: %.1f Gflop/s, %.1f Gbyte/s\n", options.threads, roofs.gflops, roofs.gbytes_s);
  print_head();
  std::vector<TableRow> rows;
  for (const Candidate& candidate : table) {
    rows.push_back({candidate.labels, candidate.measure()});
    print_row(rows.back());
  }
  print_cost_of_averages(rows);
  write_csv(options.directory / "bench.csv", rows, options.threads);
  return 0;
}

}  // namespace geodrop
