#include "batch.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/base/stop_signal.hpp>
#include <geodrop/files/output.hpp>
#include <geodrop/reader/scene_reader.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <iostream>
#include <limits>
#include <thread>

#include "base/atomic_file.hpp"
#include "base/text.hpp"
#include "bench/child.hpp"
#include "files/run_directory.hpp"
#include "files/run_lock.hpp"
#include "files/run_record.hpp"
#include "keys/key.hpp"

namespace geodrop {
namespace {

namespace fs = std::filesystem;

/// At least three digits, as many for each run.
std::string padded(std::size_t number, std::size_t count) {
  constexpr std::size_t least = 3;
  const std::string text = std::to_string(number);
  const std::size_t width = std::max(std::to_string(count).size(), least);
  return std::string(width - std::min(width, text.size()), '0') + text;
}

/// key=value; of keys joined by + each.
std::vector<std::string> settings(const std::vector<std::string>& keys, const std::vector<std::string>& values) {
  std::vector<std::string> list;
  for (std::size_t k = 0; k < keys.size(); ++k)
    for (const std::string& key : split(keys[k], '+')) list.push_back(key + '=' + values[k]);
  return list;
}

/// A cell of a table: values of keys may hold commas.
std::string cell(const std::string& text) { return text.find(',') == std::string::npos ? text : '"' + text + '"'; }

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i == 0 ? "" : ",") + cell(cells[i]);
  return line + '\n';
}

/// Runs of an earlier call that was killed may still be at work, to write their checkpoint.
void wait_for_earlier_run(const fs::path& directory) {
  if (const auto who = run_at_work(directory))
    std::cout << directory.filename().string() + ": waits for " + *who + ", which is at work there\n" << std::flush;
  while (run_at_work(directory) && !stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

}  // namespace

std::string state_of(const Member& member) {
  if (member.at_work) return "running";
  if (!member.code) return "waiting";
  if (*member.code == 0) return "done";
  return *member.code == exit_stopped ? "stopped" : "failed";
}

void publish(const fs::path& file, const std::vector<std::vector<std::string>>& lines) {
  std::string text;
  for (const auto& line : lines) text += csv_line(line);
  write_file_atomically(file, text);
  std::vector<std::vector<std::string>> shown = lines;
  for (auto& line : shown) std::ranges::replace(line, std::string("nan"), std::string("-"));
  std::cout << '\n' << format_table(shown, 'l' + std::string(shown.front().size() - 1, 'r'));
}

Batch::Batch(BatchOptions options, const std::vector<std::vector<std::string>>& values) : options_(std::move(options)) {
  for (const auto& each : values) {
    const std::string number = padded(members_.size() + 1, values.size());
    members_.push_back({options_.output / (options_.prefix + "_" + number), each, {}, {}});
  }
}

void Batch::check_keys() const {
  for (std::size_t k = 0; k < options_.keys.size(); ++k) {
    const std::string& key = options_.keys[k];
    const bool before = std::find(options_.keys.begin(), options_.keys.begin() + k, key) != options_.keys.begin() + k;
    const bool set = std::ranges::any_of(options_.overrides,
                                         [&](const std::string& setting) { return setting.starts_with(key + '='); });
    if (before || set)
      throw SceneError("--vary", {{{},
                                   "",
                                   '"' + key + (before ? "\" twice" : "\", which --set sets, too"),
                                   "each key once",
                                   ProblemSource::elsewhere}});
  }
}

void Batch::check(const std::vector<std::vector<std::string>>& values) {
  check_keys();
  for (const auto& each : values) {
    std::vector<std::string> overrides = options_.overrides;
    for (const std::string& setting : settings(options_.keys, each)) overrides.push_back(setting);
    const Scene scene = read_scene(options_.scene, overrides);
    check_results(scene);
    names_.clear();
    for (const ResultSpec& result : scene.results) names_.push_back(result.name);
  }
  if (names_.empty()) throw SceneError(options_.scene, {{{}, "results", "none", "a scene with [[results]]"}});
}

void Batch::claim() {
  std::string design = "scene " + fs::absolute(options_.scene).string() + '\n' + options_.design;
  for (const std::string& override : options_.overrides) design += "set " + override + '\n';
  fs::create_directories(options_.output);
  const fs::path file = options_.output / "design.txt";
  const std::string found = fs::exists(file)                ? text_of_file(file)
                            : fs::is_empty(options_.output) ? design
                                                            : "other files\n";
  if (found != design)
    throw SceneError(options_.output.string(),
                     {{{},
                       "--output",
                       found.starts_with("other") ? "a directory with other files in it"
                                                  : options_.kind + " of another design (design.txt)",
                       "an empty directory, or one with the same scene, settings and values",
                       ProblemSource::elsewhere}});
  write_file_atomically(file, design);
}

std::vector<std::string> Batch::command(const Member& member) const {
  if (done_at(member.directory)) return {};
  std::vector<std::string> words{own_program(), "run",      options_.scene,           "--threads",
                                 "1",           "--output", member.directory.string()};
  words.emplace_back(fs::exists(member.directory / "checkpoint.bin") ? "--resume" : "--overwrite");
  for (const std::string& setting : options_.overrides) words.insert(words.end(), {"--set", setting});
  for (const std::string& setting : settings(options_.keys, member.values))
    words.insert(words.end(), {"--set", setting});
  return words;
}

int Batch::run() {
  look();
  catch_signals();
  std::atomic<std::size_t> next{0}, at_work{static_cast<std::size_t>(options_.jobs)};
  std::deque<std::atomic<pid_t>> processes(static_cast<std::size_t>(options_.jobs));
  std::vector<std::jthread> workers;
  for (auto& process : processes)
    workers.emplace_back([&] {
      for (std::size_t i = next++; i < members_.size() && !stop_requested(); i = next++) make(i, process);
      --at_work;
    });
  for (bool told = false; at_work > 0; std::this_thread::sleep_for(std::chrono::milliseconds(20))) {
    if (!stop_requested() || told) continue;
    for (auto& process : processes)
      if (process > 0) kill(process, SIGTERM);
    told = true;
  }
  workers.clear();
  if (stop_requested()) {
    std::cout << "stopped: the same command goes on\n";
    return exit_stopped;
  }
  const auto failed = std::ranges::count_if(members_, [](const Member& member) { return member.code != 0; });
  if (failed > 0) std::cout << failed << " of " << members_.size() << " runs failed: see manifest.csv\n";
  return failed > 0 ? 1 : 0;
}

void Batch::look() {
  for (Member& member : members_) {
    const std::optional<RunRecord> record = find_run_record(member.directory);
    member.results.assign(names_.size(), std::numeric_limits<double>::quiet_NaN());
    member.at_work = run_at_work(member.directory).has_value();
    if (!record) continue;
    for (std::size_t r = 0; r < names_.size(); ++r) member.results[r] = record->result(names_[r]);
    if (record->status == "done") member.code = 0;
    if (record->status == "stopped" || record->status == "blocked") member.code = exit_stopped;
    if (record->status == "failed") member.code = 1;
  }
  write_manifest();
}

void Batch::begin(Member& member) {
  const std::lock_guard<std::mutex> lock(mutex_);
  member.at_work = true;
  member.code.reset();
  write_manifest();
}

void Batch::make(std::size_t i, std::atomic<pid_t>& process) {
  Member& member = members_[i];
  wait_for_earlier_run(member.directory);
  if (stop_requested()) return;
  const std::vector<std::string> words = command(member);
  if (!words.empty()) begin(member);
  const int code = words.empty() ? 0 : run_child(words, ChildErrors::drop, &process).code;
  const std::lock_guard<std::mutex> lock(mutex_);
  member.code = code;
  member.at_work = false;
  const std::optional<RunRecord> record = find_run_record(member.directory);
  for (std::size_t r = 0; record && r < names_.size(); ++r) member.results[r] = record->result(names_[r]);
  ++ended_;
  std::cout << "run " << ended_ << " of " << members_.size() << ": " << member.directory.filename().string();
  for (const std::string& setting : settings(options_.keys, member.values)) std::cout << "  " << setting;
  std::cout << (state_of(member) == "failed" ? ", failed with " + std::to_string(code) : ", " + state_of(member))
            << std::endl;
  write_manifest();
}

void Batch::write_manifest() const {
  std::vector<std::string> head{"run"};
  head.insert(head.end(), options_.keys.begin(), options_.keys.end());
  head.insert(head.end(), {"state", "exit_code"});
  head.insert(head.end(), names_.begin(), names_.end());
  std::string text = csv_line(head);
  for (const Member& member : members_) {
    std::vector<std::string> line{member.directory.filename().string()};
    line.insert(line.end(), member.values.begin(), member.values.end());
    line.insert(line.end(), {state_of(member), member.code ? std::to_string(*member.code) : ""});
    for (const double value : member.results) line.push_back(format_number(value));
    text += csv_line(line);
  }
  write_file_atomically(options_.output / "manifest.csv", text);
}

std::vector<double> Batch::column(std::size_t result) const {
  std::vector<double> values;
  for (const Member& member : members_)
    values.push_back(member.code == 0 ? member.results[result] : std::numeric_limits<double>::quiet_NaN());
  return values;
}

}  // namespace geodrop
