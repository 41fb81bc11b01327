// Runs the table of benchmarks: prints, writes bench.csv, compares with committed ratios.
#include <geodrop/bench.hpp>
#include <geodrop/scene_reader.hpp>

#include "machine.hpp"
#include "measure_speed.hpp"
#include "ratio_check.hpp"

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

/// A benchmark that can be measured as often as wanted.
struct Candidate {
  Labels labels;
  std::function<SpeedMeasurement()> measure;
};

struct Row {
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

bool wanted(const BenchOptions& options, const std::string& name) {
  return name.find(options.only) != std::string::npos;
}

void add_main_case(const BenchOptions& options, const Effort& effort, ReferenceKernels& reference,
                   std::vector<Candidate>& candidates) {
  const std::filesystem::path file = options.scene.empty() ? find_in_tree("cases/dump_kekerdom.toml") : options.scene;
  if (file.empty()) {
    std::printf(
        "%s is left out: there is no cases/dump_kekerdom.toml above this program or this directory; give it by"
        " --scene\n",
        main_case_name);
    return;
  }
  const Scene scene = read_scene(file.string());
  candidates.push_back(
      {{main_case_name, scene.dimension, name_of(scene.grid.basis), "mixed", name_of(scene.solver.transfer), "mixed"},
       [=, &reference] { return measure_main_case(scene, effort, reference); }});
}

std::vector<Candidate> candidates(const BenchOptions& options, ReferenceKernels& reference) {
  const Effort effort = options.quick ? Effort{3, 1} : Effort{7, 2};
  BlockSize size;
  size.particles = options.particles > 0 ? options.particles : options.quick ? 1e5 : 1e6;
  std::vector<Candidate> all;
  for (const Benchmark& bench : all_benchmarks())
    if (wanted(options, bench.name))
      all.push_back({labels_of(bench), [=, &reference] { return measure_block(bench, size, effort, reference); }});
  if (wanted(options, main_case_name)) add_main_case(options, effort, reference, all);
  return all;
}

void write_csv(const std::filesystem::path& file, const std::vector<Row>& rows, int threads) {
  std::vector<std::string> stages;
  for (const Row& row : rows) add_stage_names(row.speed, stages);
  const std::string processor = processor_name();
  std::ofstream out(file);
  out << "name,dimension,basis,material,transfer,pressure,particles,threads,mpps,mpps_min,mpps_max,"
         "ns_per_particle_step,bytes_per_particle,arithmetic_fraction,memory_fraction,ratio,flops_per_particle_step,"
         "bytes_per_particle_step,roof_gflops,roof_gbytes_s,processor";
  for (const std::string& stage : stages) out << ",ns_" << stage;
  out << '\n';
  for (const auto& [labels, m] : rows) {
    out << labels.name << ',' << labels.dimension << ',' << labels.basis << ',' << labels.material << ','
        << labels.transfer << ',' << labels.pressure << ',' << m.particles << ',' << threads << ',' << m.mpps() << ','
        << 1e3 / m.samples.back().ns << ',' << 1e3 / m.samples.front().ns << ',' << m.median().ns << ','
        << m.bytes_per_particle << ',' << m.arithmetic_fraction() << ',' << m.memory_fraction() << ',' << m.ratio()
        << ',' << m.work.flops << ',' << m.work.bytes << ',' << m.roofs.gflops << ',' << m.roofs.gbytes_s << ','
        << processor;
    for (const std::string& stage : stages) out << ',' << stage_ns(m.median(), stage);
    out << '\n';
  }
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

void print_head() {
  std::printf("%-28s %9s %7s %7s %7s %7s %6s %6s %6s  %s\n", "name", "particles", "mpps", "min", "max", "ns", "arith.",
              "memory", "ratio", "slowest stage");
}

void print_row(const Row& row) {
  const SpeedMeasurement& m = row.speed;
  const auto& stages = m.median().stages;
  const auto slowest = std::max_element(stages.begin(), stages.end(),
                                        [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  std::printf("%-28s %9zu %7.2f %7.2f %7.2f %7.2f %6.3f %6.3f %6.3f  %s %.0f %%\n", row.labels.name.c_str(),
              m.particles, m.mpps(), 1e3 / m.samples.back().ns, 1e3 / m.samples.front().ns, m.median().ns,
              m.arithmetic_fraction(), m.memory_fraction(), m.ratio(), slowest->name.c_str(),
              100 * slowest->seconds / m.median().ns);
  std::fflush(stdout);
}

/// Pairs that differ in the support of pressure only.
void print_cost_of_averages(const std::vector<Row>& rows) {
  for (const Row& cell : rows) {
    const auto twin = std::find_if(rows.begin(), rows.end(), [&](const Row& row) {
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

/// What the measured ratios are compared with.
class Check {
 public:
  explicit Check(const std::filesystem::path& given)
      : file_(given.empty() ? choose_ratios(committed_ratio_files(), processor_name()) : given) {
    if (file_.empty()) return;
    ratios_ = read_ratios(file_);
    const std::string here = processor_name(), there = ratios_.empty() ? here : ratios_.front().processor;
    if (here != there) loss_ = allowed_loss_elsewhere;
    std::printf("compared with %s; a loss of more than %.0f %% fails\n", file_.c_str(), 100 * loss_);
    if (here != there)
      std::printf("those ratios are of another processor (%s, here %s), hence the wide tolerance\n", there.c_str(),
                  here.c_str());
  }

  /// Measures a benchmark, again if it seems to have lost speed; keeps the last measurement.
  SpeedMeasurement judge(const Candidate& candidate, int threads) {
    SpeedMeasurement m = candidate.measure();
    const CommittedRatio* committed = find_ratio(ratios_, {candidate.labels.name, "", m.particles, threads, 0});
    if (!committed) {
      std::printf("%s: no committed ratio of %zu particles on %d threads: not judged\n", candidate.labels.name.c_str(),
                  m.particles, threads);
      return m;
    }
    ++judged_;
    bool first = true;
    const RatioVerdict verdict = judge_ratio(committed->ratio, loss_, [&] {
      if (!first) m = candidate.measure();
      first = false;
      return m.ratio();
    });
    if (verdict.tries > 1 || verdict.lost)
      std::printf("%s: ratio %.3f, committed %.3f, %d tries: %s\n", candidate.labels.name.c_str(), verdict.best,
                  committed->ratio, verdict.tries, verdict.lost ? "LOST SPEED" : "good");
    lost_ += verdict.lost;
    return m;
  }

  int exit_code() const {
    if (judged_ == 0) {
      std::printf("nothing was compared: %s\n",
                  file_.empty() ? "there is no perf/results/*/ratios.csv" : "no committed ratio fits");
      return 2;
    }
    std::printf("%d of %d benchmarks kept their speed\n", judged_ - lost_, judged_);
    return lost_ ? 1 : 0;
  }

 private:
  std::filesystem::path file_;
  std::vector<CommittedRatio> ratios_;
  double loss_ = allowed_loss;
  int judged_ = 0, lost_ = 0;
};

}  // namespace

int run_bench(const BenchOptions& options) {
  std::filesystem::create_directories(options.directory);
  ReferenceKernels reference(options.threads);
  const std::vector<Candidate> table = candidates(options, reference);
  if (table.empty()) {
    std::printf("no benchmark is called '%s'\n", options.only.c_str());
    return 2;
  }
  std::optional<Check> check;
  if (options.check) check.emplace(*options.check);
  const MachineRoofs roofs = best_of({reference.sample(), reference.sample(), reference.sample()}).wall;
  std::printf("roofs on %d threads: %.1f Gflop/s, %.1f Gbyte/s\n", options.threads, roofs.gflops, roofs.gbytes_s);
  print_head();
  std::vector<Row> rows;
  for (const Candidate& candidate : table) {
    rows.push_back({candidate.labels, check ? check->judge(candidate, options.threads) : candidate.measure()});
    print_row(rows.back());
  }
  print_cost_of_averages(rows);
  write_csv(options.directory / "bench.csv", rows, options.threads);
  return check ? check->exit_code() : 0;
}

}  // namespace geodrop
