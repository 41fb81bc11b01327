// The command line: parses, calls, and turns every way of failing into a message and an exit code.
#include <geodrop/bench.hpp>
#include <geodrop/error.hpp>
#include <geodrop/run.hpp>
#include <geodrop/scene_reader.hpp>
#include <geodrop/version.hpp>

#include "command_line/fall.hpp"
#include "command_line/geotube.hpp"
#include "command_line/only_if.hpp"
#include "command_line/plot.hpp"
#include "command_line/release.hpp"
#include "command_line/replay.hpp"
#include "command_line/verify.hpp"
#include "kernels/levels.hpp"
#include "output/shell_command.hpp"

#include <omp.h>

#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>
#include <optional>

namespace {

constexpr int exit_usage = 2;
constexpr int exit_internal = 70;

struct Arguments {
  std::string scene;
  std::vector<std::string> overrides;
  std::string output;
  int threads = 0;
  double until = 0;
  bool resume = false;
  bool verify = false;
  std::string parts;
  bool quick = false;
  bool growth = false;
  std::string only;
  double particles = 0;
  std::string bench_scene;
  std::string ratios;
  bool compare = false;
  std::vector<std::string> command;  ///< as the user typed it, the program first
};

void add_scene(CLI::App& command, Arguments& arguments) {
  command.add_option("scene", arguments.scene, "scene file (TOML, see docs/scene.md)")->required();
  command.add_option("--set", arguments.overrides, "override a key of the scene, e.g. --set grid.spacing=0.125")
      ->take_all()
      ->expected(1);
}

/// The wrapper script says under which name it was called.
std::vector<std::string> typed_command(int argc, char** argv) {
  std::vector<std::string> words(argv, argv + argc);
  if (const char* wrapper = std::getenv("GEODROP_WRAPPER"); wrapper && !words.empty()) words.front() = wrapper;
  return words;
}

CLI::Validator positive_time() {
  return geodrop::only_if<double>([](double t) { return t > 0; }, "a time > 0 [s]");
}

/// "FIRST:LAST" as two whole numbers in order; empty if it is anything else.
std::optional<geodrop::StepWindow> step_window(const std::string& text) {
  geodrop::StepWindow window;
  const char* const end = text.data() + text.size();
  const auto [colon, first] = std::from_chars(text.data(), end, window.first);
  if (first != std::errc() || colon == end || *colon != ':') return std::nullopt;
  const auto [after, last] = std::from_chars(colon + 1, end, window.last);
  if (last != std::errc() || after != end || window.last < window.first) return std::nullopt;
  return window;
}

CLI::Validator steps() {
  return geodrop::only_if<std::string>([](const std::string& text) { return step_window(text).has_value(); },
                                       "FIRST:LAST, two steps");
}

/// Far above what pays on any machine, far below what the system refuses, which would end the program without a word.
CLI::Validator thread_count() {
  constexpr int most = 1024;
  return geodrop::only_if<int>([](int n) { return n >= 1 && n <= most; },
                               "a whole number from 1 to " + std::to_string(most));
}

/// libgomp reads how long a waiting thread spins before the program can say so; hence one restart with the answer.
/// Its own default spins for milliseconds: beside other busy processes a step then takes 30 times as long (main case on
/// 2 busy cores: 1680 ns per particle-step; with 1000 spins 82, idle machine: 44 either way).
void restart_with_patient_threads(char** argv) {
  if (std::getenv("GOMP_SPINCOUNT") || std::getenv("OMP_WAIT_POLICY")) return;
  setenv("GOMP_SPINCOUNT", "1000", 1);
  execv("/proc/self/exe", argv);
}

/// Number of threads to use; warns if there are fewer cores.
int choose_threads(int asked) {
  const int cores = omp_get_num_procs();
  if (asked == 0) return cores;
  if (asked > cores)
    std::cerr << "geodrop: warning: " << asked << " threads on " << cores << " cores: slower, same result\n";
  return asked;
}

int run(const Arguments& arguments) {
  geodrop::RunOptions options;
  options.directory = arguments.output;
  options.threads = choose_threads(arguments.threads);
  options.resume = arguments.resume;
  options.end = arguments.until;
  options.resume_command = geodrop::resume_command(arguments.command);
  options.parts = step_window(arguments.parts);
  omp_set_num_threads(options.threads);
  return geodrop::run_scene(geodrop::read_scene(arguments.scene, arguments.overrides), options, arguments.verify);
}

int check(const Arguments& arguments) {
  const geodrop::Scene scene = geodrop::read_scene(arguments.scene, arguments.overrides);
  std::cout << arguments.scene << ": no mistakes found; " << scene.bodies.size() << " bodies, "
            << scene.membranes.size() << " membranes\n";
  return 0;
}

int stages(const Arguments& arguments) {
  std::cout << geodrop::stages_text(geodrop::read_scene(arguments.scene, arguments.overrides));
  return 0;
}

int info(const Arguments& arguments) {
  std::cout << "geodrop " << GEODROP_VERSION << ", compiler " << __VERSION__ << ", " << omp_get_num_procs()
            << " cores, kernels for " << geodrop::kernel_level_name() << ", sums " << geodrop::kernel_arithmetic()
            << '\n';
  if (arguments.scene.empty()) return 0;
  for (const geodrop::Fact& fact : geodrop::scene_facts(geodrop::read_scene(arguments.scene, arguments.overrides)))
    std::printf("%-36s %.6g\n", fact.name.c_str(), fact.value);
  return 0;
}

int bench(const Arguments& arguments) {
  // One thread is judged by processor time, which other processes hardly disturb.
  const bool steady = arguments.compare && arguments.threads == 0;
  const int threads = steady ? 1 : choose_threads(arguments.threads);
  omp_set_num_threads(threads);
  geodrop::BenchOptions options;
  options.directory = arguments.output.empty() ? "runs/bench" : arguments.output;
  options.threads = threads;
  options.quick = arguments.quick || arguments.compare;
  options.only = arguments.only;
  options.particles = arguments.particles;
  options.scene = arguments.bench_scene;
  if (arguments.compare) options.check = arguments.ratios;
  return arguments.growth ? geodrop::run_growth(options) : geodrop::run_bench(options);
}

void add_bench_options(CLI::App& command, Arguments& arguments) {
  command.add_flag("--quick", arguments.quick, "1e5 instead of 1e6 particles, fewer repeats");
  command.add_option("--threads", arguments.threads, "number of threads (default: all cores)")->check(thread_count());
  command.add_option("--output", arguments.output, "directory for bench.csv or growth.csv (default: runs/bench)");
  command.add_option("--only", arguments.only, "only benchmarks whose name contains this");
  command.add_option("--particles", arguments.particles, "particles of a block; with --growth, at most")
      ->check(geodrop::only_if<double>([](double n) { return n >= 1e3 && n <= 1e8; }, "a number from 1e3 to 1e8"));
  command.add_option("--scene", arguments.bench_scene, "main case (default: cases/dump_kekerdom.toml)");
  auto* growth = command.add_flag("--growth", arguments.growth,
                                  "cost against number of particles and size of the domain, on 1 and on all threads");
  command
      .add_option("--check", arguments.ratios,
                  "as --quick, on one thread unless --threads says otherwise, and exit with 1 if a benchmark lost more "
                  "than 10 % against the ratios of this file (default: those of perf/results)")
      ->expected(0, 1)
      ->excludes(growth);
}

}  // namespace

int main(int argc, char** argv) {
  restart_with_patient_threads(argv);
  CLI::App app{"geodrop: Material Point Method for soil, water and geotextile", "geodrop"};
  app.set_version_flag("--version", std::string("geodrop ") + GEODROP_VERSION);
  app.require_subcommand(0, 1);  // none is reported below, after what was not understood
  Arguments arguments;
  arguments.command = typed_command(argc, argv);

  auto* run_command = app.add_subcommand("run", "run a scene; writes a run directory");
  add_scene(*run_command, arguments);
  run_command->add_option("--threads", arguments.threads, "number of threads (default: all cores)")
      ->check(thread_count());
  run_command->add_option("--output", arguments.output, "run directory (default: runs/<scene>)");
  run_command->add_option("--until", arguments.until, "stop at this simulated time [s], with a checkpoint")
      ->check(positive_time());
  run_command->add_flag("--resume", arguments.resume, "go on from the checkpoint in the run directory");
  run_command->add_flag("--verify", arguments.verify, "exit with 1 if an expectation of the scene is not met");
  run_command
      ->add_option("--record-parts", arguments.parts,
                   "write a hash after each stage of the steps FIRST:LAST to parts.csv, for replay")
      ->check(steps());
  auto* check_command = app.add_subcommand("check", "read a scene and report every mistake");
  add_scene(*check_command, arguments);
  auto* stages_command = app.add_subcommand("stages", "print the stages of a step of this scene");
  add_scene(*stages_command, arguments);
  auto* info_command = app.add_subcommand("info", "print version and machine; with a scene, its sizes and time step");
  info_command->add_option("scene", arguments.scene, "scene file");
  info_command->add_option("--set", arguments.overrides, "override a key of the scene")->take_all()->expected(1);

  auto* bench_command = app.add_subcommand("bench", "measure million particle-steps per second; writes bench.csv");
  add_bench_options(*bench_command, arguments);
  auto* geotube_command = app.add_subcommand("geotube", "the exact shape and tension of a geotube at rest");
  geodrop::GeotubeArguments geotube;
  geodrop::add_geotube_options(*geotube_command, geotube);
  auto* release_command = app.add_subcommand("release", "design formulas of a container that leaves a split barge");
  geodrop::ReleaseArguments release;
  geodrop::add_release_options(*release_command, release);
  auto* fall_command = app.add_subcommand("fall", "the closed-form fall of a container in water");
  geodrop::FallArguments fall;
  geodrop::add_fall_options(*fall_command, fall);
  auto* verify_command = app.add_subcommand("verify", "run the cases that have an exact or published reference");
  geodrop::VerifyArguments verify;
  geodrop::add_verify_options(*verify_command, verify);
  verify_command->add_option("--threads", arguments.threads, "number of threads (default: all cores)")
      ->check(thread_count());
  auto* replay_command = app.add_subcommand(
      "replay", "make a run again and say where its states differ from the recorded hashes; exit 1 if they do");
  geodrop::ReplayArguments replay;
  geodrop::add_replay_options(*replay_command, replay);
  replay_command->add_option("--threads", arguments.threads, "number of threads (default: all cores)")
      ->check(thread_count());
  auto* plot_command = app.add_subcommand("plot", "draw pictures of a run directory");
  geodrop::PlotArguments plot;
  geodrop::add_plot_options(*plot_command, plot);

  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) throw CLI::RequiredError::Subcommand(1);
    if (*run_command) return run(arguments);
    if (*check_command) return check(arguments);
    if (*stages_command) return stages(arguments);
    arguments.compare = bench_command->count("--check") > 0;
    if (*bench_command) return bench(arguments);
    if (*geotube_command) return geodrop::run_geotube(geotube);
    if (*release_command) return geodrop::run_release(release);
    if (*fall_command) return geodrop::run_fall(fall);
    if (*plot_command) return geodrop::run_plot(plot);
    if (*replay_command) {
      omp_set_num_threads(choose_threads(arguments.threads));
      return geodrop::run_replay(replay);
    }
    if (*verify_command) {
      const int threads = choose_threads(arguments.threads);
      omp_set_num_threads(threads);
      return geodrop::run_verify(verify, threads);
    }
    return info(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_usage;
  } catch (const geodrop::SceneError& error) {
    std::cerr << error.what() << '\n';
    return exit_usage;
  } catch (const geodrop::RunError& error) {
    std::cerr << "geodrop: " << error.what() << '\n';
    return 1;
  } catch (const std::bad_alloc&) {
    std::cerr << "geodrop: not enough memory\n";
    return 1;
  } catch (const std::exception& error) {
    std::cerr << "geodrop: internal error: " << error.what() << '\n';
    return exit_internal;
  }
}
