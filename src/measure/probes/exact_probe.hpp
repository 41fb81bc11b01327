// Difference of a body from the exact solution that it follows.
#pragma once

#include "probe.hpp"

namespace geodrop {

struct ExactProbeSpec {
  static constexpr const char* word = "exact";
  static constexpr const char* meaning = "errors against the solution that the body follows";

  std::string name;
  std::string body;
  bool operator==(const ExactProbeSpec&) const = default;

  static std::vector<Key> rows() {
    constexpr RowsOf<ExactProbeSpec> key;
    return {key("body", &ExactProbeSpec::body, required, reference, "whose particles")};
  }
  void check(const ProbeCheck& probe) const { probe.body(body); }

  /// The columns that the solution tells something about.
  template <int Dim>
  void list(HistoryRow& row, const Scene& scene, const State<Dim>* state) const {
    const ExactError error = state ? exact_error(scene, *state, find_named(state->bodies, body)) : ExactError{};
    const ExactSpec& spec = *find_exact(scene, body);
    row.add(name + ".velocity_error_rms_ratio", error.velocity_rms);
    row.add(name + ".velocity_error_max_ratio", error.velocity_max);
    if (std::holds_alternative<TaylorGreenSpec>(spec.solution) ||
        std::holds_alternative<LambDipoleSpec>(spec.solution)) {
      row.add(name + ".kinetic_energy_ratio", error.kinetic_energy);
      row.add(name + ".pressure_error_rms_ratio", error.pressure_rms);
      row.add(name + ".node_density_min_ratio", error.density_min);
      row.add(name + ".node_density_max_ratio", error.density_max);
      return;
    }
    row.add(name + ".displacement_error_rms_m", error.displacement_rms);
    row.add(name + ".displacement_error_max_m", error.displacement_max);
    row.add(name + ".strain_error_rms_ratio", error.strain_rms);
    row.add(name + ".strain_error_max_ratio", error.strain_max);
    if (!std::holds_alternative<BarFirstModeSpec>(spec.solution)) return;
    row.add(name + ".mode_energy_ratio", error.mode_energy);
    row.add(name + ".phase_error_rad", error.phase);
  }
};

}  // namespace geodrop
