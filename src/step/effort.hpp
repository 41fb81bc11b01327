// What a run will take, from a trial of a few steps.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <string>

namespace geodrop {

struct Effort {
  double particles = 0;
  double steps = 0;    ///< three digits
  double seconds = 0;  ///< of wall time, three digits; NaN: the trial broke
  double memory_bytes = 0;
  double output_bytes = 0;  ///< of frames
  std::string failure{};    ///< what broke the trial
};

/// Makes some steps of the scene, at most about a second of them, on so many threads. Steps are taken to be as long as
/// the first ones: a run whose bodies get fast takes more of them.
Effort estimate_effort(const Scene& scene, int threads);

/// "34926 particles, about 21600 steps, 1:40 (on 2 threads), 60 MB of memory, 305 MB of frames", or what breaks it.
std::string effort_in_words(const Effort& effort);

}  // namespace geodrop
