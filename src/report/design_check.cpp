#include "design_check.hpp"

#include <algorithm>
#include <cmath>

namespace geodrop {
namespace {

bool has(const CsvTable& table, const std::string& column) {
  return std::ranges::find(table.names, column) != table.names.end();
}

}  // namespace

std::vector<PeakTension> peak_tensions(const Scene& scene, const CsvTable& history) {
  std::vector<PeakTension> peaks;
  for (const MembraneSpec& membrane : scene.membranes) {
    const std::string column = membrane.name + ".tension_gauge";
    if (!has(history, column + "_N_m") || !has(history, column + "_time_s")) continue;
    const std::vector<double>& tension = history.column(column + "_N_m");
    const auto largest =
        std::ranges::max_element(tension, {}, [](double value) { return std::isnan(value) ? 0 : value; });
    const auto row = static_cast<std::size_t>(largest - tension.begin());
    const auto at = [&](const std::string& ending) { return history.column(column + ending)[row]; };
    peaks.push_back({membrane.name, *largest, at("_time_s"), {at("_x_m"), at("_y_m")}, membrane.strength});
  }
  return peaks;
}

std::optional<double> safety(const PeakTension& peak, TensionStrength factors) {
  if (peak.strength <= 0 || !(peak.tension > 0)) return std::nullopt;
  factors.strength = peak.strength;
  return allowable_tension(factors) / peak.tension;
}

std::vector<RestingPlace> resting_places(const Scene& scene, const CsvTable& history) {
  std::vector<RestingPlace> places;
  for (const MembraneSpec& membrane : scene.membranes) {
    const std::string& body = membrane.body;
    if (!membrane.closed || !has(history, body + ".height_m") || !has(history, body + ".rotation_deg")) continue;
    if (std::ranges::find(places, body, &RestingPlace::body) != places.end()) continue;
    const auto last = [&](const std::string& ending) { return history.column(body + ending).back(); };
    places.push_back({body, history.column("time_s").back(), last(".position_x_m"), last(".position_y_m"),
                      std::hypot(last(".velocity_x_m_s"), last(".velocity_y_m_s")), last(".rotation_deg"),
                      last(".height_m"), last(".width_m"), last(".lowest_m")});
  }
  return places;
}

}  // namespace geodrop
