// Tension and extent of a part of a membrane in space.
#pragma once

#include "probe.hpp"

namespace geodrop {

struct PatchProbeSpec {
  static constexpr const char* word = "patch";
  static constexpr const char* meaning = "tension and extent of a part of a membrane in space";

  std::string name;
  std::string membrane;
  Point lower, upper;  ///< of a box [m]
  bool operator==(const PatchProbeSpec&) const = default;

  static std::vector<Key> rows() {
    constexpr RowsOf<PatchProbeSpec> key;
    return {key("membrane", &PatchProbeSpec::membrane, required, reference, "the membrane, of triangles").in(3),
            key("lower", &PatchProbeSpec::lower, "m", required, any,
                "lower corner of a box: the part are the triangles whose middle is in it now")
                .in(3),
            key("upper", &PatchProbeSpec::upper, "m", required, any, "its upper corner").in(3)};
  }
  void check(const ProbeCheck& probe) const {
    probe.membrane(membrane);
    probe.space(word, "patches");
  }
  void list(HistoryRow& row, const Scene& scene, const State<3>* state) const;
};

/// Means and standard deviations over the cloth at rest, and the box around the corners; NaN without triangles.
struct PatchMeasures {
  double tension_mean = 0, tension_std = 0, cross_mean = 0, cross_std = 0;  ///< [N/m]
  Vec<3> lower = Vec<3>::Zero(), upper = Vec<3>::Zero();                    ///< [m]
  double plan_area = 0;  ///< half of the sum of the triangles' projections: what a closed one covers from above [m2]
};
PatchMeasures measure_patch(const PatchProbeSpec& probe, const Membrane<3>& membrane);

inline void PatchProbeSpec::list(HistoryRow& row, const Scene&, const State<3>* state) const {
  const PatchMeasures patch = state ? measure_patch(*this, find_named(state->membranes, membrane)) : PatchMeasures{};
  row.add(name + ".tension_mean_N_m", patch.tension_mean);
  row.add(name + ".tension_std_N_m", patch.tension_std);
  row.add(name + ".cross_tension_mean_N_m", patch.cross_mean);
  row.add(name + ".cross_tension_std_N_m", patch.cross_std);
  row.add_vector(name + ".width", "m", Vec<3>(patch.upper - patch.lower), 2);
  row.add(name + ".height_m", patch.upper[2] - patch.lower[2]);
  row.add(name + ".plan_area_m2", patch.plan_area);
}

}  // namespace geodrop
