#include "instructions.hpp"

#include "base/atomic_file.hpp"
#include "child.hpp"
#include "counted_steps.hpp"
#include "machine.hpp"
#include "steps.hpp"

#include <geodrop/base/error.hpp>

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

namespace geodrop {
namespace {

constexpr const char* table_name = "perf/instructions.csv";
constexpr const char* table_head = "name,build,particles,steps,instructions";
/// Enough that the rest of a step does not hide the kernels, few enough that all benchmarks take two minutes.
constexpr const char* particles = "2000";
constexpr const char* steps = "16";

[[noreturn]] void refuse(const std::string& file, int line, const std::string& found, const std::string& allowed) {
  throw SceneError(file, {{{line, 1}, "--instructions", found, allowed, ProblemSource::elsewhere}});
}

/// A directory for callgrind's files, that goes away.
class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "geodrop_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no directory for the counts: " + name);
    path_ = name;
  }
  ~Scratch() {
    std::error_code none;
    std::filesystem::remove_all(path_, none);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// One process for all benchmarks; callgrind writes a dump whenever one ends, numbered from 1.
std::vector<InstructionCount> count_instructions(const BenchOptions& options) {
  const Scratch scratch;
  const std::string dumps = (scratch.path() / "dump").string();
  std::vector<std::string> words{"env",  // as many threads as there are cores, whatever the caller's shell says
                                 "--unset=OMP_NUM_THREADS",
                                 "valgrind",
                                 "--tool=callgrind",
                                 "--callgrind-out-file=" + dumps,
                                 "--log-file=" + (scratch.path() / "log").string(),
                                 std::string("--toggle-collect=") + counted_steps_name,
                                 std::string("--dump-after=") + end_count_name,
                                 own_program(),
                                 "bench",
                                 "--steps",
                                 steps,
                                 "--particles",
                                 particles,
                                 "--only",
                                 options.only};
  if (!options.scene.empty()) words.insert(words.end(), {"--scene", options.scene.string()});
  const ChildOutcome outcome = run_child(words);
  if (outcome.code == no_such_program)
    throw SceneError("valgrind",
                     {{{}, "--instructions", "no such program", "it is installed", ProblemSource::elsewhere}});
  if (outcome.code != 0) {
    std::fprintf(stderr, "%s", text_of_file(scratch.path() / "log").c_str());
    throw std::runtime_error("the counted program failed");
  }
  const StepReport report = parse_steps(outcome.out);
  std::vector<InstructionCount> counts;
  for (const StepTime& time : report.times) {
    const double total = instructions_in(text_of_file(dumps + "." + std::to_string(counts.size() + 1)));
    const double particle_steps = static_cast<double>(time.particles) * time.steps;
    counts.push_back({time.name, report.build, time.particles, time.steps, total / particle_steps});
  }
  return counts;
}

/// Prints a line for each and returns the exit code.
int report(const std::vector<InstructionVerdict>& verdicts) {
  int more = 0, fewer = 0, unknown = 0;
  std::printf("%-28s %12s %12s %8s\n", "name", "instructions", "committed", "change");
  for (const InstructionVerdict& v : verdicts) {
    std::printf("%-28s %12.2f ", v.counted.name.c_str(), v.counted.per_particle_step);
    if (v.committed)
      std::printf("%12.2f %+7.2f %%%s\n", *v.committed, 100 * v.change(),
                  v.more()    ? "  MORE"
                  : v.fewer() ? "  fewer"
                              : "");
    else
      std::printf("%12s\n", "no such row");
    more += v.more();
    fewer += v.fewer();
    unknown += !v.committed;
  }
  std::printf("%zu benchmarks: %d with over %g %% more instructions than committed, %d with as many fewer\n",
              verdicts.size(), more, 100 * allowed_more, fewer);
  if (unknown)
    std::printf(
        "%d have no row for %s in %s: count them with code that is known to be good, by\n"
        "  geodrop bench --instructions --update\nand commit the table\n",
        unknown, verdicts.front().counted.build.c_str(), table_name);
  else if (fewer)
    std::printf("write the smaller numbers down by: geodrop bench --instructions --update\n");
  return more ? 1 : unknown ? 2 : 0;
}

}  // namespace

std::vector<InstructionVerdict> compare_instructions(const std::vector<InstructionCount>& counted,
                                                     const std::vector<InstructionCount>& committed) {
  std::vector<InstructionVerdict> verdicts;
  for (const InstructionCount& count : counted) {
    verdicts.push_back({count, std::nullopt});
    const auto row = std::find_if(committed.begin(), committed.end(),
                                  [&](const InstructionCount& other) { return count.same_work(other); });
    if (row != committed.end()) verdicts.back().committed = row->per_particle_step;
  }
  return verdicts;
}

std::vector<InstructionCount> merge_instructions(std::vector<InstructionCount> committed,
                                                 const std::vector<InstructionCount>& counted) {
  for (const InstructionCount& count : counted) {
    const auto row = std::find_if(committed.begin(), committed.end(), [&](const InstructionCount& other) {
      return count.name == other.name && count.build == other.build;
    });
    if (row == committed.end())
      committed.push_back(count);
    else
      *row = count;
  }
  return committed;
}

std::vector<InstructionCount> read_instructions(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::ifstream in(path);
  std::vector<InstructionCount> rows;
  std::string line;
  if (!std::getline(in, line)) return rows;
  if (line != table_head) refuse(file, 1, line, table_head);
  for (int number = 2; std::getline(in, line); ++number) {
    std::istringstream cells(line);
    InstructionCount row;
    char comma = 0;
    std::getline(cells, row.name, ',');
    std::getline(cells, row.build, ',');
    cells >> row.particles >> comma >> row.steps >> comma >> row.per_particle_step;
    if (!cells || !(row.per_particle_step > 0)) refuse(file, number, line, "name, build, and three numbers > 0");
    rows.push_back(row);
  }
  return rows;
}

void write_instructions(const std::filesystem::path& file, const std::vector<InstructionCount>& rows) {
  std::ofstream out(file);
  out << table_head << '\n';
  for (const InstructionCount& row : rows)
    out << row.name << ',' << row.build << ',' << row.particles << ',' << row.steps << ',' << row.per_particle_step
        << '\n';
  if (!out.flush()) throw WriteError("cannot write " + file.string());
}

double instructions_in(const std::string& dump) {
  std::istringstream lines(dump);
  std::string line;
  std::set<std::string> allocator;  // numbers of files, as "(158)"
  bool counts = false, any = false, of_call = false;
  double total = 0;
  while (std::getline(lines, line)) {
    if (const std::size_t at = line.find("=("); at <= 3) {  // fl=(158) a file, cfn=(3), ...
      const std::string number = line.substr(at + 1, line.find(')') - at);
      if (line.ends_with("malloc.c")) allocator.insert(number);
      if (line.starts_with("fl=")) counts = !allocator.contains(number);
    } else if (line.starts_with("calls=")) {
      of_call = true;  // what follows is told once more by the function that was called
    } else if (!line.empty() && (std::isdigit(line[0]) || line[0] == '+' || line[0] == '-' || line[0] == '*')) {
      const std::size_t space = line.find(' ');
      if (counts && !of_call && space != std::string::npos) total += std::stod(line.substr(space + 1));
      any = true;
      of_call = false;
    }
  }
  if (!any) throw std::runtime_error("callgrind wrote no counts");
  return total;
}

int run_instructions(const BenchOptions& options) {
  const std::filesystem::path table = find_in_tree(table_name);
  if (table.empty()) {
    std::fprintf(stderr, "there is no %s above this program or this directory\n", table_name);
    return 2;
  }
  const std::vector<InstructionCount> committed = read_instructions(table);
  const std::vector<InstructionCount> counted = count_instructions(options);
  if (!options.update) return report(compare_instructions(counted, committed));
  write_instructions(table, merge_instructions(committed, counted));
  std::printf("%zu rows written to %s\n", counted.size(), table.c_str());
  return 0;
}

}  // namespace geodrop
