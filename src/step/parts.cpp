#include "parts.hpp"

#include <geodrop/files/checkpoint.hpp>

#include <xxhash.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <utility>

#include "base/text.hpp"

namespace geodrop {
namespace {

template <int Dim>
std::string part_hash(const State<Dim>& state, const Grids<Dim>& grids) {
  std::uint64_t hash = 0;
  for (const std::uint64_t of_group : hashes_of(state, grids))
    hash = XXH3_64bits_withSeed(&of_group, sizeof of_group, hash);
  return format_hash(hash);
}

}  // namespace

template <int Dim>
void watch_parts(const StepWindow& window, const std::function<void(const PartHash&)>& take, Pipeline<Dim>& pipeline) {
  for (Row<Dim>& row : pipeline)
    row.run = [window, take, name = row.name, run = std::move(row.run)](State<Dim>& state, Grids<Dim>& grids,
                                                                        StepContext& step) {
      run(state, grids, step);
      if (step.step >= window.first && step.step <= window.last) take({step.step, name, part_hash(state, grids)});
    };
}

template <int Dim>
void record_parts(const StepWindow& window, const std::filesystem::path& path, Pipeline<Dim>& pipeline) {
  const auto file = std::make_shared<std::ofstream>(path);
  *file << "step,stage,hash" << std::endl;
  const auto write = [file](const PartHash& part) {
    *file << part.step << ',' << part.stage << ',' << part.hash << std::endl;
  };
  watch_parts<Dim>(window, write, pipeline);
}

std::vector<PartHash> read_parts(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<PartHash> parts;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    PartHash part;
    char comma = 0;
    if (cells >> part.step >> comma && std::getline(cells, part.stage, ',') && cells >> part.hash)
      parts.push_back(part);
  }
  return parts;
}

template void watch_parts(const StepWindow&, const std::function<void(const PartHash&)>&, Pipeline<2>&);
template void watch_parts(const StepWindow&, const std::function<void(const PartHash&)>&, Pipeline<3>&);
template void record_parts(const StepWindow&, const std::filesystem::path&, Pipeline<2>&);
template void record_parts(const StepWindow&, const std::filesystem::path&, Pipeline<3>&);

}  // namespace geodrop
