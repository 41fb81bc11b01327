// The command line: parses, calls, and turns every way of failing into a message and an exit code.
#include <geodrop/base/error.hpp>
#include <geodrop/bench/bench.hpp>
#include <geodrop/measure/results.hpp>
#include <geodrop/reader/scene_reader.hpp>
#include <geodrop/step/run.hpp>
#include <geodrop/version.hpp>

#include "base/json.hpp"
#include "base/shell_command.hpp"
#include "bench/machine.hpp"
#include "command_line/ensemble.hpp"
#include "command_line/fall.hpp"
#include "command_line/geotube.hpp"
#include "command_line/hints.hpp"
#include "command_line/manual.hpp"
#include "command_line/new_scene.hpp"
#include "command_line/only_if.hpp"
#include "command_line/plot.hpp"
#include "command_line/release.hpp"
#include "command_line/replay.hpp"
#include "command_line/report.hpp"
#include "command_line/snapshot.hpp"
#include "command_line/sweep.hpp"
#include "command_line/verify.hpp"
#include "doubts/doubts.hpp"
#include "files/build_identity.hpp"
#include "reader/scene_schema.hpp"
#include "step/effort.hpp"
#include "transfer/levels.hpp"

#include <omp.h>

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
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
  bool overwrite = false;
  bool verify = false;
  std::string parts;
  bool growth = false;
  bool instructions = false;
  geodrop::BenchOptions bench;
  geodrop::GeotubeArguments geotube;
  geodrop::ReleaseArguments release;
  geodrop::FallArguments fall;
  geodrop::VerifyArguments verification;
  geodrop::ReplayArguments replay;
  geodrop::PlotArguments plot;
  geodrop::EnsembleArguments ensemble;
  geodrop::SweepArguments sweep;
  geodrop::SnapshotArguments snapshot;
  geodrop::ReportArguments report;
  geodrop::CompareArguments compare;
  geodrop::NewSceneArguments new_scene;
  bool json = false;
  bool completion = false;
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

/// A file that is opened first must not get the number of an output that the caller closed: what is printed would land
/// in it.
void open_closed_outputs() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(descriptor, F_GETFD) == -1 && open("/dev/null", O_RDWR) != descriptor) std::abort();
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
  options.earlier = arguments.overwrite ? geodrop::EarlierRun::overwrite : geodrop::EarlierRun::move_aside;
  options.command = geodrop::shell_command(arguments.command);
  options.resume_command = geodrop::resume_command(arguments.command);
  options.parts = step_window(arguments.parts);
  omp_set_num_threads(options.threads);
  return geodrop::run_scene(geodrop::read_scene(arguments.scene, arguments.overrides), options, arguments.verify);
}

void print_notes(const geodrop::Scene& scene) {
  for (const std::string& doubt : geodrop::doubts(scene)) std::cout << "warning: " << doubt << '\n';
  for (const std::string& note : geodrop::scene_notes(scene)) std::cout << "note: " << note << '\n';
}

std::string problems_json(const geodrop::SceneError& error) {
  std::vector<std::string> items;
  for (const geodrop::SceneProblem& problem : error.problems())
    items.push_back(geodrop::json_record({{"line", std::to_string(problem.at.line)},
                                          {"column", std::to_string(problem.at.column)},
                                          {"key", geodrop::json_text(problem.key)},
                                          {"found", geodrop::json_text(problem.found)},
                                          {"allowed", geodrop::json_text(problem.allowed)}}));
  return geodrop::json_array(items);
}

/// Mistakes, warnings and notes for other programs; the same exit codes.
int check_for_programs(const Arguments& arguments) {
  std::string problems = "[]", warnings = "[]", notes = "[]";
  int code = 0;
  try {
    const geodrop::Scene scene = geodrop::read_scene(arguments.scene, arguments.overrides);
    geodrop::check_results(scene);
    geodrop::check_first_step(scene);
    warnings = geodrop::json_texts(geodrop::doubts(scene));
    notes = geodrop::json_texts(geodrop::scene_notes(scene));
  } catch (const geodrop::SceneError& error) {
    problems = problems_json(error);
    code = exit_usage;
  }
  std::cout << geodrop::json_object({{"file", geodrop::json_text(arguments.scene)},
                                     {"problems", problems},
                                     {"warnings", warnings},
                                     {"notes", notes}})
            << '\n';
  return code;
}

int check(const Arguments& arguments) {
  if (arguments.json) return check_for_programs(arguments);
  const geodrop::Scene scene = geodrop::read_scene(arguments.scene, arguments.overrides);
  geodrop::check_results(scene);
  geodrop::check_first_step(scene);
  std::cout << arguments.scene << ": no mistakes found; " << scene.bodies.size() << " bodies, "
            << scene.membranes.size() << " membranes\n";
  print_notes(scene);
  std::cout << "a run: " << geodrop::effort_in_words(geodrop::estimate_effort(scene, 1)) << '\n';
  return 0;
}

int stages(const Arguments& arguments) {
  std::cout << geodrop::stages_text(geodrop::read_scene(arguments.scene, arguments.overrides));
  return 0;
}

/// Version and, of a scene, its facts and effort.
int info_for_programs(const Arguments& arguments, const geodrop::BuildIdentity& build) {
  std::vector<std::pair<std::string, std::string>> members{
      {"version", geodrop::json_text(build.version)},
      {"compiler", geodrop::json_text(build.compiler)},
      {"cores", std::to_string(omp_get_num_procs())},
      {"kernels", geodrop::json_text(geodrop::kernel_level_name())}};
  if (!arguments.scene.empty()) {
    const geodrop::Scene scene = geodrop::read_scene(arguments.scene, arguments.overrides);
    for (const geodrop::Fact& fact : geodrop::scene_facts(scene))
      members.emplace_back(fact.name, geodrop::json_number(fact.value));
    const geodrop::Effort effort = geodrop::estimate_effort(scene, choose_threads(0));
    members.emplace_back("wall_s", geodrop::json_number(effort.seconds));
    members.emplace_back("output_bytes", geodrop::json_number(effort.output_bytes));
  }
  std::cout << geodrop::json_object(members) << '\n';
  return 0;
}

int info(const Arguments& arguments) {
  const geodrop::BuildIdentity build = geodrop::this_build();
  if (arguments.json) return info_for_programs(arguments, build);
  std::cout << "geodrop " << build.version << ", " << build.compiler << ", " << omp_get_num_procs()
            << " cores, kernels for " << geodrop::kernel_level_name() << ", sums " << build.sums << '\n';
  if (arguments.scene.empty()) return 0;
  const geodrop::Scene scene = geodrop::read_scene(arguments.scene, arguments.overrides);
  for (const geodrop::Fact& fact : geodrop::scene_facts(scene))
    std::printf("%-36s %.6g\n", fact.name.c_str(), fact.value);
  std::fflush(stdout);
  std::cout << "a run: " << geodrop::effort_in_words(geodrop::estimate_effort(scene, choose_threads(0))) << '\n';
  print_notes(scene);
  return 0;
}

int bench(const Arguments& arguments) {
  geodrop::BenchOptions options = arguments.bench;
  options.directory = arguments.output.empty() ? "runs/bench" : arguments.output;
  options.threads = options.steps > 0 ? 1 : choose_threads(arguments.threads);
  omp_set_num_threads(options.threads);
  if (arguments.growth) return geodrop::run_growth(options);
  if (options.steps > 0) return geodrop::run_steps(options);
  if (arguments.instructions) return geodrop::run_instructions(options);
  return options.against.empty() ? geodrop::run_bench(options) : geodrop::run_against(options);
}

/// What is measured instead of the table of speeds; one of them.
void add_bench_modes(CLI::App& command, Arguments& arguments) {
  auto* growth = command.add_flag("--growth", arguments.growth,
                                  "cost against number of particles and size of the domain, on 1 and on all threads");
  auto* against =
      command.add_option("--against", arguments.bench.against,
                         "exit with 1 if a benchmark is slower than with this program or commit, in pairs in "
                         "turn on one thread (perf/README.md)");
  auto* instructions =
      command.add_flag("--instructions", arguments.instructions,
                       "count instructions by valgrind; exit with 1 if a benchmark has over 1 % more than "
                       "perf/instructions.csv says");
  command.add_flag("--update", arguments.bench.update, "with --instructions: write that table")->needs(instructions);
  auto* steps = command.add_option("--steps", arguments.bench.steps,
                                   "make so many steps of each on one thread; prints lines for programs to read: name, "
                                   "particles, steps, processor time [s]");
  steps->check(geodrop::only_if<int>([](int n) { return n >= 1; }, "a whole number > 0"));
  const std::array<CLI::Option*, 4> modes{growth, against, instructions, steps};
  for (CLI::Option* mode : modes)
    for (CLI::Option* other : modes)
      if (mode != other) mode->excludes(other);
}

void add_bench_options(CLI::App& command, Arguments& arguments) {
  geodrop::BenchOptions& bench = arguments.bench;
  command.add_flag("--quick", bench.quick, "1e5 instead of 1e6 particles, fewer repeats");
  command.add_option("--threads", arguments.threads, "number of threads (default: all cores)")->check(thread_count());
  command.add_option("--output", arguments.output, "directory for bench.csv or growth.csv (default: runs/bench)");
  command.add_option("--only", bench.only, "only benchmarks whose name contains this; =NAME: only this one");
  command.add_option("--particles", bench.particles, "particles of a block; with --growth, at most")
      ->check(geodrop::only_if<double>([](double n) { return n >= 1e3 && n <= 1e8; }, "a number from 1e3 to 1e8"));
  command.add_option("--scene", bench.scene, "main case (default: cases/dump_kekerdom.toml)");
  add_bench_modes(command, arguments);
}

void add_threads(CLI::App& command, Arguments& arguments) {
  command.add_option("--threads", arguments.threads, "number of threads (default: all cores)")->check(thread_count());
}

void add_run_options(CLI::App& command, Arguments& arguments) {
  add_scene(command, arguments);
  add_threads(command, arguments);
  command.add_option("--output", arguments.output, "run directory (default: runs/<scene>)");
  command.add_option("--until", arguments.until, "stop at this simulated time [s], with a checkpoint")
      ->check(positive_time());
  auto* resume =
      command.add_flag("--resume", arguments.resume, "go on from the newest checkpoint in the run directory");
  command
      .add_flag("--overwrite", arguments.overwrite,
                "replace an earlier run in the run directory (default: it becomes NAME.1, NAME.2, ...)")
      ->excludes(resume);
  command.add_flag("--verify", arguments.verify, "exit with 1 if an expectation of the scene is not met");
  command
      .add_option("--record-parts", arguments.parts,
                  "write a hash after each row of the steps FIRST:LAST to parts.csv, for replay")
      ->check(steps());
}

void add_json(CLI::App& command, Arguments& arguments) {
  command.add_flag("--json", arguments.json, "print JSON, for other programs");
}

void add_info_options(CLI::App& command, Arguments& arguments) {
  add_json(command, arguments);
  command.add_option("scene", arguments.scene, "scene file");
  command.add_option("--set", arguments.overrides, "override a key of the scene")->take_all()->expected(1);
}

int replay(const Arguments& arguments) {
  omp_set_num_threads(choose_threads(arguments.threads));
  return geodrop::run_replay(arguments.replay);
}

int verify(const Arguments& arguments) {
  const int threads = choose_threads(arguments.threads);
  omp_set_num_threads(threads);
  return geodrop::run_verify(arguments.verification, threads);
}

struct Command {
  CLI::App* app;
  std::function<int()> run;
};

using Sub = CLI::App;

/// About scenes, this machine, and problems that need no simulation.
template <class Add>
void add_scene_commands(const Add& add, Arguments& a) {
  add(
      "run", "run a scene; writes a run directory", [&](Sub& c) { add_run_options(c, a); }, [&] { return run(a); });
  add(
      "check", "read a scene and report every mistake, and what is doubtful",
      [&](Sub& c) {
        add_scene(c, a);
        add_json(c, a);
      },
      [&] { return check(a); });
  add(
      "stages", "print the rows of a step of this scene, with the fields that they read and write",
      [&](Sub& c) { add_scene(c, a); }, [&] { return stages(a); });
  add(
      "info", "print version and machine; with a scene, its sizes and time step",
      [&](Sub& c) { add_info_options(c, a); }, [&] { return info(a); });
  add(
      "bench", "measure million particle-steps per second; writes bench.csv", [&](Sub& c) { add_bench_options(c, a); },
      [&] { return bench(a); });
  add(
      "geotube", "the exact shape and tension of a geotube at rest",
      [&](Sub& c) { geodrop::add_geotube_options(c, a.geotube); }, [&] { return geodrop::run_geotube(a.geotube); });
  add(
      "release", "design formulas of a container that leaves a split barge",
      [&](Sub& c) { geodrop::add_release_options(c, a.release); }, [&] { return geodrop::run_release(a.release); });
  add(
      "fall", "the closed-form fall of a container in water", [&](Sub& c) { geodrop::add_fall_options(c, a.fall); },
      [&] { return geodrop::run_fall(a.fall); });
}

/// Many runs, and what they left behind.
template <class Add>
void add_result_commands(const Add& add, Arguments& a) {
  add(
      "verify", "run the cases that have an exact or published reference",
      [&](Sub& c) {
        geodrop::add_verify_options(c, a.verification);
        add_threads(c, a);
      },
      [&] { return verify(a); });
  add(
      "replay", "make a run again and say where its states differ from the recorded hashes; exit 1 if they do",
      [&](Sub& c) {
        geodrop::add_replay_options(c, a.replay);
        add_threads(c, a);
      },
      [&] { return replay(a); });
  add(
      "ensemble", "run a scene many times with inputs drawn at random; writes manifest.csv and bands.csv",
      [&](Sub& c) { geodrop::add_ensemble_options(c, a.ensemble); }, [&] { return geodrop::run_ensemble(a.ensemble); });
  add(
      "sweep", "run a scene over values of its keys; writes manifest.csv",
      [&](Sub& c) { geodrop::add_sweep_options(c, a.sweep); }, [&] { return geodrop::run_sweep(a.sweep, a.command); });
  add(
      "plot", "draw pictures of runs and sweeps: histories, columns, results over keys",
      [&](Sub& c) { geodrop::add_plot_options(c, a.plot); }, [&] { return geodrop::run_plot(a.plot); });
  add(
      "snapshot", "draw a frame of a run (PNG, no display needed)",
      [&](Sub& c) { geodrop::add_snapshot_options(c, a.snapshot); }, [&] { return geodrop::run_snapshot(a.snapshot); });
  add(
      "animate", "draw all frames of a run (GIF)", [&](Sub& c) { geodrop::add_animate_options(c, a.snapshot); },
      [&] { return geodrop::run_animate(a.snapshot); });
  add(
      "report", "write a page about a run that can be handed in (HTML, PDF)",
      [&](Sub& c) { geodrop::add_report_options(c, a.report); }, [&] { return geodrop::run_report(a.report); });
  add(
      "compare", "print runs side by side: keys, results, differences",
      [&](Sub& c) { geodrop::add_compare_options(c, a.compare); }, [&] { return geodrop::run_compare(a.compare); });
  add(
      "new", "write a scene to begin with", [&](Sub& c) { geodrop::add_new_scene_options(c, a.new_scene); },
      [&] { return geodrop::run_new_scene(a.new_scene); });
  add(
      "schema", "print a JSON schema of scene files, by which editors complete keys", [](Sub&) {},
      [] { return std::cout << geodrop::scene_schema(), 0; });
}

/// All commands, as --help lists them.
std::vector<Command> add_commands(CLI::App& app, Arguments& arguments) {
  std::vector<Command> commands;
  const auto add = [&](const char* name, const char* about, const auto& add_options, std::function<int()> run) {
    commands.push_back({app.add_subcommand(name, about), std::move(run)});
    add_options(*commands.back().app);
    commands.back().app->footer(geodrop::examples_of(name));
  };
  add_scene_commands(add, arguments);
  add_result_commands(add, arguments);
  add(
      "manual", "print the page of the manual (roff), or what a shell completes",
      [&](Sub& c) { c.add_flag("--completion", arguments.completion, "for bash"); },
      [&] {
        std::cout << (arguments.completion ? geodrop::bash_completion(app)
                                           : geodrop::manual_page(app, GEODROP_VERSION));
        return 0;
      });
  return commands;
}

/// `geodrop help` and `geodrop help COMMAND`.
int print_help(const CLI::App& app, const std::string& command) {
  const auto named = app.get_subcommands([&](const CLI::App* each) { return each->get_name() == command; });
  const CLI::App* const of = command.empty() ? &app : named.empty() ? nullptr : named.front();
  if (of)
    std::cout << of->help();
  else
    std::cerr << "geodrop: " << geodrop::hint_for(app, {"geodrop", command}) << '\n';
  return of ? 0 : exit_usage;
}

/// Exit code of the exception that is being handled, told on stderr.
int exit_code_of_exception(const CLI::App& app, const std::vector<std::string>& words) {
  const auto tell = [](const std::string& text, int code) {
    std::cerr << text << '\n';
    return code;
  };
  try {
    throw;
  } catch (const CLI::RequiredError& error) {
    if (app.get_subcommands().empty())
      return tell("geodrop: a command is missing: " + geodrop::commands_of(app) + "; geodrop --help tells more",
                  exit_usage);
    return app.exit(error) == 0 ? 0 : exit_usage;
  } catch (const CLI::ExtrasError& error) {
    const std::string hint = geodrop::hint_for(app, words);
    return hint.empty() ? (app.exit(error), exit_usage) : tell("geodrop: " + hint, exit_usage);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_usage;
  } catch (const geodrop::SceneError& error) {
    return tell(error.what(), exit_usage);
  } catch (const std::filesystem::filesystem_error& error) {
    return tell(std::string("geodrop: ") + error.what(), geodrop::exit_not_written);
  } catch (const geodrop::WriteError& error) {
    return tell(std::string("geodrop: ") + error.what(), geodrop::exit_not_written);
  } catch (const geodrop::RunError& error) {
    return tell(std::string("geodrop: ") + error.what(), 1);
  } catch (const std::bad_alloc&) {
    return tell("geodrop: not enough memory", 1);
  } catch (const std::exception& error) {
    return tell(std::string("geodrop: internal error: ") + error.what(), exit_internal);
  }
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): what is thrown before options are read is a mistake of the program
int main(int argc, char** argv) {
  open_closed_outputs();
  restart_with_patient_threads(argv);
  CLI::App app{"geodrop: Material Point Method for soil, water and geotextile", "geodrop"};
  app.set_version_flag("--version", std::string("geodrop ") + GEODROP_VERSION);
  app.require_subcommand(0, 1);  // none is reported below, after what was not understood
  Arguments arguments;
  arguments.command = typed_command(argc, argv);
  const std::vector<Command> commands = add_commands(app, arguments);
  try {
    if (argc > 1 && std::string(argv[1]) == "help") return print_help(app, argc > 2 ? argv[2] : "");
    app.parse(argc, argv);
    for (const Command& command : commands)
      if (*command.app) return command.run();
    throw CLI::RequiredError::Subcommand(1);
  } catch (...) {
    return exit_code_of_exception(app, arguments.command);
  }
}
