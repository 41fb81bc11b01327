#include "steps.hpp"

#include "base/levels.hpp"
#include "base/nearest_name.hpp"
#include "counted_steps.hpp"
#include "machine.hpp"

#include <geodrop/reader/scene_reader.hpp>

#include <cstdio>
#include <sstream>
#include <stdexcept>

namespace geodrop {
namespace {

void print(const StepTime& time) {
  end_count();
  std::printf("steps %s %zu %d %.9g\n", time.name.c_str(), time.particles, time.steps, time.seconds);
  std::fflush(stdout);
}

}  // namespace

bool selected(const BenchOptions& options, const std::string& name) {
  if (options.only.starts_with('=')) return name == options.only.substr(1);
  return name.find(options.only) != std::string::npos;
}

int no_benchmark(const BenchOptions& options) {
  std::vector<std::string> names;
  for (const Benchmark& bench : all_benchmarks()) names.push_back(bench.name);
  for (const SceneBenchmark& bench : scene_benchmarks()) names.push_back(bench.name);
  const std::string nearest = nearest_name(options.only.substr(options.only.starts_with('=') ? 1 : 0), names);
  std::fprintf(stderr, "geodrop bench: no benchmark is called '%s'; allowed: a part of a name, e.g. %s\n",
               options.only.c_str(), (nearest.empty() ? names.front() : nearest).c_str());
  return 2;
}

std::optional<Scene> scene_of(const SceneBenchmark& bench, const BenchOptions& options) {
  const bool replaced = bench.name == scene_benchmarks().front().name && !options.scene.empty();
  const std::filesystem::path file = replaced ? options.scene : find_in_tree(bench.file);
  if (!file.empty()) return read_scene(file.string(), bench.overrides);
  std::fprintf(stderr, "%s is left out: there is no %s above this program or this directory\n", bench.name.c_str(),
               bench.file.c_str());
  return std::nullopt;
}

std::string build_name() { return std::string("g++ ") + __VERSION__ + " " + kernel_level_name(); }

int run_steps(const BenchOptions& options) {
  BlockSize size;
  size.particles = options.particles > 0 ? options.particles : 1e5;
  std::printf("build %s\n", build_name().c_str());
  bool any = false;
  for (const Benchmark& bench : all_benchmarks())
    if (selected(options, bench.name)) {
      print(time_block(bench, size, options.steps));
      any = true;
    }
  for (const SceneBenchmark& bench : scene_benchmarks())
    if (selected(options, bench.name))
      if (const std::optional<Scene> scene = scene_of(bench, options)) {
        print(time_scene(bench.name, *scene, options.steps));
        any = true;
      }
  return any ? 0 : no_benchmark(options);
}

StepReport parse_steps(const std::string& text) {
  StepReport report;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind >> std::ws;
    StepTime time;
    if (kind == "build")
      std::getline(words, report.build);
    else if (kind == "steps" && words >> time.name >> time.particles >> time.steps >> time.seconds)
      report.times.push_back(time);
    else
      throw std::runtime_error("not a line of bench --steps: " + line);
  }
  return report;
}

}  // namespace geodrop
