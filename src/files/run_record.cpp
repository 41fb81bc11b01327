#include "run_record.hpp"

#include <geodrop/base/error.hpp>

#include <cmath>
#include <limits>

#include "base/atomic_file.hpp"
#include "base/json.hpp"
#include "base/units.hpp"

namespace geodrop {
namespace {

/// Of a member that another version may not have written.
template <class T>
T member(const Json& of, const char* name, const T& otherwise = {}) {
  const auto found = of.find(name);
  return found == of.end() || found->is_null() ? otherwise : found->get<T>();
}

/// JSON has no word for what is not finite: null.
double number(const Json& of, const char* name) { return member(of, name, std::numeric_limits<double>::quiet_NaN()); }

RunRecord record_of(const Json& json) {
  RunRecord record;
  record.status = member<std::string>(json, "status");
  record.message = member<std::string>(json, "message");
  record.version = member<std::string>(json, "version");
  record.scene = member<std::string>(json, "scene");
  record.title = member<std::string>(json, "title");
  record.state_hash = member<std::string>(json, "state_hash");
  record.warnings = member<std::vector<std::string>>(json, "warnings");
  record.wall_seconds = number(json, "wall_s");
  record.run = {member<std::string>(json, "started"), member<std::string>(json, "ended"),
                member<std::string>(json, "host"),    member<std::string>(json, "command"),
                member<int>(json, "threads"),         member<std::uint64_t>(json, "steps"),
                member<double>(json, "time_s"),       member<std::size_t>(json, "particles")};
  const Json none = Json::array(), nothing = Json::object();
  const Json stages = json.value("stages", none), expectations = json.value("expectations", none);
  const Json facts = json.value("facts", nothing), results = json.value("results", nothing);
  for (const Json& stage : stages)
    record.stages.push_back({member<std::string>(stage, "name"), number(stage, "seconds")});
  for (const auto& [name, fact] : facts.items()) record.facts.push_back({name, number(fact, "value")});
  for (const auto& [name, result] : results.items())
    record.results.push_back({name, number(result, "value"), member<std::string>(result, "unit")});
  for (const Json& each : expectations) {
    const auto name = member<std::string>(each, "name");
    record.expectations.push_back({{name, number(each, "value"), unit_of_name(name)},
                                   number(each, "expected"),
                                   number(each, "tolerance"),
                                   member<std::string>(each, "source"),
                                   member<bool>(each, "met")});
  }
  return record;
}

}  // namespace

double RunRecord::result(const std::string& name) const {
  for (const Result& each : results)
    if (each.name == name) return each.value;
  return std::numeric_limits<double>::quiet_NaN();
}

std::optional<RunRecord> find_run_record(const std::filesystem::path& directory) {
  const std::string text = text_of_file(directory / "summary.json");
  if (text.empty()) return std::nullopt;
  try {
    return record_of(Json::parse(text));
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

RunRecord read_run_record(const std::filesystem::path& directory) {
  if (auto record = find_run_record(directory)) return *std::move(record);
  const std::filesystem::path file = directory / "summary.json";
  const std::string found = std::filesystem::exists(file) ? "no summary of a run" : "no such file";
  throw SceneError(file.string(), {{{}, "", found, "the directory of a run", ProblemSource::elsewhere}});
}

}  // namespace geodrop
