// A hash after each stage of some steps: it names the part of the step where two runs of one scene begin to differ.
#pragma once

#include <geodrop/step/pipeline.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace geodrop {

inline constexpr const char* parts_name = "parts.csv";

struct PartHash {
  std::uint64_t step = 0;  ///< 0: the first
  std::string stage;
  std::string hash;  ///< of the state and of what the stages of a step hand to each other on the grid
  bool operator==(const PartHash&) const = default;
};

/// Hands each hash to `take` as soon as its stage has run.
template <int Dim>
void watch_parts(const StepWindow& window, const std::function<void(const PartHash&)>& take, Pipeline<Dim>& pipeline);

/// Writes the hashes to a file as they come.
template <int Dim>
void record_parts(const StepWindow& window, const std::filesystem::path& path, Pipeline<Dim>& pipeline);

/// In the order in which they were written; none if there is no such file.
std::vector<PartHash> read_parts(const std::filesystem::path& path);

}  // namespace geodrop
