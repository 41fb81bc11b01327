#include "ratio_check.hpp"

#include <geodrop/error.hpp>
#include <geodrop/input_file.hpp>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace geodrop {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream text(line);
  for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
  return cells;
}

[[noreturn]] void refuse(const std::string& file, int line, const std::string& found, const std::string& allowed) {
  throw SceneError(file, {{{line, 1}, "--check", found, allowed, ProblemSource::elsewhere}});
}

std::size_t column(const std::vector<std::string>& head, const std::string& name, const std::string& file) {
  const auto found = std::find(head.begin(), head.end(), name);
  if (found == head.end()) refuse(file, 1, "no column " + name, "a table with it");
  return static_cast<std::size_t>(found - head.begin());
}

}  // namespace

RatioVerdict judge_ratio(double committed, double loss, const std::function<double()>& measure) {
  RatioVerdict verdict;
  verdict.lost = true;
  while (verdict.lost && verdict.tries < most_tries) {
    verdict.best = std::max(verdict.best, measure());
    verdict.lost = verdict.best < (1 - loss) * committed;
    ++verdict.tries;
  }
  return verdict;
}

std::vector<CommittedRatio> read_ratios(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::istringstream in(read_input(path, "--check", "a table of ratios"));
  std::string line;
  if (!std::getline(in, line)) refuse(file, 0, "an empty file", "a table of ratios");
  const std::vector<std::string> head = split(line);
  const std::size_t name = column(head, "name", file), processor = column(head, "processor", file);
  const std::size_t particles = column(head, "particles", file), threads = column(head, "threads", file);
  const std::size_t ratio = column(head, "ratio", file);
  std::vector<CommittedRatio> ratios;
  for (int number = 2; std::getline(in, line); ++number) {
    const std::vector<std::string> cells = split(line);
    try {
      ratios.push_back({cells.at(name), cells.at(processor), std::stoul(cells.at(particles)),
                        std::stoi(cells.at(threads)), std::stod(cells.at(ratio))});
      if (!(ratios.back().ratio > 0)) throw std::invalid_argument("ratio");
    } catch (const std::logic_error&) {  // too few cells, a text where a number belongs, or no ratio
      refuse(file, number, line, "name, particles, threads and a ratio > 0 in the columns of that name");
    }
  }
  return ratios;
}

const CommittedRatio* find_ratio(const std::vector<CommittedRatio>& ratios, const CommittedRatio& like) {
  const auto found = std::find_if(ratios.begin(), ratios.end(), [&](const CommittedRatio& r) {
    return r.name == like.name && r.particles == like.particles && r.threads == like.threads;
  });
  return found == ratios.end() ? nullptr : &*found;
}

std::filesystem::path choose_ratios(std::vector<std::filesystem::path> files, const std::string& processor) {
  if (files.empty()) return {};
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    const std::vector<CommittedRatio> ratios = read_ratios(file);
    if (!ratios.empty() && ratios.front().processor == processor) return file;
  }
  return files.front();
}

}  // namespace geodrop
