// The whole run directory: what is in it, what may be replaced, and that a resumed run leaves the same files.
#include <geodrop/base/error.hpp>
#include <geodrop/base/stop_signal.hpp>
#include <geodrop/files/output.hpp>

#include "base/json.hpp"
#include "base/text.hpp"
#include "files/build_identity.hpp"
#include "files/console.hpp"
#include "files/run_directory.hpp"
#include "support/near.hpp"
#include "support/scene_files.hpp"
#include "support/small_state.hpp"
#include "support/text.hpp"

#include <doctest/doctest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>

using namespace geodrop;
using namespace geodrop::test;
using geodrop::test::contains;

namespace {

/// Physics of a test: the pool falls, and says so in its state.
void advance_by_hand(State<2>& state, double dt) {
  for (std::size_t p = 0; p < state.bodies[0].size(); ++p) {
    state.bodies[0].v[1][p] -= 10 * dt;
    state.bodies[0].x[1][p] += dt * state.bodies[0].v[1][p];
  }
  state.t += dt;
  ++state.step;
}

constexpr double dt = 0.0625;  ///< a power of two, so that times are exact

/// Steps until `end` as the step loop does.
void step_until(Output<2>& output, State<2>& state, double end) {
  while (state.t < end) {
    advance_by_hand(state, dt);
    if (output.history_due(state.t)) output.write_history(Frame<2>(state));
    if (output.frame_due(state.t)) output.write_frame(Frame<2>(state));
    output.progress(state.t, state.step);
  }
}

RunOptions options_for(const std::filesystem::path& directory, bool resume = false) {
  RunOptions options;
  options.directory = directory;
  options.threads = 2;
  options.resume = resume;
  return options;
}

Scene scene_with_results() {
  Scene scene = small_scene();
  ResultSpec spec;
  spec.name = "speed_max_m_s";
  spec.column = "pool.velocity_y_m_s";
  spec.reduce = Reduction::min;
  spec.scale = -1;
  spec.to = 10;
  scene.results = {spec};
  scene.expect = {{"speed_max_m_s", 10, 0.1, "g t, \"Galilei\"", {}}};
  return scene;
}

RunStatistics statistics_of(RunStatus status) {
  RunStatistics statistics;
  statistics.status = status;
  statistics.wall_seconds = 2;
  statistics.steps = 16;
  statistics.stages = {{"sort", 0.5}, {"scatter", 1.5}};
  statistics.facts = {{"bed.skempton_b_ratio", 0.96}};
  return statistics;
}

Summary run_whole(const Scene& scene, const std::filesystem::path& directory) {
  Output<2> output(scene, options_for(directory));
  State<2> state = small_state();
  output.start(Frame<2>(state));
  step_until(output, state, scene.time.end);
  return output.finish(Frame<2>(state), statistics_of(RunStatus::done));
}

std::size_t count_lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("a run leaves the files that users and scripts rely on") {
  const TemporaryDirectory directory;
  const Scene scene = scene_with_results();
  const Summary summary = run_whole(scene, directory / "run");
  CHECK(summary.expectations_met);
  CHECK(summary.results.at(0).value == near(10, 1e-12));

  CHECK(read_file(directory / "run/scene.toml") == scene.as_run);
  CHECK(count_lines(read_file(directory / "run/history.csv")) == 1 + 5);  // header; t = 0, 0.25, ... 1
  const std::string log = read_file(directory / "run/run.log");
  CHECK(log.starts_with("geodrop "));
  CHECK(contains(log, "scene cases/small.toml"));
  CHECK(contains(log, "frame 2"));
  CHECK(contains(log, "scatter         1.5       75"));
  CHECK(contains(log, "speed_max_m_s     10  m/s         10      +-0.1  yes  g t, \"Galilei\""));
  for (const char* name : {"particles_000000.vtu", "particles_000002.vtu", "membranes_000002.vtp", "particles.pvd"})
    CHECK(std::filesystem::exists(directory / "run" / name));
  CHECK_FALSE(std::filesystem::exists(directory / "run/particles_000003.vtu"));

  const Json json = Json::parse(read_file(directory / "run/summary.json"));
  CHECK(json.at("status") == "done");
  CHECK(json.at("threads") == 2);
  CHECK(json.at("compiler") == geodrop::this_build().compiler);
  CHECK(json.at("sums") == geodrop::this_build().sums);
  CHECK(json.at("steps") == 16);
  CHECK(json.at("particles") == 8);
  CHECK(json.at("wall_s") == 2);
  CHECK(json.at("particle_steps_per_s") == 64);
  CHECK(json.at("stages").at(0) == Json{{"name", "sort"}, {"seconds", 0.5}});
  CHECK(json.at("facts").at("bed.skempton_b_ratio") == Json{{"value", 0.96}, {"unit", "1"}});
  CHECK(json.at("results").at("speed_max_m_s") == Json{{"value", 10.0}, {"unit", "m/s"}});
  const Json& expectation = json.at("expectations").at(0);
  CHECK(expectation.at("tolerance") == 0.1);
  CHECK(expectation.at("source") == "g t, \"Galilei\"");
  CHECK(expectation.at("met") == true);
  CHECK(json.at("state_hash") == summary.state_hash);
}

TEST_CASE("a stopped and resumed run leaves the rows and the hash of an uninterrupted one") {
  const TemporaryDirectory directory;
  const Scene scene = scene_with_results();
  const Summary whole = run_whole(scene, directory / "whole");
  {
    RunOptions options = options_for(directory / "halved");
    options.resume_command = "geodrop run cases/small.toml --resume";
    Output<2> output(scene, options);
    State<2> state = small_state();
    output.start(Frame<2>(state));
    step_until(output, state, 0.625);
    output.checkpoint(Frame<2>(state));
    output.finish(Frame<2>(state), statistics_of(RunStatus::stopped));
    CHECK(contains(read_file(directory / "halved/run.log"), "\ngo on with: geodrop run cases/small.toml --resume\n"));
    CHECK(contains(read_file(directory / "halved/summary.json"), "\"status\": \"stopped\""));
    step_until(output, state, 0.875);  // and a crash: these rows and frames are not in the checkpoint
    output.write_frame(Frame<2>(state));
  }
  Output<2> output(scene, options_for(directory / "halved", true));
  State<2> state = output.resume();
  CHECK(state.t == 0.625);
  CHECK_FALSE(std::filesystem::exists(directory / "halved/particles_000002.vtu"));
  CHECK_FALSE(contains(read_file(directory / "halved/particles.pvd"), "particles_000002"));
  step_until(output, state, scene.time.end);
  const Summary resumed = output.finish(Frame<2>(state), statistics_of(RunStatus::done));
  CHECK(resumed.state_hash == whole.state_hash);
  CHECK(resumed.results.at(0).value == whole.results.at(0).value);
  CHECK(read_file(directory / "halved/history.csv") == read_file(directory / "whole/history.csv"));
  // The picture of the stop is gone.
  CHECK(read_file(directory / "halved/particles.pvd") == read_file(directory / "whole/particles.pvd"));
  CHECK_FALSE(std::filesystem::exists(directory / "halved/particles_000003.vtu"));
}

TEST_CASE("each multiple of an interval is written once, at the first time at or after it") {
  const TemporaryDirectory directory;
  Scene scene = small_scene();
  scene.output.history_interval = 0.1;
  scene.output.frame_interval = 0.3;
  Output<2> output(scene, options_for(directory / "run"));
  State<2> state = small_state();
  CHECK(output.history_due(0));
  output.start(Frame<2>(state));
  const auto write_at = [&](double t) {
    state.t = t;
    const bool due = output.history_due(t);
    if (due) output.write_history(Frame<2>(state));
    return due;
  };
  CHECK_FALSE(write_at(0.09));
  CHECK(write_at(0.11));
  CHECK_FALSE(write_at(0.12));
  CHECK(write_at(0.2));
  CHECK_FALSE(write_at(0.2));
  CHECK(write_at(0.55));  // a step over two multiples is one row
  CHECK_FALSE(write_at(0.59));
  CHECK(write_at(0.6));
  CHECK_FALSE(output.frame_due(0.29));
  CHECK(output.frame_due(0.3));
}

TEST_CASE("an earlier run moves aside with all that is in its directory, or is replaced; nothing else is touched") {
  const TemporaryDirectory directory;
  const Scene scene = scene_with_results();
  run_whole(scene, directory / "run");
  std::ofstream(directory / "run/notes.txt") << "mine";
  {
    RunOptions options = options_for(directory / "run");
    options.earlier = EarlierRun::overwrite;
    Output<2> again(scene, options);
    CHECK_FALSE(std::filesystem::exists(directory / "run/particles_000002.vtu"));
    CHECK_FALSE(std::filesystem::exists(directory / "run/checkpoint.bin"));
    CHECK_FALSE(std::filesystem::exists(directory / "run/summary.json"));
    CHECK(contains(read_file(directory / "run/run.log"), "replaced an earlier run"));
    CHECK(read_file(directory / "run/notes.txt") == "mine");
  }
  CHECK_FALSE(std::filesystem::exists(directory / "run.1"));
  run_whole(scene, directory / "run");
  CHECK(read_file(directory / "run.1/notes.txt") == "mine");
  CHECK_FALSE(std::filesystem::exists(directory / "run/notes.txt"));
  CHECK(contains(read_file(directory / "run/run.log"), "was moved aside, to " + (directory / "run.1").string() + "\n"));
  std::filesystem::remove_all(directory / "run.1");
  std::filesystem::create_directory(directory / "run.7");
  std::filesystem::create_directory_symlink(directory / "run", directory / "link");
  run_whole(scene, directory / "link");  // what the link leads to moves, and the newest has the largest number
  CHECK(std::filesystem::exists(directory / "run.8/particles_000002.vtu"));
  CHECK(std::filesystem::is_symlink(directory / "link"));
  CHECK(std::filesystem::exists(directory / "run/particles_000002.vtu"));
  std::filesystem::create_directory(directory / "thesis");
  std::ofstream(directory / "thesis/scene.toml") << "chapter one";
  std::ofstream(directory / "thesis/run.log") << "log of another program";
  CHECK_THROWS_AS(Output<2>(scene, options_for(directory / "thesis")), SceneError);
  CHECK(read_file(directory / "thesis/scene.toml") == "chapter one");
  CHECK_THROWS_AS(Output<2>(scene, options_for(directory / "thesis/scene.toml")), SceneError);
}

TEST_CASE("what is refused leaves no run directory") {
  const TemporaryDirectory directory;
  Scene scene = scene_with_results();
  scene.results[0].column = "no.such_column_m";
  CHECK_THROWS_AS(Output<2>(scene, options_for(directory / "run")), SceneError);
  CHECK_THROWS_AS(Output<2>(small_scene(), options_for(directory / "run", true)), SceneError);
  CHECK_FALSE(std::filesystem::exists(directory / "run"));
  CHECK(choose_directory(scene, "") == "runs/small");
}

TEST_CASE("frames that the disk does not take are written once there is room, and the checkpoint has them") {
  const TemporaryDirectory directory;
  const Scene scene = small_scene();
  const Summary whole = run_whole(scene, directory / "whole");
  {
    Output<2> output(scene, options_for(directory / "run"));
    std::filesystem::create_directory(directory / "run/particles_000001.vtu.part");  // in the way
    State<2> state = small_state();
    output.start(Frame<2>(state));
    CHECK_FALSE(output.blocked());
    CHECK(std::filesystem::file_size(directory / "run/checkpoint.reserve") > 100000);
    step_until(output, state, 0.5);
    while (!output.blocked()) usleep(1000);
    CHECK(contains(output.trouble(), "particles_000001.vtu: "));
    std::filesystem::remove(directory / "run/particles_000001.vtu.part");
    output.checkpoint(Frame<2>(state));
    CHECK(std::filesystem::exists(directory / "run/particles_000001.vtu"));
    CHECK_FALSE(std::filesystem::exists(directory / "run/checkpoint.reserve"));
    CHECK_NOTHROW(output.finish(Frame<2>(state), statistics_of(RunStatus::stopped)));
    CHECK(
        contains(read_file(directory / "run/summary.json"), "\"status\": \"blocked\",\n  \"message\": \"cannot write"));
    CHECK(contains(read_file(directory / "run/run.log"),
                   "of t = 0.5 s, is on the disk; once there is room again, go on"));
  }
  Output<2> output(scene, options_for(directory / "run", true));
  State<2> state = output.resume();
  step_until(output, state, scene.time.end);
  CHECK(output.finish(Frame<2>(state), statistics_of(RunStatus::done)).state_hash == whole.state_hash);
  for (const char* name : {"history.csv", "particles.pvd", "particles_000001.vtu"})
    CHECK(read_file(directory / "run" / name) == read_file(directory / "whole" / name));
}

TEST_CASE("frames that the disk does not take in the end are missing in a resumed run, which says so") {
  const TemporaryDirectory directory;
  const Scene scene = small_scene();
  {
    Output<2> output(scene, options_for(directory / "run"));
    std::filesystem::create_directory(directory / "run/particles_000001.vtu.part");
    State<2> state = small_state();
    output.start(Frame<2>(state));
    step_until(output, state, 0.5);
    output.checkpoint(Frame<2>(state));
    CHECK(output.blocked());
    output.finish(Frame<2>(state), statistics_of(RunStatus::stopped));
  }
  std::filesystem::remove(directory / "run/particles_000001.vtu.part");
  Output<2> output(scene, options_for(directory / "run", true));
  State<2> state = output.resume();
  CHECK(contains(read_file(directory / "run/run.log"),
                 "warning: the frames from number 1 to 1, before the checkpoint, are not on the disk"));
  step_until(output, state, scene.time.end);
  output.finish(Frame<2>(state), statistics_of(RunStatus::done));
  CHECK(
      contains(read_file(directory / "run/particles.pvd"), "timestep=\"1\" part=\"0\" file=\"particles_000001.vtu\""));
}

TEST_CASE("a log that cannot be written is refused with the system's reason") {
  const TemporaryDirectory directory;
  CHECK_THROWS_WITH_AS(Console(directory / "missing/run.log", LogMode::begin, Telling::terminal),
                       doctest::Contains("No such file"), WriteError);
}

TEST_CASE("the table of stages") {
  CHECK(stage_table({{"sort", 1}, {"gather", 3}}, 1e9) ==
        "stage       seconds  percent  ns per particle-step\n"
        "sort              1       25                     1\n"
        "gather            3       75                     3\n"
        "all stages        4      100                     4\n");
}

TEST_CASE("durations and the progress line") {
  CHECK(format_duration(34.4) == "0:34");
  CHECK(format_duration(3 * 3600 + 125) == "3:02:05");
  CHECK(format_duration(0.0 / 0.0) == "-");
  CHECK(seconds_left(30, 0.25) == 90);
  CHECK(seconds_left(30, 1.01) == 0);
  Progress progress(4.0, 1000);
  progress.begin(0, 0);
  CHECK(contains(progress.line(0, 0), "  0.0 %  t 0/4 s  step 0"));
  CHECK(contains(progress.line(0, 0), "ETA -"));
  usleep(50000);
  const std::string line = progress.line(4, 100);
  CHECK(contains(line, "100.0 %  t 4/4 s  step 100"));
  CHECK(line.size() < 80);
  CHECK(contains(line, "ETA 0:00 at "));
}

TEST_CASE("signals: what asks to stop, what ends the program, what asks for a checkpoint, what is no concern") {
  constexpr int stopped = 75, checkpoint = 3, nothing = 2;
  const auto exit_of = [](
                           const std::vector<int>& signals, void (*before)() = [] {}) {
    const pid_t child = fork();
    if (child == 0) {
      before();
      catch_signals();
      if (stop_requested() || take_checkpoint_request()) _exit(1);
      for (const int signal : signals) raise(signal);
      if (stop_requested()) _exit(stopped);
      _exit(take_checkpoint_request() && !take_checkpoint_request() ? checkpoint : nothing);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  };
  CHECK(exit_of({}) == nothing);
  CHECK(exit_of({SIGTERM}) == stopped);
  CHECK(exit_of({SIGINT}) == stopped);
  CHECK(exit_of({SIGTERM, SIGINT}) == 130);
  CHECK(exit_of({SIGHUP}) == stopped);
  CHECK(exit_of({SIGHUP, SIGHUP, SIGTERM}) == stopped);
  CHECK(exit_of({SIGHUP}, [] { std::signal(SIGHUP, SIG_IGN); }) == nothing);  // nohup
  CHECK(exit_of({SIGUSR1, SIGUSR1}) == checkpoint);
  CHECK(exit_of({SIGPIPE, SIGXFSZ}) == nothing);
}
