// The largest tension that each membrane bore, read off the history.
#pragma once

#include <geodrop/measure/history.hpp>
#include <geodrop/measure/measure.hpp>
#include <geodrop/scene/scene.hpp>

#include <string>
#include <vector>

namespace geodrop {

/// One line for each membrane whose tension exceeds its strength in the last row and in none before. The solver does
/// not tear membranes: it goes on as if they held.
std::vector<std::string> strength_warnings(const Scene& scene, const HistoryTable& history);

/// `<membrane>.tension_gauge_N_m`, the largest tension over the gauge of the whole run, and
/// `<membrane>.time_of_peak_s`.
std::vector<Fact> membrane_peaks(const Scene& scene, const HistoryTable& history);

}  // namespace geodrop
