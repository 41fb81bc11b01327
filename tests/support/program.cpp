#include "support/program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "base/json.hpp"

namespace geodrop::test {

Program::Program(const std::vector<std::string>& arguments) {
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

void Program::signal(int number) const { kill(pid_, number); }

Outcome Program::wait() const {
  int status = 0;
  waitpid(pid_, &status, 0);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, read_file(directory_ / "out"), read_file(directory_ / "err")};
}

std::vector<std::string> SceneRun::arguments(const std::vector<std::string>& more) const {
  std::vector<std::string> all{"run", scene_, "--output", directory_ / "run"};
  for (const std::string& setting : settings_) all.insert(all.end(), {"--set", setting});
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::string SceneRun::text(const std::string& name) const {
  const Json all = Json::parse(summary());
  const auto found = all.find(name);
  return found == all.end() ? "nothing called " + name : found->get<std::string>();
}

double SceneRun::result(const std::string& name) const {
  const Json all = Json::parse(summary());
  for (const char* table : {"results", "facts"})
    if (const Json& each = all.at(table); each.contains(name) && each.at(name).at("value").is_number())
      return each.at(name).at("value").get<double>();
  return std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> SceneRun::column(const std::string& name) const {
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

}  // namespace geodrop::test
