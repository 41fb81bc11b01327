// The command line: parses, calls, and turns every way of failing into a message and an exit code.
#include <geodrop/base/error.hpp>
#include <geodrop/step/run.hpp>

#include "command_line/bench.hpp"
#include "command_line/check.hpp"
#include "command_line/ensemble.hpp"
#include "command_line/exit_codes.hpp"
#include "command_line/fall.hpp"
#include "command_line/geotube.hpp"
#include "command_line/hints.hpp"
#include "command_line/manual.hpp"
#include "command_line/new_scene.hpp"
#include "command_line/plot.hpp"
#include "command_line/release.hpp"
#include "command_line/replay.hpp"
#include "command_line/report.hpp"
#include "command_line/run.hpp"
#include "command_line/snapshot.hpp"
#include "command_line/sweep.hpp"
#include "command_line/threads.hpp"
#include "command_line/verify.hpp"
#include "files/build_identity.hpp"
#include "reader/scene_schema.hpp"

#include <omp.h>

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <new>

namespace {

struct Arguments {
  geodrop::RunArguments run;
  geodrop::CheckArguments check;
  geodrop::BenchArguments bench;
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
  int threads = 0;
  bool completion = false;
  std::vector<std::string> command;  ///< as the user typed it, the program first
};

/// The wrapper script says under which name it was called.
std::vector<std::string> typed_command(int argc, char** argv) {
  std::vector<std::string> words(argv, argv + argc);
  if (const char* wrapper = std::getenv("GEODROP_WRAPPER"); wrapper && !words.empty()) words.front() = wrapper;
  return words;
}

/// libgomp reads how long a waiting thread spins before the program can say so; hence one restart with the answer.
/// Where threads have to sleep at each loop a step of the main case takes 1.4 to 1.6 times as long on an idle virtual
/// machine (h = 0.25 m, 1144 steps: 7.5 s; 5.4 s where they sleep in stages on one thread, 100,000 spins; 5.0 s where
/// they never do); where they spin beside other busy processes, 15 times as long. A run that may take fewer threads
/// notices the latter (step/thread_choice).
void restart_with_patience(char** argv) {
  if (std::getenv("GOMP_SPINCOUNT") || std::getenv("OMP_WAIT_POLICY")) return;
  bool run = false, exact = false;
  for (char** word = argv; *word; ++word) {
    run = run || (word == argv + 1 && std::string(*word) == "run");
    exact = exact || std::string(*word) == geodrop::exact_threads;
  }
  setenv("GOMP_SPINCOUNT", run && !exact ? "1000000" : "1000", 1);
  execv("/proc/self/exe", argv);
}

/// A file that is opened first must not get the number of an output that the caller closed: what is printed would land
/// in it.
void open_closed_outputs() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(descriptor, F_GETFD) == -1 && open("/dev/null", O_RDWR) != descriptor) std::abort();
}

int replay(const Arguments& arguments) {
  omp_set_num_threads(geodrop::choose_threads(arguments.threads));
  return geodrop::run_replay(arguments.replay);
}

int verify(const Arguments& arguments) {
  const int threads = geodrop::choose_threads(arguments.threads);
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
      "run", "run a scene; writes a run directory", [&](Sub& c) { geodrop::add_run_options(c, a.run); },
      [&] { return geodrop::start_run(a.run, a.command); });
  add(
      "check", "read a scene and report every mistake, and what is doubtful",
      [&](Sub& c) { geodrop::add_check_options(c, a.check); }, [&] { return geodrop::run_check(a.check); });
  add(
      "stages", "print the rows of a step of this scene, with the fields that they read and write",
      [&](Sub& c) { geodrop::add_scene(c, a.check.scene, a.check.overrides); },
      [&] { return geodrop::run_stages(a.check); });
  add(
      "info", "print version and machine; with a scene, its sizes and time step",
      [&](Sub& c) { geodrop::add_info_options(c, a.check); }, [&] { return geodrop::run_info(a.check); });
  add(
      "bench", "measure million particle-steps per second; writes bench.csv",
      [&](Sub& c) { geodrop::add_bench_options(c, a.bench); }, [&] { return geodrop::run_bench_command(a.bench); });
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
        geodrop::add_threads(c, a.threads);
      },
      [&] { return verify(a); });
  add(
      "replay", "make a run again and say where its states differ from the recorded hashes; exit 1 if they do",
      [&](Sub& c) {
        geodrop::add_replay_options(c, a.replay);
        geodrop::add_threads(c, a.threads);
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
                                           : geodrop::manual_page(app, geodrop::this_build().version));
        return 0;
      });
  return commands;
}

/// `geodrop help` and `geodrop help COMMAND`.
int print_help(const CLI::App& app, const std::string& command) {
  const auto named = app.get_subcommands([&](const CLI::App* each) { return each->get_name() == command; });
  const CLI::App* const of = command.empty() ? &app : named.empty() ? nullptr : named.front();
  if (of)
    std::cout << (of == &app ? app.help() : of->help(app.get_name()));
  else
    std::cerr << "geodrop: " << geodrop::hint_for(app, {"geodrop", command}) << '\n';
  return of ? 0 : geodrop::exit_usage;
}

/// What CLI does not take: what was probably meant, and what is missing or wrong. A mistyped option may be the cause of
/// what is missing.
std::string text_of(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words) {
  const std::string hint = geodrop::hint_for(app, words);
  const bool unknown_words = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
  if (unknown_words && !hint.empty()) return "geodrop: " + hint;
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  const std::string command = chosen.empty() ? "" : chosen.front()->get_name();
  const std::string message = "geodrop" + (command.empty() ? "" : " " + command) + ": " + error.what();
  if (!hint.empty()) return "geodrop: " + hint + '\n' + message;
  const std::string example = geodrop::first_example(command);
  return example.empty() || message.find("allowed: ") != std::string::npos ? message : message + "; e.g. " + example;
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
                  geodrop::exit_usage);
    return tell(text_of(app, error, words), geodrop::exit_usage);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return tell(text_of(app, error, words), geodrop::exit_usage);
  } catch (const geodrop::SceneError& error) {
    return tell(error.what(), geodrop::exit_usage);
  } catch (const std::filesystem::filesystem_error& error) {
    return tell(std::string("geodrop: ") + error.what(), geodrop::exit_not_written);
  } catch (const geodrop::WriteError& error) {
    return tell(std::string("geodrop: ") + error.what(), geodrop::exit_not_written);
  } catch (const geodrop::RunError& error) {
    return tell(std::string("geodrop: ") + error.what(), 1);
  } catch (const std::bad_alloc&) {
    return tell("geodrop: not enough memory", 1);
  } catch (const std::exception& error) {
    return tell(std::string("geodrop: internal error: ") + error.what(), geodrop::exit_internal);
  }
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): what is thrown before options are read is a mistake of the program
int main(int argc, char** argv) {
  open_closed_outputs();
  restart_with_patience(argv);
  CLI::App app{"geodrop: Material Point Method for soil, water and geotextile", "geodrop"};
  app.set_version_flag("--version", "geodrop " + geodrop::this_build().version);
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
