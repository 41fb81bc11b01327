// A disk that fills up beside a run: nothing that was computed is lost, and the run goes on once there is room.
#include <doctest/doctest.h>

#include "support/not_tested.hpp"
#include "support/survival.hpp"

using namespace geodrop::test;

namespace {

/// A shell, root in a name space of its own, where it may mount a disk of memory.
int shell_with_disk(const std::string& disk, const std::string& size, const std::string& script) {
  return shell("unshare --user --map-root-user --mount sh -c 'mount -t tmpfs -o size=" + size + " tmpfs " + disk +
               " && { " + script + "; }' >/dev/null 2>&1");
}

}  // namespace

TEST_CASE("A disk that is full in the middle of a run: 74, a checkpoint; with room again the same files") {
  const geodrop::TemporaryDirectory directory;
  const std::string disk = directory / "disk", out = directory / "out";
  std::filesystem::create_directory(disk);
  if (shell_with_disk(disk, "1m", "true") != 0) {
    not_tested("no disk of memory can be mounted here");
    return;
  }
  const SceneRun whole(drop, short_drop(), {"--threads", "1"});
  SceneRun run(drop, short_drop(), {}, SceneRun::Begin::later);
  const std::string to_disk = disk + "/run";
  std::vector<std::string> arguments = run.arguments({"--threads", "1"});
  for (std::string& word : arguments)
    if (word == run.file("").parent_path().string()) word = to_disk;
  // The quotes of the words end and begin again those of the script.
  std::string begin = in_shell(arguments), quoted;
  for (const char letter : begin) quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  const std::string script = quoted + " >" + out + "; echo $? >" + out + ".first; cat " + to_disk + "/summary.json >" +
                             out + ".summary; mount -o remount,size=64m " + disk + "; " + quoted + " --resume >" + out +
                             ".second && cp -r " + to_disk + " " + run.file("").parent_path().string();
  CHECK(shell_with_disk(disk, "3m", script) == 0);
  CHECK(geodrop::read_file(out + ".first") == "74\n");
  CHECK(contains(geodrop::read_file(out + ".summary"), "\"status\": \"blocked\",\n  \"message\": \"cannot write"));
  CHECK(contains(geodrop::read_file(out), "is on the disk; once there is room again, go on with: "));
  CHECK_FALSE(contains(geodrop::read_file(out + ".second"), "not on the disk"));
  check_same(run, whole);
}

TEST_CASE("A limit on the size of files: 74, not an end by a signal") {
  SceneRun run(drop, short_drop(), {}, SceneRun::Begin::later);
  const std::string say = (run.file("").parent_path().string() + ".said");
  CHECK(shell("ulimit -f 64; " + in_shell(run.arguments({"--threads", "1"})) + " >" + say + " 2>&1") == 74);
  CHECK(contains(geodrop::read_file(say), "\nno checkpoint could be written\n"));
  CHECK(contains(geodrop::read_file(say), "\ncannot write " + run.file("particles_000000.vtu").string()));
}

TEST_CASE("A directory that cannot be written: 74 and the reason") {
  const Outcome outcome = run_program({"run", geodrop::source_path(drop), "--output", "/proc/geodrop"});
  CHECK(outcome.code == 74);
  CHECK(contains(outcome.err, "cannot make the directory /proc/geodrop: "));
}
