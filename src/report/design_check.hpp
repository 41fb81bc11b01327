// What the geotextile of a run bears beside what it may bear, and where its body comes to rest.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "calculators/tension_safety.hpp"
#include "plot/csv_table.hpp"

namespace geodrop {

/// The largest tension of a membrane in a run (the mean over its gauge and 10 ms).
struct PeakTension {
  std::string membrane;
  double tension = 0;         ///< [N/m]
  double time = 0;            ///< [s]
  std::vector<double> place;  ///< middle of the gauge, by axis [m]
  double strength = 0;        ///< of the geotextile, short-term [N/m]; 0: the scene gives none
};

/// From the columns NAME.tension_gauge_*; none of membranes whose history lacks them.
std::vector<PeakTension> peak_tensions(const Scene& scene, const CsvTable& history);

/// Allowable tension of fabric and seams over the peak; empty without a strength. `factors`: its strength is not used.
std::optional<double> safety(const PeakTension& peak, TensionStrength factors);

/// Rest of a body that a closed membrane encloses, from the last row.
struct RestingPlace {
  std::string body;
  double time = 0;             ///< of the row [s]
  std::vector<double> centre;  ///< by axis [m]
  double speed = 0;            ///< of the centre [m/s]
  double turn_deg = 0;         ///< in the plane counterclockwise, full turns counted; in space the angle about its axis
  double height = 0, width = 0, lowest = 0;  ///< [m]
  std::optional<double> depth{};             ///< in space: along y [m]
  /// In the plane: depth of the lowest point below the surface that the bed had at the start there; negative: above it
  /// [m]. Nothing without a bed.
  std::optional<double> burial{};

  /// Faster than what creeps or quivers [m/s]: it has not come to rest.
  bool is_moving() const {
    constexpr double fastest_rest = 0.05;
    return speed > fastest_rest;
  }
};

/// Height of the surface of the bed at the start at a place x of the plane [m]: of `bed`, or where that is empty of the
/// highest soil that no membrane encloses. Nothing if there is none.
std::optional<double> bed_surface(const Scene& scene, const std::string& bed, double x);

std::vector<RestingPlace> resting_places(const Scene& scene, const CsvTable& history);

}  // namespace geodrop
