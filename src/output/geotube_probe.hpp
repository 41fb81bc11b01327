// A simulated geotube beside the exact one of the same fill (geotube.hpp), for history.csv and for pictures.
#pragma once

#include <geodrop/scene.hpp>
#include <geodrop/scene/probes.hpp>
#include <geodrop/state.hpp>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace geodrop {

/// Names (behind "PROBE.") and values of the columns of a geotube; the values are 0 without a state. Pressures are
/// those of the fluid within a cell of the ends of the membrane, carried on to them by its weight, over the
/// atmosphere's. The exact tube has the same unstretched perimeter, stiffness and rest volume; NaN where there is none.
std::vector<std::pair<std::string, double>> geotube_columns(const Scene& scene, const GeotubeProbeSpec& probe,
                                                            const State<2>* state);

/// Writes geotube_PROBE_outline.csv (membrane and its tension), geotube_PROBE_exact.csv (exact outline) and
/// geotube_PROBE_pressure.csv (of the particles), which `geodrop plot` draws.
void write_geotube_profile(const Scene& scene, const GeotubeProbeSpec& probe, const State<2>& state,
                           const std::filesystem::path& directory);

}  // namespace geodrop
