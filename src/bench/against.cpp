// `bench --against`: this version and another one in turn, in processor time, until it is clear whether this one is
// slower.
#include "child.hpp"
#include "machine.hpp"
#include "pairs.hpp"
#include "steps.hpp"

#include <geodrop/base/error.hpp>

#include <cstdio>
#include <stdexcept>

namespace geodrop {
namespace {

/// Processor time of one go of a version: steps of a benchmark, or a short run of a scene.
using Go = std::function<double(const std::string& program)>;

StepTime time_steps(const std::string& program, const std::vector<std::string>& arguments, int steps) {
  std::vector<std::string> words{program, "bench", "--steps", std::to_string(steps)};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const ChildOutcome outcome = run_child(words);
  const StepReport report = outcome.code == 0 ? parse_steps(outcome.out) : StepReport{};
  if (report.times.size() != 1 || !(report.times.front().seconds > 0))
    throw std::runtime_error(program + " could not make the steps of its benchmark");
  return report.times.front();
}

/// The build of a commit of this source tree; it stays in build/against.
std::string build_commit(const std::string& commit) {
  const std::filesystem::path script = find_in_tree("perf/build_commit");
  const ChildOutcome outcome = script.empty() ? ChildOutcome{1, 0, ""} : run_child({script.string(), commit});
  if (outcome.code == 0) return outcome.out.substr(0, outcome.out.find('\n'));
  throw SceneError(commit, {{{},
                             "--against",
                             "no such program, and no commit that can be built",
                             "a program, or a commit of the source tree",
                             ProblemSource::elsewhere}});
}

bool makes_steps(const std::string& program) {
  return run_child({program, "bench", "--steps", "1", "--particles", "1000", "--only", "=water_2d_linear"},
                   ChildErrors::drop)
             .code == 0;
}

/// Steps that take about a quarter of a second, in whole pairs of the stretches of 16 between which a block turns
/// round.
int enough_steps(const std::vector<std::string>& arguments) {
  constexpr int pair = 32, most = 100 * pair;
  constexpr double aim = 0.25;  // [s]
  const double once = time_steps(own_program(), arguments, pair).seconds;
  int steps = pair;
  while (steps < most && once * steps / pair < aim) steps += pair;
  return steps;
}

/// The old and the new version change places from pair to pair, so that a machine that slows down favours neither.
PairOutcome compare(const std::string& old_program, const Go& go) {
  return compare_in_pairs({}, [&](int pair) {
    double old_time = 0, new_time = 0;
    if (pair % 2 == 0) old_time = go(old_program);
    new_time = go(own_program());
    if (pair % 2 == 1) old_time = go(old_program);
    return new_time / old_time;
  });
}

/// Prints the outcome; 1 if it is a loss.
int report(const std::string& name, const PairOutcome& outcome) {
  const auto percent = [](double ratio) { return 100 * (ratio - 1); };
  const char* const verdict = outcome.verdict == PairVerdict::slower       ? "SLOWER"
                              : outcome.verdict == PairVerdict::not_slower ? "not slower"
                                                                           : "not clear, not counted as slower";
  std::printf("%-28s %+7.2f %+7.2f %+7.2f %6d  %s\n", name.c_str(), percent(outcome.ratio.median),
              percent(outcome.ratio.lower), percent(outcome.ratio.upper), outcome.pairs, verdict);
  std::fflush(stdout);
  return outcome.verdict == PairVerdict::slower;
}

/// Without --only those whose transfers and laws most runs spend their time in.
bool compared(const BenchOptions& options, const Benchmark& bench) {
  if (!options.only.empty()) return selected(options, bench.name);
  const bool material = bench.material == BenchMaterial::water || bench.material == BenchMaterial::soil;
  const bool basis = bench.basis == Basis::bspline2 || bench.basis == Basis::linear;
  return material && basis && bench.transfer == Transfer::tpic && bench.pressure == PressureSupport::particle &&
         !bench.at_rest && !bench.graded;
}

int compare_benchmarks(const BenchOptions& options, const std::string& old_program) {
  std::vector<std::string> names;
  for (const Benchmark& bench : all_benchmarks())
    if (compared(options, bench)) names.push_back(bench.name);
  for (const SceneBenchmark& bench : scene_benchmarks())
    if (selected(options, bench.name)) names.push_back(bench.name);
  const double particles = options.particles > 0 ? options.particles : 2e4;
  int slower = 0;
  for (const std::string& name : names) {
    const std::vector<std::string> arguments{"--only", "=" + name, "--particles", std::to_string(particles)};
    const int steps = enough_steps(arguments);
    slower += report(name, compare(old_program, [&](const std::string& program) {
                       return time_steps(program, arguments, steps).seconds;
                     }));
  }
  if (names.empty()) return no_benchmark(options);
  return slower ? 1 : 0;
}

/// For versions that have no --steps: all processor time of a short run.
int compare_runs(const BenchOptions& options, const std::string& old_program) {
  const std::filesystem::path scene =
      options.scene.empty() ? find_in_tree("cases/hydrostatic_column.toml") : options.scene;
  std::printf("%s has no bench --steps: compared by whole runs of %s\n", old_program.c_str(), scene.c_str());
  const std::filesystem::path directory = options.directory / "against";
  return report(scene.stem().string(), compare(old_program, [&](const std::string& program) {
                  std::filesystem::remove_all(directory);
                  const ChildOutcome outcome =
                      run_child({program, "run", scene.string(), "--threads", "1", "--output", directory.string()});
                  std::filesystem::remove_all(directory);
                  if (outcome.code != 0) throw std::runtime_error(program + " could not run " + scene.string());
                  return outcome.processor_seconds;
                }));
}

}  // namespace

int run_against(const BenchOptions& options) {
  const bool is_program = std::filesystem::is_regular_file(options.against);
  const std::string old_program =
      is_program ? std::filesystem::absolute(options.against).string() : build_commit(options.against);
  const PairRules rules;
  std::printf("against %s, %d to %d pairs; slower: 95 %% interval of the median above %+g %%\n", old_program.c_str(),
              rules.least, rules.most, 100 * rules.limit);
  std::printf("%-28s %7s %7s %7s %6s\n", "name", "time", "from", "to [%]", "pairs");
  return makes_steps(old_program) ? compare_benchmarks(options, old_program) : compare_runs(options, old_program);
}

}  // namespace geodrop
