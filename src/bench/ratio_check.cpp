#include "ratio_check.hpp"

#include <algorithm>
#include <fstream>
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

std::size_t column(const std::vector<std::string>& head, const std::string& name, const std::string& file) {
  const auto found = std::find(head.begin(), head.end(), name);
  if (found == head.end()) throw std::runtime_error(file + ": no column " + name);
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
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line)) throw std::runtime_error(file + ": cannot be read or is empty");
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
      throw std::runtime_error(file + ":" + std::to_string(number) + ": not a row of ratios: " + line);
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
