#include "membrane_peaks.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace geodrop {
namespace {

/// Place of the largest tension of the row: "(1.5, 2)".
std::string place(const Scene& scene, const HistoryTable& history, const std::string& membrane) {
  constexpr const char* axes[] = {"x", "y", "z"};
  constexpr int digits = 4;
  std::string text;
  for (int a = 0; a < scene.dimension; ++a) {
    const std::size_t column = history.find(membrane + ".tension_gauge_" + axes[a] + "_m");
    text += (a == 0 ? "(" : ", ") + format_number(history.rows.back()[column], digits);
  }
  return text + ") m";
}

}  // namespace

std::vector<std::string> strength_warnings(const Scene& scene, const HistoryTable& history) {
  constexpr int digits = 4;
  std::vector<std::string> warnings;
  for (const MembraneSpec& membrane : scene.membranes) {
    const std::size_t peak = history.find(membrane.name + ".tension_gauge_N_m");
    const auto exceeds = [&](const std::vector<double>& row) {
      return membrane.strength > 0 && row[peak] > membrane.strength;
    };
    const std::vector<double>& last = history.rows.back();
    if (!exceeds(last) || std::any_of(history.rows.begin(), history.rows.end() - 1, exceeds)) continue;
    warnings.push_back("warning: membrane " + membrane.name + " exceeds its strength: tension " +
                       format_number(last[peak], digits) + " N/m, strength " +
                       format_number(membrane.strength, digits) +
                       " N/m, by t = " + format_number(last.front(), digits) + " s, near " +
                       place(scene, history, membrane.name) + "; it does not tear, the run goes on");
  }
  return warnings;
}

std::vector<Fact> membrane_peaks(const Scene& scene, const HistoryTable& history) {
  std::vector<Fact> facts;
  if (history.rows.empty()) return facts;
  for (const MembraneSpec& membrane : scene.membranes) {
    const std::string name = membrane.name + ".tension_gauge_N_m";
    const std::size_t peak = history.find(name);
    const std::vector<double>& highest = *std::max_element(
        history.rows.begin(), history.rows.end(),
        [&](const std::vector<double>& a, const std::vector<double>& b) { return a[peak] < b[peak]; });
    facts.push_back({name, highest[peak]});
    facts.push_back(
        {membrane.name + ".time_of_peak_s", highest[history.find(membrane.name + ".tension_gauge_time_s")]});
  }
  return facts;
}

}  // namespace geodrop
