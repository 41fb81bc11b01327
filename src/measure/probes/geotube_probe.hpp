// A simulated geotube beside the exact one of the same fill (geotube.hpp), for history.csv and for pictures.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "probe.hpp"

namespace geodrop {

struct GeotubeProbeSpec {
  static constexpr const char* word = "geotube";
  static constexpr const char* meaning =
      "shape and pressures of a closed membrane full of fluid beside those of the closed form";

  std::string name;
  std::string membrane;
  std::string water;       ///< material of the water outside; empty: dry
  double water_level = 0;  ///< of that over the tube's lowest point [m]
  bool operator==(const GeotubeProbeSpec&) const = default;

  static std::vector<Key> rows() {
    using Probe = GeotubeProbeSpec;
    constexpr RowsOf<Probe> key;
    return {
        key("membrane", &Probe::membrane, required, reference, "the membrane, a closed one"),
        key.decides("outside", {"air", "water"}, standard("\"air\""), "what stands around the tube of the closed form"),
        key("water", &Probe::water, required, reference, "the newtonian material of that water").only("outside=water"),
        key("water_level", &Probe::water_level, "m", required, positive, "its level over the ground")
            .only("outside=water")};
  }
  void check(const ProbeCheck& probe) const {
    if (probe.membrane(membrane) && !find_named(probe.scene.membranes, membrane).closed)
      probe.report.add(probe.key + ".membrane", '"' + membrane + "\", which is open", "a closed membrane");
    if (!water.empty()) probe.fluid(water, ".water");
    probe.plane(word);
  }
  void list(HistoryRow& row, const Scene& scene, const State<2>* state) const;
  /// Writes geotube_PROBE_outline.csv (membrane and its tension), geotube_PROBE_exact.csv (exact outline) and
  /// geotube_PROBE_pressure.csv (of the particles), which `geodrop plot` draws.
  void write_profile(const Scene& scene, const State<2>& state, const std::filesystem::path& directory) const;
};

/// Names (behind "PROBE.") and values of the columns of a geotube; the values are 0 without a state. Pressures are
/// those of the fluid within a cell of the ends of the membrane, carried on to them by its weight, over the
/// atmosphere's. The exact tube has the same unstretched perimeter, stiffness and rest volume; NaN where there is none.
std::vector<std::pair<std::string, double>> geotube_columns(const Scene& scene, const GeotubeProbeSpec& probe,
                                                            const State<2>* state);

inline void GeotubeProbeSpec::list(HistoryRow& row, const Scene& scene, const State<2>* state) const {
  for (const auto& [column, value] : geotube_columns(scene, *this, state)) row.add(name + "." + column, value);
}

}  // namespace geodrop
