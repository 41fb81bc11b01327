// Finds the cases, runs their variants one after the other, reports.
#include <geodrop/base/error.hpp>
#include <geodrop/base/stop_signal.hpp>
#include <geodrop/grid/graded_axis.hpp>
#include <geodrop/reader/scene_reader.hpp>
#include <geodrop/step/run.hpp>
#include <geodrop/verify/verify.hpp>

#include "base/atomic_file.hpp"
#include "base/nearest_name.hpp"
#include "base/text.hpp"
#include "bench/machine.hpp"
#include "judge.hpp"
#include "report.hpp"
#include "work_precision.hpp"

#include <algorithm>
#include <cstdio>
#include <deque>
#include <fstream>
#include <iterator>

namespace geodrop {
namespace {

namespace fs = std::filesystem;

/// All scenes of the source tree that say what they are verified by, sorted by name.
std::vector<fs::path> cases_of_tree() {
  std::vector<fs::path> found;
  const fs::path cases = find_in_tree("cases");
  if (cases.empty()) return found;
  for (const auto& entry : fs::recursive_directory_iterator(cases))
    if (entry.path().extension() == ".toml" && !read_scene(entry.path().string()).verify.empty())
      found.push_back(entry.path());
  std::sort(found.begin(), found.end(), [](const fs::path& a, const fs::path& b) { return a.stem() < b.stem(); });
  return found;
}

[[noreturn]] void refuse_only(const std::string& only, const std::vector<fs::path>& cases) {
  std::vector<std::string> names;
  for (const fs::path& file : cases) names.push_back(file.stem().string());
  const std::string nearest = nearest_name(only, names);
  throw SceneError(
      "geodrop verify",
      {{{},
        "--only",
        '"' + only + "\", which is in the name of none of " + std::to_string(cases.size()) + " cases",
        "a part of the name of a case" + (nearest.empty() ? ", e.g. geotube" : "; the nearest is \"" + nearest + '"'),
        ProblemSource::elsewhere}});
}

std::vector<fs::path> chosen_cases(const VerifyOptions& options) {
  const std::vector<fs::path> cases = options.scenes.empty() ? cases_of_tree() : options.scenes;
  std::vector<fs::path> chosen = cases;
  std::erase_if(chosen,
                [&](const fs::path& file) { return file.stem().string().find(options.only) == std::string::npos; });
  if (chosen.empty()) refuse_only(options.only, cases);
  return chosen;
}

std::vector<VariantSpec> variants_of(const Scene& scene, VerifyMode mode) {
  if (scene.variants.empty()) return {VariantSpec{"as it stands", {}, VerifyMode::both, false, {}, {}, {}}};
  std::vector<VariantSpec> variants = scene.variants;
  std::erase_if(variants, [&](const VariantSpec& one) { return one.in != VerifyMode::both && one.in != mode; });
  return variants;
}

/// No pictures but those of start and end.
Scene read_variant(const std::string& file, const VariantSpec& variant) {
  std::vector<std::string> overrides = variant.set;
  overrides.push_back("output.frame_interval=" + format_number(read_scene(file, overrides).time.end));
  return read_scene(file, overrides);
}

double fact_of(const RunStatistics& statistics, const std::string& name) {
  for (const Fact& fact : statistics.facts)
    if (fact.name == name) return fact.value;
  return 0;
}

VariantRun run_variant(const Scene& scene, const VariantSpec& variant, const RunOptions& options) {
  VariantRun run;
  run.name = variant.name;
  run.control = variant.control;
  run.of = variant.of;
  run.breaks = variant.breaks;
  run.spacing = finest_spacing(scene.grid);
  RunOutcome outcome;
  try {
    outcome = perform_run(scene, options);
  } catch (const WriteError&) {
    throw;
  } catch (const RunError& error) {  // before the first step
    outcome.statistics.status = RunStatus::failed;
    outcome.statistics.message = error.what();
  }
  const RunStatistics& statistics = outcome.statistics;
  if (statistics.status == RunStatus::blocked) throw WriteError(statistics.message);
  run.particles = fact_of(statistics, "particles_count");
  run.steps = static_cast<double>(statistics.steps);
  run.wall_seconds = statistics.wall_seconds;
  run.bytes = run.particles * fact_of(statistics, "bytes_per_particle_count");
  run.status = statistics.status;
  run.message = statistics.message;
  run.results = outcome.summary.results;
  run.state_hash = outcome.summary.state_hash;
  return run;
}

/// The runs of one scene, kept where they are for the rows that point to them.
struct Case {
  Scene scene;
  std::vector<VariantRun> runs;
};

void run_case(const fs::path& file, const VerifyOptions& options, Case& one) {
  one.scene = read_scene(file.string());
  int number = 0;
  for (const VariantSpec& variant : variants_of(one.scene, options.mode)) {
    RunOptions run;
    run.directory = options.directory / file.stem() / std::to_string(++number);
    run.threads = options.threads;
    run.telling = Telling::log_only;
    run.earlier = EarlierRun::overwrite;
    one.runs.push_back(run_variant(read_variant(file.string(), variant), variant, run));
    if (stop_requested()) return;
  }
}

std::string read_text(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw RunError("cannot read " + file.string());
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Draws them into a directory; what a page beside it says of them, `path` being the directory as seen from the page.
std::string draw(const std::vector<WorkPicture>& pictures, const fs::path& directory, const std::string& path) {
  fs::create_directories(directory);
  std::string links;
  for (const WorkPicture& picture : pictures) {
    const std::string file = picture.name + ".svg";
    write_chart(picture.chart, directory / file);
    links += (links.empty() ? "" : ",\n") + ("[" + picture.name.substr(std::string("work_precision_").size()) + "](") +
             path + file + ")";
  }
  return links.empty() ? "" : "\nError against wall time, particle-steps and memory:\n" + links + ".\n";
}

void write_results(const std::vector<VerifyRow>& rows, const VerifyOptions& options) {
  write_file_atomically(options.directory / "verification.csv", rows_csv(rows));
  write_file_atomically(options.directory / "verification_runs.csv", runs_csv(rows));
  const std::vector<WorkPicture> pictures = work_precision_pictures(rows);
  const std::string cases = cases_markdown(rows);
  write_file_atomically(options.directory / "verification.md",
                        cases + draw(pictures, options.directory, "") + "\n" + rows_markdown(rows));
  if (options.page.empty()) return;
  const fs::path beside = options.page.parent_path() / options.page.stem();
  const std::string path = options.page.stem().string() + "/";
  const std::string links =
      draw(pictures, beside, path) + "\nAll measures and controls: [rows](" + path + "rows.md).\n";
  write_file_atomically(beside / "rows.md", rows_page(rows, options.page.filename().string()));
  write_file_atomically(options.page, with_generated_part(read_text(options.page), cases + links));
}

}  // namespace

int run_verify(const VerifyOptions& options) {
  if (!options.page.empty()) with_generated_part(read_text(options.page), "");  // before hours of work
  const std::vector<fs::path> files = chosen_cases(options);
  fs::create_directories(options.directory);
  std::deque<Case> cases;
  std::vector<VerifyRow> rows;
  std::printf("%s\n", console_head().c_str());
  for (const fs::path& file : files) {
    run_case(file, options, cases.emplace_back());
    if (stop_requested()) return exit_stopped;
    for (const VerifyRow& row : judge(cases.back().scene, cases.back().runs, options.mode)) {
      if (row.runs.empty()) continue;  // none of its variants is for this mode
      std::printf("%s\n", console_line(row).c_str());
      rows.push_back(row);
    }
    std::fflush(stdout);
  }
  if (rows.empty()) {
    std::fprintf(stderr, "no run to judge: none of these cases has a variant for --%s\n",
                 options.mode == VerifyMode::full ? "full" : "quick");
    return 2;
  }
  write_results(rows, options);
  std::printf("%s\n%s\n", verify_totals(rows).c_str(), slack_totals(rows).c_str());
  return std::any_of(rows.begin(), rows.end(), [](const VerifyRow& row) { return row.verdict == Verdict::missed; });
}

}  // namespace geodrop
