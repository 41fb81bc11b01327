// What the particles of a material do that are in a box now: their pressure and vertical stress, and how much of them
// flows through it.
#pragma once

#include "probe.hpp"

namespace geodrop {

struct RegionProbeSpec {
  static constexpr const char* word = "region";
  static constexpr const char* meaning =
      "volume, mean pressure, mean vertical stress (total, in soil with its pore pressure; tension positive), mean "
      "velocity and flow of what a material has in a box now";

  std::string name;
  std::string material;  ///< of one body or of several
  Point lower, upper;    ///< [m]
  bool operator==(const RegionProbeSpec&) const = default;

  static std::vector<Key> rows() {
    constexpr RowsOf<RegionProbeSpec> key;
    return {key("material", &RegionProbeSpec::material, required, reference, "whose particles, of all bodies"),
            key("lower", &RegionProbeSpec::lower, "m", required, any, "lower corner of the box"),
            key("upper", &RegionProbeSpec::upper, "m", required, any,
                "its upper corner; the flow along an axis is the sum of volume times velocity over the extent along "
                "it: the mean over all sections across")};
  }
  void check(const ProbeCheck& probe) const {
    check_reference(probe.key + ".material", material, names_of(probe.scene.materials), "materials", probe.report);
    for (std::size_t a = 0; a < std::min(lower.size(), upper.size()); ++a) {
      if (lower[a] < upper[a]) continue;
      probe.report.add(probe.key + ".upper", to_text(upper), "a corner beyond " + to_text(lower) + " along all axes");
      return;
    }
  }
  template <int Dim>
  void list(HistoryRow& row, const Scene& scene, const State<Dim>* state) const;
};

/// Sums over the particles in the box.
struct RegionSums {
  double volume = 0;                ///< [m3]
  double pressure = 0;              ///< times volume [N m]
  double vertical_stress = 0;       ///< likewise
  std::array<double, 3> flow = {};  ///< volume times velocity [m4/s]
  RegionSums& operator+=(const RegionSums&);
};
template <int Dim>
RegionSums region_sums(const Scene& scene, const RegionProbeSpec& probe, const State<Dim>& state);

/// Means of an empty region are NaN.
template <int Dim>
void RegionProbeSpec::list(HistoryRow& row, const Scene& scene, const State<Dim>* state) const {
  const RegionSums sums = state ? region_sums(scene, *this, *state) : RegionSums{};
  std::array<double, Dim> velocity{}, flow{};
  for (int a = 0; a < Dim; ++a) {
    velocity[a] = sums.flow[a] / sums.volume;
    flow[a] = state ? sums.flow[a] / (upper[a] - lower[a]) : 0;
  }
  row.add(name + (Dim == 2 ? ".volume_m2" : ".volume_m3"), sums.volume);
  row.add(name + ".pressure_mean_Pa", sums.pressure / sums.volume);
  row.add(name + ".vertical_stress_mean_Pa", sums.vertical_stress / sums.volume);
  row.add_vector(name + ".velocity_mean", "m_s", velocity, Dim);
  row.add_vector(name + ".flow", Dim == 2 ? "m2_s" : "m3_s", flow, Dim);
}

}  // namespace geodrop
