#include "summary.hpp"

#include <geodrop/reader/scene_reader.hpp>

#include "base/json.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "build_identity.hpp"

#include <sys/resource.h>

#include <array>
#include <ctime>
#include <utility>
#include <vector>

namespace geodrop {
namespace {

Json value_with_unit(double value, const std::string& unit) { return {{"value", value}, {"unit", unit}}; }

Json json_of(const std::vector<Result>& results) {
  Json members = Json::object();
  for (const Result& result : results) members[result.name] = value_with_unit(result.value, result.unit);
  return members;
}

Json json_of(const std::vector<Fact>& facts) {
  Json members = Json::object();
  for (const Fact& fact : facts) members[fact.name] = value_with_unit(fact.value, unit_of_name(fact.name));
  return members;
}

Json json_of(const std::vector<Expectation>& expectations) {
  Json items = Json::array();
  for (const Expectation& each : expectations)
    items.push_back({{"name", each.result.name},
                     {"value", each.result.value},
                     {"expected", each.expected},
                     {"tolerance", each.tolerance},
                     {"source", each.source},
                     {"met", each.met}});
  return items;
}

Json json_of(const std::vector<StageTime>& stages) {
  Json items = Json::array();
  for (const StageTime& stage : stages) items.push_back({{"name", stage.name}, {"seconds", stage.seconds}});
  return items;
}

/// Largest resident memory of this process so far [byte].
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  constexpr double kibibyte = 1024;
  return kibibyte * static_cast<double>(usage.ru_maxrss);
}

}  // namespace

std::string date_and_time() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text;
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

std::string status_name(RunStatus status) {
  switch (status) {
    case RunStatus::running:
      return "running";
    case RunStatus::done:
      return "done";
    case RunStatus::stopped:
      return "stopped";
    case RunStatus::blocked:
      return "blocked";
    case RunStatus::failed:
      return "failed";
  }
  return "";
}

std::string summary_json(const Scene& scene, const RunIdentity& run, const RunStatistics& statistics,
                         const Summary& summary) {
  const double particle_steps = static_cast<double>(statistics.steps) * static_cast<double>(run.particles);
  return json_text({{"status", status_name(statistics.status)},
                    {"message", statistics.message},
                    {"warnings", summary.warnings},
                    {"started", run.started},
                    {"ended", run.ended},
                    {"host", run.host},
                    {"command", run.command},
                    {"version", this_build().version},
                    {"compiler", this_build().compiler},
                    {"sums", this_build().sums},
                    {"scene", scene.file},
                    {"title", scene.title},
                    {"threads", run.threads},
                    {"time_s", run.t},
                    {"steps", run.steps},
                    {"steps_in_this_process", statistics.steps},
                    {"particles", run.particles},
                    {"wall_s", statistics.wall_seconds},
                    {"particle_steps_per_s", particle_steps / statistics.wall_seconds},
                    {"peak_memory_bytes", peak_memory()},
                    {"state_hash", summary.state_hash},
                    {"stages", json_of(statistics.stages)},
                    {"facts", json_of(statistics.facts)},
                    {"results", json_of(summary.results)},
                    {"expectations", json_of(summary.expectations)}});
}

std::string stage_table(const std::vector<StageTime>& stages, double particle_steps) {
  constexpr double nanosecond = 1e-9;
  constexpr int digits = 3;
  double total = 0;
  for (const StageTime& stage : stages) total += stage.seconds;
  std::vector<std::vector<std::string>> lines = {{"stage", "seconds", "percent", "ns per particle-step"}};
  const auto add = [&](const std::string& name, double seconds) {
    lines.push_back({name, format_number(seconds, digits), format_number(100 * seconds / total, digits),
                     format_number(seconds / nanosecond / particle_steps, digits)});
  };
  for (const StageTime& stage : stages) add(stage.name, stage.seconds);
  add("all stages", total);
  return format_table(lines, "lrrr");
}

}  // namespace geodrop
