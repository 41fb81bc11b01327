// Runs the program as a user does, and reads what it leaves behind.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/paths.hpp"
#include "support/scene_files.hpp"

namespace geodrop::test {

/// How a command ended.
struct Outcome {
  int code;  ///< exit code; 128 + signal if a signal ended it
  std::string out, err;
};

/// One run of the program in a directory of its own.
class Program {
 public:
  explicit Program(const std::vector<std::string>& arguments) {
    std::vector<char*> argv;
    std::vector<std::string> words{program_path};
    words.insert(words.end(), arguments.begin(), arguments.end());
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const std::string out = directory_ / "out", err = directory_ / "err";
    pid_ = fork();
    if (pid_ != 0) return;
    const auto redirect = [](const std::string& path, int to) { dup2(creat(path.c_str(), S_IRUSR | S_IWUSR), to); };
    redirect(out, STDOUT_FILENO);
    redirect(err, STDERR_FILENO);
    execv(program_path.c_str(), argv.data());
    _exit(127);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void signal(int number) const { kill(pid_, number); }
  Outcome wait() const {
    int status = 0;
    waitpid(pid_, &status, 0);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code, read_file(directory_ / "out"), read_file(directory_ / "err")};
  }

 private:
  TemporaryDirectory directory_;
  pid_t pid_;
};

inline Outcome run_program(const std::vector<std::string>& arguments) { return Program(arguments).wait(); }

/// A run of a scene of the repository into a temporary directory.
class SceneRun {
 public:
  enum class Begin { now, later };

  /// `settings` are those of --set; `more` any further arguments. Begun later, it runs by `again`.
  explicit SceneRun(const std::string& scene, const std::vector<std::string>& settings = {},
                    const std::vector<std::string>& more = {}, Begin begin = Begin::now)
      : scene_(scene.front() == '/' ? scene : source_path(scene)),
        settings_(settings),
        outcome_(begin == Begin::now ? go(more) : Outcome{}) {}

  const Outcome& outcome() const { return outcome_; }
  std::filesystem::path file(const std::string& name) const { return directory_ / "run" / name; }
  /// The same command into the same directory again, e.g. with --resume.
  const Outcome& again(const std::vector<std::string>& more) { return outcome_ = go(more); }

  std::vector<std::string> arguments(const std::vector<std::string>& more) const {
    std::vector<std::string> all{"run", scene_, "--output", directory_ / "run"};
    for (const std::string& setting : settings_) all.insert(all.end(), {"--set", setting});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  std::string summary() const { return read_file(file("summary.json")); }
  /// Text of a member of the summary, without quotes.
  std::string text(const std::string& name) const {
    const std::string all = summary(), start = "\"" + name + "\": \"";
    const std::size_t at = all.find(start);
    if (at == std::string::npos) return "nothing called " + name;
    return all.substr(at + start.size(), all.find('"', at + start.size()) - at - start.size());
  }
  std::string hash() const { return text("state_hash"); }
  /// Value of a result (or fact); NaN, which meets no bound, if there is none.
  double result(const std::string& name) const {
    const std::string all = summary(), start = "\"" + name + "\": {\n      \"value\": ";
    const std::size_t at = all.find(start);
    if (at == std::string::npos) return std::numeric_limits<double>::quiet_NaN();
    const std::string value = all.substr(at + start.size(), 40);
    return value.starts_with("null") ? std::numeric_limits<double>::quiet_NaN() : std::stod(value);
  }
  /// A column of history.csv; throws if there is no such column.
  std::vector<double> column(const std::string& name) const {
    std::istringstream table(read_file(file("history.csv")));
    std::string line, cell;
    std::getline(table, line);
    std::istringstream head(line);
    std::size_t index = 0;
    while (std::getline(head, cell, ',') && cell != name) ++index;
    if (cell != name) throw std::runtime_error("no column " + name);
    std::vector<double> values;
    while (std::getline(table, line)) {
      std::istringstream row(line);
      for (std::size_t k = 0; k <= index; ++k) std::getline(row, cell, ',');
      values.push_back(std::strtod(cell.c_str(), nullptr));
    }
    return values;
  }

 private:
  Outcome go(const std::vector<std::string>& more) const { return run_program(arguments(more)); }

  TemporaryDirectory directory_;
  std::string scene_;
  std::vector<std::string> settings_;
  Outcome outcome_;
};

}  // namespace geodrop::test
