// `geodrop geotube`: the exact shape of a tube as a calculator.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace geodrop {

/// Options as given; nothing that was not given has a value.
struct GeotubeArguments {
  double perimeter, unit_weight;
  std::optional<double> area, height, pressure, tension, stiffness, water_level, water_unit_weight;
  std::optional<double> strength, seam_efficiency, installation, creep, durability, seam;
  std::string table;   ///< "height=0.5:2.5:0.1"
  std::string output;  ///< directory
  int segments = 400;  ///< of the outline
};

void add_geotube_options(CLI::App& command, GeotubeArguments& arguments);

/// Prints, and with --output writes geotube.csv, outline.csv (of one tube) and outline.svg. Returns the exit code.
int run_geotube(const GeotubeArguments& arguments);

}  // namespace geodrop
