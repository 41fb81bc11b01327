// A run that was stopped and resumed leaves what an uninterrupted run leaves, bit for bit.
#include <doctest/doctest.h>

#include <csignal>
#include <filesystem>
#include <thread>

#include "support/program.hpp"

using namespace geodrop::test;

namespace {

const std::string scene = "cases/dump_kekerdom_mixture.toml";
const std::vector<std::string> settings{"grid.spacing=0.5", "time.end=0.1"};

/// All that a run leaves and that must not depend on interruptions.
struct Left {
  std::string hash, history, frames;
  explicit Left(const SceneRun& run)
      : hash(run.hash()),
        history(geodrop::read_file(run.file("history.csv"))),
        frames(geodrop::read_file(run.file("particles.pvd"))) {}
  bool operator==(const Left&) const = default;
};

const Left& uninterrupted() {
  static const Left left(SceneRun(scene, settings, {"--threads", "1"}));
  return left;
}

/// Stopped by --until and resumed on other threads: the hash and the history of an uninterrupted run on one.
void check_resumed(const std::string& file, const std::vector<std::string>& changes, const std::string& until) {
  const Left whole(SceneRun(file, changes, {"--threads", "1"}));
  SceneRun run(file, changes, {"--exact-threads", "--threads", "2", "--until", until});
  CHECK(run.outcome().code == 75);
  CHECK(run.hash() != whole.hash);
  CHECK(run.again({"--exact-threads", "--threads", "3", "--resume"}).code == 0);
  CHECK(run.hash() == whole.hash);
  CHECK(geodrop::read_file(run.file("history.csv")) == whole.history);
}

}  // namespace

TEST_CASE("Stopped by --until and resumed, also on other threads: the same hash and history") {
  SceneRun run(scene, settings, {"--exact-threads", "--threads", "2", "--until", "0.043"});
  CHECK(run.outcome().code == 75);
  CHECK(run.text("status") == "stopped");
  CHECK(std::filesystem::exists(run.file("checkpoint.bin")));
  CHECK(run.hash() != uninterrupted().hash);
  CHECK(run.again({"--exact-threads", "--threads", "3", "--resume"}).code == 0);
  CHECK(run.text("status") == "done");
  CHECK(run.hash() == uninterrupted().hash);
  CHECK(geodrop::read_file(run.file("history.csv")) == uninterrupted().history);
}

TEST_CASE("Stopped twice and resumed: the same hash and history") {
  SceneRun run(scene, settings, {"--until", "0.021"});
  CHECK(run.again({"--resume", "--until", "0.062"}).code == 75);
  CHECK(run.again({"--resume"}).code == 0);
  CHECK(run.hash() == uninterrupted().hash);
  CHECK(geodrop::read_file(run.file("history.csv")) == uninterrupted().history);
}

TEST_CASE("In space: stopped by --until and resumed on other threads, the same hash and history") {
  check_resumed("tests/scenes/run_up_3d.toml", {"bodies.water.jitter=0.3", "bodies.water.shift=true"}, "0.031");
}

TEST_CASE("On graded axes: stopped by --until and resumed on other threads, the same hash and history") {
  std::vector<std::string> graded = settings;
  graded.push_back("grid.refine=[{axis='x',from=-1.5,to=1.5,spacing=0.25}]");
  graded.push_back("time.end=0.05");
  check_resumed(scene, graded, "0.021");
}

TEST_CASE("Water in the pores of a soil, pumped: stopped and resumed, the same hash and history") {
  check_resumed("cases/verification/quick_condition.toml",
                {"bodies.soil.jitter=0.3", "output.history_interval=0.005", "time.end=0.05"}, "0.021");
}

TEST_CASE("Soil with a critical porosity that collapses in oil, drag of Forchheimer: stopped and resumed, the same") {
  check_resumed("cases/verification/submerged_column_loose.toml",
                {"bodies.column.jitter=0.2", "materials.beads.forchheimer_coefficient=1e3", "time.end=0.05"}, "0.021");
}

TEST_CASE("Tube on the ground, enclosed, pumped up, with contact and relaxation: stopped and resumed, the same") {
  // Stopped while the pump runs, springs of friction are stretched and a cycle of the relaxation is under way.
  check_resumed("tests/scenes/tube.toml", {"grid.spacing=0.2", "time.end=1.0"}, "0.031");
}

TEST_CASE("Sharp interface: stopped and resumed, the same") {
  check_resumed("cases/dump_kekerdom.toml", {"grid.refine=[]", "time.end=0.1"}, "0.031");
}

TEST_CASE("Sharp interface in space: stopped and resumed, the same") {
  check_resumed("cases/verification/sphere_release_3d.toml",
                {"grid.spacing=0.5", "bodies.water.jitter=0.2", "time.end=0.006"}, "0.002");
}

TEST_CASE("Consistent mass beside a sharp membrane: stopped and resumed on other threads, the same") {
  check_resumed(
      "cases/verification/sphere_release_3d.toml",
      {"grid.spacing=0.5", "solver.mass_matrix=consistent_at_membranes", "bodies.water.jitter=0.2", "time.end=0.006"},
      "0.002");
}

TEST_CASE("Sharp interface in space on graded axes: stopped and resumed on other threads, the same") {
  check_resumed("cases/verification/sphere_release_3d.toml",
                {"grid.spacing=0.5", "grid.refine=[{axis='z',from=-1.3,to=1.3,spacing=0.25,growth=1.3}]",
                 "bodies.water.jitter=0.2", "time.end=0.006"},
                "0.002");
}

TEST_CASE(
    "A quarter of a sharp surface in space, which ends at two walls: stopped and resumed on other threads, the same") {
  check_resumed("cases/verification/sphere_release_3d.toml",
                {"grid.spacing=0.5", "grid.upper=[0.0, 0.0, 2.0]", "bodies.water.shape.upper=[0.0, 0.0, 2.0]",
                 "membranes.skin.ends_at=[\"right\", \"back\"]", "bodies.water.jitter=0.2", "time.end=0.006"},
                "0.002");
}

TEST_CASE("Sand with open voids: stopped and resumed, the same") {
  check_resumed("tests/scenes/thrown_sand.toml", {"bodies.column.jitter=0.2", "time.end=0.5"}, "0.21");
}

TEST_CASE("Ground that swings on a viscous boundary with its spring: stopped and resumed, the same") {
  check_resumed(
      "tests/scenes/viscous_bed.toml",
      {"gravity.1=-12", "bodies.bed.jitter=0.2", "time.end=0.3", "solver.transfer=blend", "solver.blend_rate=10"},
      "0.11");
}

TEST_CASE("Water between silent sides, which remember a flow: stopped and resumed, the same") {
  check_resumed("tests/scenes/round_pulse.toml", {"grid.spacing=0.5", "time.end=0.2"}, "0.11");
}

TEST_CASE("Bare and skinned blocks between rigid bodies that move: stopped and resumed, the same") {
  check_resumed("tests/scenes/ramp.toml", {}, "0.12");
}

TEST_CASE("Stages, contact between bodies: stopped in each stage and resumed, the same") {
  // Before the block is there, and while it rubs with springs stretched and damping rises.
  for (const char* until : {"0.03", "0.12"})
    check_resumed("tests/scenes/block_on_slab.toml",
                  {"time.end=0.2",
                   "stages=[{name='slab',from=0.0,damping_rate=4.0},"
                   "{name='both',from=0.05,places=['block'],damping_rate=6.0,damping_ramp=0.1}]",
                   "probes=[{name='cut',type='section',body='block',x=2.0},"
                   "{name='rider',type='tracer',position=[2.0,1.5]}]"},
                  until);
}

TEST_CASE("Ctrl-C: code 75, a checkpoint, how to resume; then the same hash as without") {
  // Long enough to be hit: about 5 s; resumed only up to a time that an uninterrupted run reaches as well.
  const std::vector<std::string> longer{"grid.spacing=0.5", "time.end=3"};
  SceneRun run(scene, longer, {"--until", "0.001"});  // makes the directory
  std::filesystem::remove_all(run.file(""));
  const Program program(run.arguments({"--exact-threads", "--threads", "2"}));
  for (int k = 0; k < 1000 && !std::filesystem::exists(run.file("particles_000001.vtu")); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  program.signal(SIGINT);
  const Outcome outcome = program.wait();
  CHECK(outcome.code == 75);
  CHECK(run.text("status") == "stopped");
  CHECK(std::filesystem::exists(run.file("checkpoint.bin")));
  CHECK((outcome.out + outcome.err).find("--resume") != std::string::npos);
  const double stopped_at = run.column("time_s").back(), end = stopped_at + 0.2;
  REQUIRE(end < 3);
  CHECK(run.again({"--resume", "--until", std::to_string(end)}).code == 75);
  const SceneRun whole(scene, longer, {"--until", std::to_string(end)});
  CHECK(run.hash() == whole.hash());
  CHECK(geodrop::read_file(run.file("history.csv")) == geodrop::read_file(whole.file("history.csv")));
}
