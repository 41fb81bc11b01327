#include "parts.hpp"

#include <geodrop/checkpoint.hpp>

#include <xxhash.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <utility>

namespace geodrop {
namespace {

/// Goes on from the hash of what came before.
template <class T>
void add(const Array<T>& field, std::uint64_t& hash) {
  if (!field.empty()) hash = XXH3_64bits_withSeed(field.data(), field.size() * sizeof(T), hash);
}

template <int Dim>
void add(const Grid<Dim>& grid, std::uint64_t& hash) {
  for_each_array<any_role>(grid, [&](const auto& values) { add(values, hash); });
  for (const EnclosedCells& cells : grid.enclosed) {
    add(cells.area, hash);
    add(cells.pressure, hash);
    add(cells.rate, hash);
  }
}

template <int Dim>
std::string part_hash(const State<Dim>& state, const Grids<Dim>& grids) {
  const std::string of_state = state_hash(state);
  std::uint64_t hash = XXH3_64bits(of_state.data(), of_state.size());
  for (const Grid<Dim>& grid : grids) add(grid, hash);
  std::array<char, 17> text;
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
  return text.data();
}

}  // namespace

template <int Dim>
void watch_parts(const StepWindow& window, const std::function<void(const PartHash&)>& take, Pipeline<Dim>& pipeline) {
  for (Stage<Dim>& stage : pipeline)
    stage.run = [window, take, name = stage.name, run = std::move(stage.run)](State<Dim>& state, Grids<Dim>& grids,
                                                                              const StepContext& step) {
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
