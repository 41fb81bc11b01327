#include "ensemble.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/reader/scene_reader.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>

#include "base/atomic_file.hpp"
#include "base/text.hpp"
#include "bench/child.hpp"
#include "files/run_directory.hpp"

namespace geodrop {
namespace {

namespace fs = std::filesystem;

/// A run of the ensemble; `code` is empty until it ends.
struct Member {
  fs::path directory;
  std::vector<std::string> settings;  ///< KEY=VALUE of what varies
  std::optional<int> code;
  std::vector<double> results;  ///< nan: none
};

/// The values of results in a summary.json, which has `"NAME": {"value": X` for each.
std::vector<double> results_in(const fs::path& summary, const std::vector<std::string>& names) {
  const std::string text = text_of_file(summary);
  const std::size_t section = text.find("\"results\": {");
  std::vector<double> values;
  for (const std::string& name : names) {
    const std::string mark = '"' + name + "\": {\"value\": ";
    const std::size_t at = section == std::string::npos ? section : text.find(mark, section);
    char* end = nullptr;
    const char* const number = at == std::string::npos ? "" : text.c_str() + at + mark.size();
    const double value = std::strtod(number, &end);
    values.push_back(end == number ? std::numeric_limits<double>::quiet_NaN() : value);
  }
  return values;
}

class Ensemble {
 public:
  explicit Ensemble(const EnsembleOptions& options) : options_(options) {
    check_scene();
    values_ = latin_hypercube(options.variations, options.samples, options.seed);
    const auto width = std::to_string(options.samples).size();
    for (std::size_t i = 0; i < values_.size(); ++i) {
      std::string number = std::to_string(i + 1);
      number.insert(0, std::max<std::size_t>(width, 3) - std::min(width, number.size()), '0');
      Member member{options.output / ("run_" + number), {}, {}, {}};
      for (std::size_t v = 0; v < options.variations.size(); ++v)
        member.settings.push_back(options.variations[v].key + '=' + value_text(options.variations[v], values_[i][v]));
      members_.push_back(std::move(member));
    }
  }

  int run() {
    claim_directory();
    std::atomic<std::size_t> next{0};
    std::vector<std::jthread> workers;
    for (int job = 0; job < options_.jobs; ++job)
      workers.emplace_back([&] {
        for (std::size_t i = next++; i < members_.size(); i = next++) make(i);
      });
    workers.clear();
    write_bands();
    write_correlations();
    const auto failed = std::ranges::count_if(members_, [](const Member& member) { return member.code != 0; });
    if (failed > 0) std::cout << failed << " of " << members_.size() << " runs failed: see manifest.csv\n";
    return failed > 0 ? 1 : 0;
  }

 private:
  /// All keys at the low end, then all at the high one: what is refused is told before the first run.
  void check_scene() {
    for (const bool high : {false, true}) {
      std::vector<std::string> overrides = options_.overrides;
      for (const Variation& variation : options_.variations)
        overrides.push_back(variation.key + '=' + value_text(variation, high ? variation.high : variation.low));
      const Scene scene = read_scene(options_.scene, overrides);
      names_.clear();
      for (const ResultSpec& result : scene.results) names_.push_back(result.name);
    }
    if (names_.empty()) throw SceneError(options_.scene, {{{}, "results", "none", "a scene with [[results]]"}});
  }

  /// What the values of the runs follow from, one per line.
  std::string design() const {
    std::string text = "scene " + fs::absolute(options_.scene).string() + "\nsamples " +
                       std::to_string(options_.samples) + "\nseed " + std::to_string(options_.seed) + '\n';
    for (const std::string& override : options_.overrides) text += "set " + override + '\n';
    for (const Variation& variation : options_.variations)
      text += "vary " + variation.key + '=' + value_text(variation, variation.low) + ':' +
              value_text(variation, variation.high) + '\n';
    return text;
  }

  void claim_directory() {
    fs::create_directories(options_.output);
    const fs::path file = options_.output / "design.txt";
    if (fs::exists(file) && text_of_file(file) != design())
      throw SceneError(options_.output.string(), {{{},
                                                   "--output",
                                                   "an ensemble of another design (design.txt)",
                                                   "an empty directory, or the same scene, samples, seed and ranges",
                                                   ProblemSource::elsewhere}});
    write_file_atomically(file, design());
  }

  void make(std::size_t i) {
    Member& member = members_[i];
    int code = 0;
    if (!done_at(member.directory)) {
      std::vector<std::string> words{own_program(), "run",      options_.scene,           "--threads",
                                     "1",           "--output", member.directory.string()};
      words.emplace_back(fs::exists(member.directory / "checkpoint.bin") ? "--resume" : "--overwrite");
      for (const std::string& setting : options_.overrides) words.insert(words.end(), {"--set", setting});
      for (const std::string& setting : member.settings) words.insert(words.end(), {"--set", setting});
      code = run_child(words, ChildErrors::drop).code;
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    member.results = results_in(member.directory / "summary.json", names_);
    member.code = code;
    ++done_;
    std::cout << "run " << done_ << " of " << members_.size() << ": " << member.directory.filename().string()
              << (code == 0 ? "" : ", failed with " + std::to_string(code)) << std::endl;
    write_manifest();
  }

  void write_manifest() const {
    std::string text = "run";
    for (const Variation& variation : options_.variations) text += ',' + variation.key;
    text += ",exit_code";
    for (const std::string& name : names_) text += ',' + name;
    text += '\n';
    for (std::size_t i = 0; i < members_.size(); ++i) {
      const Member& member = members_[i];
      if (!member.code) continue;
      text += member.directory.filename().string();
      for (std::size_t v = 0; v < options_.variations.size(); ++v)
        text += ',' + value_text(options_.variations[v], values_[i][v]);
      text += ',' + std::to_string(*member.code);
      for (const double value : member.results) text += ',' + format_number(value);
      text += '\n';
    }
    write_file_atomically(options_.output / "manifest.csv", text);
  }

  /// Of one result over the runs that ended well.
  std::vector<double> column(std::size_t result) const {
    std::vector<double> values;
    for (const Member& member : members_)
      values.push_back(member.code == 0 ? member.results[result] : std::numeric_limits<double>::quiet_NaN());
    return values;
  }

  void publish(const std::string& file, const std::vector<std::vector<std::string>>& lines) const {
    std::string text;
    for (const auto& line : lines)
      for (std::size_t i = 0; i < line.size(); ++i) text += line[i] + (i + 1 < line.size() ? ',' : '\n');
    write_file_atomically(options_.output / file, text);
    std::cout << '\n' << format_table(lines, 'l' + std::string(lines.front().size() - 1, 'r'));
  }

  void write_bands() const {
    std::vector<std::vector<std::string>> lines{{"result", "5 %", "median", "95 %"}};
    for (std::size_t r = 0; r < names_.size(); ++r) {
      const Band band = band_of(column(r));
      lines.push_back(
          {names_[r], format_number(band.low, 4), format_number(band.median, 4), format_number(band.high, 4)});
    }
    publish("bands.csv", lines);
  }

  void write_correlations() const {
    std::vector<std::vector<std::string>> lines{{"rank correlation of"}};
    for (const Variation& variation : options_.variations) lines.front().push_back(variation.key);
    for (std::size_t r = 0; r < names_.size(); ++r) {
      lines.push_back({names_[r]});
      for (std::size_t v = 0; v < options_.variations.size(); ++v) {
        std::vector<double> inputs;
        for (const auto& values : values_) inputs.push_back(values[v]);
        lines.back().push_back(format_number(rank_correlation(inputs, column(r)), 2));
      }
    }
    publish("correlations.csv", lines);
  }

  const EnsembleOptions& options_;
  std::vector<std::string> names_;  ///< of results
  std::vector<std::vector<double>> values_;
  std::vector<Member> members_;
  std::mutex mutex_;
  std::size_t done_ = 0;
};

}  // namespace

int run_ensemble(const EnsembleOptions& options) { return Ensemble(options).run(); }

}  // namespace geodrop
