// How the cost of a particle-step grows with the number of particles, and with the domain around the same particles.
#include <geodrop/bench/bench.hpp>

#include "machine.hpp"
#include "steps.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace geodrop {
namespace {

constexpr double particle_counts[] = {1e4, 1e5, 1e6, 1e7};
constexpr double domain_factors[] = {1, 3, 8};
constexpr double particles_in_domain = 1e5;

bool grows(const Benchmark& bench) {
  const bool material = bench.material == BenchMaterial::water || bench.material == BenchMaterial::soil;
  return material && !bench.at_rest && !bench.graded && bench.transfer == Transfer::tpic &&
         bench.basis == Basis::bspline2;
}

/// Of particles, of what building them takes for a while, and of the grid [byte]; generous.
double memory_needed(const Benchmark& bench, const BlockSize& size) {
  constexpr double particle = 500, node = 100, margins = 16;
  const double cells = std::pow(size.particles, 1.0 / bench.dimension) / 2 + margins;
  return particle * size.particles + node * std::pow(cells * size.domain_factor, bench.dimension);
}

struct GrowthRow {
  const char* kind;
  Benchmark bench;
  double factor;
  int threads;
  SpeedMeasurement speed;
};

/// Prints rows as they come; the file is rewritten with each, so that a long run may be stopped.
class GrowthTable {
 public:
  explicit GrowthTable(std::filesystem::path file) : file_(std::move(file)) {
    std::printf("%-10s %-24s %7s %7s %9s %10s %8s %8s %8s\n", "kind", "name", "threads", "domain", "particles", "nodes",
                "ns", "best", "cpu");
  }

  void add(GrowthRow row) {
    const SpeedMeasurement& m = row.speed;
    std::printf("%-10s %-24s %7d %7g %9zu %10zu %8.2f %8.2f %8.2f\n", row.kind, row.bench.name.c_str(), row.threads,
                row.factor, m.particles, m.nodes, m.median().ns, m.samples.front().ns, m.median().processor_ns);
    std::fflush(stdout);
    add_stage_names(m, stages_);
    rows_.push_back(std::move(row));
    write();
  }

 private:
  void write() const {
    std::ofstream out(file_);
    out << "kind,name,dimension,basis,material,pressure,threads,domain_factor,particles,nodes,active_blocks,mpps,"
           "ns_per_particle_step,ns_best,processor_ns,processor";
    for (const std::string& stage : stages_) out << ",ns_" << stage;
    out << '\n';
    for (const auto& [kind, bench, factor, threads, m] : rows_) {
      out << kind << ',' << bench.name << ',' << bench.dimension << ',' << name_of(bench.basis) << ','
          << name_of(bench.material) << ',' << name_of(bench.pressure) << ',' << threads << ',' << factor << ','
          << m.particles << ',' << m.nodes << ',' << m.active_blocks << ',' << m.mpps() << ',' << m.median().ns << ','
          << m.samples.front().ns << ',' << m.median().processor_ns << ',' << processor_name();
      for (const std::string& stage : stages_) out << ',' << stage_ns(m.median(), stage);
      out << '\n';
    }
    if (!out.flush()) throw std::runtime_error("cannot write " + file_.string());
  }

  std::filesystem::path file_;
  std::vector<GrowthRow> rows_;
  std::vector<std::string> stages_;
};

/// Measures one size, unless it does not fit into memory.
void measure_size(GrowthTable& table, const char* kind, const Benchmark& bench, const BlockSize& size,
                  ReferenceKernels& reference, int threads) {
  if (memory_needed(bench, size) > available_memory()) {
    std::printf("%s %s: %g particles in a domain %g times larger are left out: %.1f GB needed, %.1f available\n", kind,
                bench.name.c_str(), size.particles, size.domain_factor, 1e-9 * memory_needed(bench, size),
                1e-9 * available_memory());
    return;
  }
  const Sampling sampling = size.particles > 2e6   ? Sampling{3, 1}
                            : size.particles > 2e5 ? Sampling{5, 1}
                                                   : Sampling{9, 2};
  table.add({kind, bench, size.domain_factor, threads, measure_block(bench, size, sampling, reference)});
}

}  // namespace

int run_growth(const BenchOptions& options) {
  std::filesystem::create_directories(options.directory);
  GrowthTable table(options.directory / "growth.csv");
  const double most = options.particles > 0 ? options.particles : options.quick ? 1e6 : 1e7;
  std::vector<int> thread_counts{1};
  if (options.threads > 1) thread_counts.push_back(options.threads);
  for (const int threads : thread_counts) {
    omp_set_num_threads(threads);
    ReferenceKernels reference(threads);
    for (const Benchmark& bench : all_benchmarks()) {
      if (!grows(bench) || !selected(options, bench.name)) continue;
      for (const double particles : particle_counts)
        if (particles <= most) measure_size(table, "particles", bench, {particles, 1}, reference, threads);
      for (const double factor : domain_factors)
        measure_size(table, "domain", bench, {particles_in_domain, factor}, reference, threads);
    }
  }
  return 0;
}

}  // namespace geodrop
