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

using Members = std::vector<std::pair<std::string, std::string>>;

std::string value_json(double value, const std::string& unit) {
  return json_record({{"value", json_number(value)}, {"unit", json_text(unit)}});
}

std::string results_json(const std::vector<Result>& results) {
  Members members;
  for (const Result& result : results) members.emplace_back(result.name, value_json(result.value, result.unit));
  return json_object(members);
}

std::string facts_json(const std::vector<Fact>& facts) {
  Members members;
  for (const Fact& fact : facts) members.emplace_back(fact.name, value_json(fact.value, unit_of_name(fact.name)));
  return json_object(members);
}

std::string expectations_json(const std::vector<Expectation>& expectations) {
  std::vector<std::string> items;
  for (const Expectation& each : expectations)
    items.push_back(json_record({{"name", json_text(each.result.name)},
                                 {"value", json_number(each.result.value)},
                                 {"expected", json_number(each.expected)},
                                 {"tolerance", json_number(each.tolerance)},
                                 {"source", json_text(each.source)},
                                 {"met", each.met ? "true" : "false"}}));
  return json_array(items);
}

std::string stages_json(const std::vector<StageTime>& stages) {
  std::vector<std::string> items;
  for (const StageTime& stage : stages)
    items.push_back(json_record({{"name", json_text(stage.name)}, {"seconds", json_number(stage.seconds)}}));
  return json_array(items);
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
  return json_object({{"status", json_text(status_name(statistics.status))},
                      {"message", json_text(statistics.message)},
                      {"warnings", json_texts(summary.warnings)},
                      {"started", json_text(run.started)},
                      {"ended", json_text(run.ended)},
                      {"host", json_text(run.host)},
                      {"command", json_text(run.command)},
                      {"version", json_text(this_build().version)},
                      {"scene", json_text(scene.file)},
                      {"title", json_text(scene.title)},
                      {"threads", std::to_string(run.threads)},
                      {"time_s", json_number(run.t)},
                      {"steps", std::to_string(run.steps)},
                      {"steps_in_this_process", std::to_string(statistics.steps)},
                      {"particles", std::to_string(run.particles)},
                      {"wall_s", json_number(statistics.wall_seconds)},
                      {"particle_steps_per_s", json_number(particle_steps / statistics.wall_seconds)},
                      {"peak_memory_bytes", json_number(peak_memory())},
                      {"state_hash", json_text(summary.state_hash)},
                      {"stages", stages_json(statistics.stages)},
                      {"facts", facts_json(statistics.facts)},
                      {"results", results_json(summary.results)},
                      {"expectations", expectations_json(summary.expectations)}}) +
         "\n";
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
