#include "sweep.hpp"

#include <geodrop/base/error.hpp>

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iostream>

#include "base/atomic_file.hpp"
#include "base/shell_command.hpp"
#include "base/text.hpp"
#include "batch.hpp"

namespace geodrop {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> keys_of(const SweepOptions& options) {
  std::vector<std::string> keys;
  for (const Axis& axis : options.axes) keys.push_back(axis.key);
  for (const Variation& variation : options.variations) keys.push_back(variation.key);
  return keys;
}

std::vector<std::vector<std::string>> values_of(const SweepOptions& options) {
  if (options.samples == 0) return combinations(options.axes);
  return value_texts(options.variations, latin_hypercube(options.variations, options.samples, options.seed));
}

std::string design(const SweepOptions& options) {
  std::string text;
  if (options.samples > 0)
    text += "samples " + std::to_string(options.samples) + "\nseed " + std::to_string(options.seed) + '\n';
  for (const Variation& variation : options.variations) text += "vary " + variation_text(variation) + '\n';
  for (const Axis& axis : options.axes) {
    text += "vary " + axis.key + '=';
    for (const std::string& value : axis.values) text += (&value == &axis.values.front() ? "" : ",") + value;
    text += '\n';
  }
  return text;
}

Batch make_batch(const SweepOptions& options) {
  return {{options.scene, options.overrides, keys_of(options), options.output, options.jobs, "a sweep", "case",
           design(options)},
          values_of(options)};
}

void check(const SweepOptions& options, Batch& batch) {
  batch.check(options.samples > 0 ? ends_of(options.variations) : values_of(options));
}

/// The command as it was typed, without what is not for a single case.
std::string command_of_a_case(const SweepOptions& options) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < options.command.size(); ++i) {
    const std::string& word = options.command[i];
    if (word == "--jobs") ++i;  // and its value
    if (word == "--jobs" || word.starts_with("--jobs=") || word == "--no-run") continue;
    words.push_back(word);
  }
  return shell_command(words);
}

/// For a directive of sbatch: % begins a pattern there.
std::string sbatch_path(const fs::path& path) {
  std::string text;
  for (const char letter : fs::absolute(path).string()) text += letter == '%' ? "%%" : std::string(1, letter);
  return text;
}

/// A case that the signal before its time limit stops has a checkpoint and ends with 75; it is queued again and goes on
/// from there. SIGTERM is scancel's: a case that was queued again then could not be cancelled. It reaches the run as
/// well, which a second SIGTERM would end at once, hence SIGHUP.
std::string array_script(const SweepOptions& options, std::size_t cases) {
  const std::string log = shell_word(sbatch_path(options.output) + "/slurm_%a.log");
  return "#!/bin/bash\n"
         "# The cases of this sweep as a Slurm job array: sbatch array.sbatch\n"
         "# The manifest afterwards: the command of the sweep with --no-run.\n"
         "#SBATCH --job-name=geodrop\n"
         "#SBATCH --array=1-" +
         std::to_string(cases) +
         "\n"
         "#SBATCH --ntasks=1 --cpus-per-task=1\n"
         "#SBATCH --time=24:00:00\n"
         "#SBATCH --signal=B:USR1@120\n"
         "#SBATCH --requeue --open-mode=append\n"
         "#SBATCH --output=" +
         log + "\ncd " + shell_word(fs::current_path().string()) + " || exit\n" + command_of_a_case(options) +
         " --case \"$SLURM_ARRAY_TASK_ID\" &\n"
         "run=$! time_is_over=\n"
         "trap 'kill -HUP \"$run\"' TERM  # scancel\n"
         "trap 'time_is_over=yes; kill -HUP \"$run\"' USR1\n"
         "while kill -0 \"$run\" 2>/dev/null; do wait \"$run\"; done  # a signal ends the waiting only\n"
         "wait \"$run\"\n"
         "code=$?\n"
         "if [ \"$code\" -eq 75 ] && [ -n \"$time_is_over\" ]; then\n"
         "  scontrol requeue \"${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID\"\n"
         "fi\n"
         "exit \"$code\"\n";
}

void write_script(const SweepOptions& options, std::size_t cases) {
  write_file_atomically(options.output / "array.sbatch", array_script(options, cases));
}

/// As many results as fit on a line; manifest.csv has all of them.
void print_table(const SweepOptions& options, const Batch& batch) {
  constexpr std::size_t most = 5;
  const std::size_t shown = std::min(most, batch.result_names().size());
  std::vector<std::string> head{"case"};
  for (const std::string& key : keys_of(options)) head.push_back(key);
  head.emplace_back("state");
  for (std::size_t r = 0; r < shown; ++r) head.push_back(batch.result_names()[r]);
  std::vector<std::vector<std::string>> lines{head};
  for (const Member& member : batch.members()) {
    lines.push_back({member.directory.filename().string()});
    lines.back().insert(lines.back().end(), member.values.begin(), member.values.end());
    lines.back().push_back(state_of(member));
    for (std::size_t r = 0; r < shown; ++r) lines.back().push_back(short_number(member.results[r]));
  }
  std::cout << '\n' << format_table(lines, 'l' + std::string(head.size() - 1, 'r'));
  if (shown < batch.result_names().size()) std::cout << "all results: manifest.csv\n";
}

}  // namespace

int run_sweep(const SweepOptions& options) {
  Batch batch = make_batch(options);
  check(options, batch);
  batch.claim();
  write_script(options, batch.members().size());
  const int code = batch.run();
  print_table(options, batch);
  return code;
}

int prepare_sweep(const SweepOptions& options) {
  Batch batch = make_batch(options);
  check(options, batch);
  batch.claim();
  write_script(options, batch.members().size());
  batch.look();
  print_table(options, batch);
  std::cout << "\nto make the runs: the command without --no-run, or sbatch "
            << shell_word((options.output / "array.sbatch").string()) << '\n';
  return 0;
}

int become_case(const SweepOptions& options, int number) {
  Batch batch = make_batch(options);
  const auto index = static_cast<std::size_t>(number - 1);
  if (number < 1 || index >= batch.members().size())
    throw SceneError("geodrop sweep", {{{},
                                        "--case",
                                        std::to_string(number),
                                        "1 to " + std::to_string(batch.members().size()),
                                        ProblemSource::elsewhere}});
  std::vector<std::string> words = batch.command(batch.members()[index]);
  if (words.empty()) {
    std::cout << batch.members()[index].directory.string() << " is done\n";
    return 0;
  }
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(arguments.front(), arguments.data());
  throw RunError("cannot start " + words.front() + ": " + std::strerror(errno));
}

}  // namespace geodrop
