// How much memory a scene takes, told before any of it is allocated.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <string>

namespace geodrop {

struct MemoryEstimate {
  double particles = 0;  ///< at most about
  double cells = 0;      ///< of all velocity fields
  double bytes = 0;      ///< of both and of the program itself
};

MemoryEstimate estimate_memory(const Scene& scene);

/// "about 3.1 GB for 2.3e+07 particles and 1.5e+06 cells"
std::string describe(const MemoryEstimate& estimate);

/// Throws SceneError if the scene takes more memory than this machine (or the group of processes that the program
/// belongs to) has: the system would kill the program, and others, without a word.
void require_memory(const Scene& scene);

}  // namespace geodrop
