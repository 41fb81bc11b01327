// Horizontal forces that a body and its membrane carry over an upright section (2D).
//
//   w(x) = sum of N_i(x) over the nodes right of the section (on it: by half)
//   soil: sum V_p sigma_xx w'(x_p),   membrane: sum over segments of T t_x (w(X_end) - w(X_start))
//
// These are what the grid itself balances with gravity and contact: a band of particles around the section counts
// columns of particles, and errs by 5 to 15 %.
#pragma once

#include "probe.hpp"

namespace geodrop {

struct SectionProbeSpec {
  static constexpr const char* word = "section";
  static constexpr const char* meaning = "horizontal forces over an upright section";

  std::string name;
  std::string body;
  double position = 0;  ///< [m]
  bool operator==(const SectionProbeSpec&) const = default;

  static std::vector<Key> rows() {
    constexpr RowsOf<SectionProbeSpec> key;
    return {key("body", &SectionProbeSpec::body, required, reference, "the body that is cut, with its membrane"),
            key("x", &SectionProbeSpec::position, "m", required, any, "where the section is")};
  }
  void check(const ProbeCheck& probe) const {
    probe.body(body);
    probe.plane(word);
  }
  void list(HistoryRow& row, const Scene& scene, const State<2>* state) const;
};

/// Per metre of depth [N/m].
struct SectionForces {
  double soil = 0;      ///< compression positive
  double membrane = 0;  ///< tension positive
};

SectionForces section_forces(const Scene& scene, const SectionProbeSpec& probe, const State<2>& state);

inline void SectionProbeSpec::list(HistoryRow& row, const Scene& scene, const State<2>* state) const {
  const SectionForces forces = state ? section_forces(scene, *this, *state) : SectionForces{};
  row.add(name + ".soil_force_N_m", forces.soil);
  row.add(name + ".membrane_force_N_m", forces.membrane);
  row.add(name + ".net_force_N_m", forces.soil - forces.membrane);
}

}  // namespace geodrop
