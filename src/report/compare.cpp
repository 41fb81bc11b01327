#include "compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/figures.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "files/run_record.hpp"
#include "scene_values.hpp"

namespace geodrop {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::vector<std::string>>;

std::string name_of(const fs::path& run) { return (run / "").parent_path().filename().string(); }

std::string text_of(const Lines& lines, char others) {
  return format_table(lines, 'l' + std::string(lines.front().size() - 1, others));
}

std::vector<std::string> head_of(const std::string& first, const std::vector<fs::path>& runs) {
  std::vector<std::string> head{first};
  for (const fs::path& run : runs) head.push_back(name_of(run));
  return head;
}

std::string differing_keys(const std::vector<fs::path>& runs) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<std::string>> values;
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (const auto& [key, value] : flat_scene(runs[r] / "scene.toml")) {
      if (!values.contains(key)) order.push_back(key);
      auto& of_key = values[key];
      of_key.resize(runs.size(), "-");
      of_key[r] = value;
    }
  Lines lines{head_of("key", runs)};
  for (const std::string& key : order) {
    const auto& all = values[key];
    if (std::ranges::all_of(all, [&](const std::string& value) { return value == all.front(); })) continue;
    lines.push_back({key});
    lines.back().insert(lines.back().end(), all.begin(), all.end());
  }
  return lines.size() == 1 ? "The scenes are the same.\n" : text_of(lines, 'l');
}

void add_difference(std::vector<std::string>& line, double first, double second, const Scaled& unit) {
  constexpr int digits = 3;
  const double difference = second - first;
  line.push_back((difference > 0 ? "+" : "") + figure(difference, unit));
  const double percent = 100 * difference / std::abs(first);
  line.push_back(std::isfinite(percent) ? (percent > 0 ? "+" : "") + format_number(percent, digits) + " %" : "-");
}

std::string results(const std::vector<fs::path>& runs, const std::vector<RunRecord>& records) {
  std::vector<std::string> names;
  for (const RunRecord& record : records)
    for (const Result& result : record.results)
      if (std::ranges::find(names, result.name) == names.end()) names.push_back(result.name);
  Lines lines{head_of("result", runs)};
  const bool pair = runs.size() == 2;
  if (pair) lines.front().insert(lines.front().end(), {"difference", "of the first"});
  for (const std::string& name : names) {
    std::vector<double> values;
    for (const RunRecord& record : records) values.push_back(record.result(name));
    double largest = 0;
    for (const double value : values)
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    const Scaled unit = scaled_unit(unit_of_name(name), largest);
    lines.push_back({name + (unit.unit.empty() ? "" : " [" + unit.unit + "]")});
    for (const double value : values) lines.back().push_back(figure(value, unit));
    if (pair) add_difference(lines.back(), values[0], values[1], unit);
  }
  return lines.size() == 1 ? "No results.\n" : text_of(lines, 'r');
}

std::string effort(const std::vector<fs::path>& runs, const std::vector<RunRecord>& records) {
  Lines lines{head_of("run", runs), {"status"},  {"time [s]"}, {"particles"}, {"steps"},
              {"wall time"},        {"version"}, {"state"}};
  for (const RunRecord& record : records) {
    const auto once_over = [&](const std::string& cell) { return record.is_running() ? "-" : cell; };
    const std::vector<std::string> cells{record.status,
                                         once_over(figure(record.run.t, Scaled{})),
                                         std::to_string(record.run.particles),
                                         once_over(std::to_string(record.run.steps)),
                                         once_over(format_duration(record.wall_seconds)),
                                         record.version,
                                         record.state_hash};
    for (std::size_t i = 0; i < cells.size(); ++i) lines[i + 1].push_back(cells[i]);
  }
  return text_of(lines, 'l');
}

}  // namespace

std::string compare_runs(const std::vector<fs::path>& runs) {
  std::vector<RunRecord> records;
  for (const fs::path& run : runs) records.push_back(read_run_record(run));
  return differing_keys(runs) + "\n" + results(runs, records) + "\n" + effort(runs, records);
}

}  // namespace geodrop
