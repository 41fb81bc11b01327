#include "run_report.hpp"

#include <geodrop/reader/scene_reader.hpp>

#include <thread>
#include <vector>

#include "base/text.hpp"
#include "base/units.hpp"
#include "build_identity.hpp"
#include "run_lock.hpp"

namespace geodrop {

std::string describe_run(const Scene& scene, const RunOptions& options) {
  return "geodrop " + this_build().version + " on " + host_name() + ", " + std::to_string(options.threads) + " of " +
         std::to_string(std::thread::hardware_concurrency()) + " threads, scene " + scene.file;
}

std::string facts_text(const std::vector<Fact>& facts) {
  std::vector<std::vector<std::string>> lines;
  for (const Fact& fact : facts)
    lines.push_back({fact.name, short_number(fact.value), shown_unit(unit_of_name(fact.name))});
  return format_table(lines, "lrl");
}

/// What stands before the command that goes on; empty if none does.
std::string how_to_go_on(RunStatus status, std::optional<double> checkpoint) {
  if (!checkpoint || status == RunStatus::done) return "";
  const std::string of = "the last checkpoint, of t = " + format_number(*checkpoint, time_digits) + " s, ";
  if (status == RunStatus::failed) return of + "is from before the break and is kept; back to it with: ";
  if (status == RunStatus::blocked) return of + "is on the disk; once there is room again, go on with: ";
  return "go on with: ";
}

}  // namespace geodrop
