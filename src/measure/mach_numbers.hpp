// How fast a run was beside the wave speeds of its fluids, read off the history: errors of a weakly compressible fluid
// are of the order of the Mach number squared.
#pragma once

#include <geodrop/measure/history.hpp>
#include <geodrop/measure/measure.hpp>
#include <geodrop/scene/scene.hpp>

#include <vector>

namespace geodrop {

/// `<body>.mach_ratio` of each body of a fluid: the largest rms velocity that any body had in a row, over the wave
/// speed of the fluid.
std::vector<Fact> mach_numbers(const Scene& scene, const HistoryTable& history);

}  // namespace geodrop
