// How far the pressure of water is from that of still water, near the tips of a membrane and elsewhere.
#pragma once

#include "probe.hpp"

namespace geodrop {

struct HydrostaticProbeSpec {
  static constexpr const char* word = "hydrostatic";
  static constexpr const char* meaning = "rms pressure error of a fluid at rest";

  std::string name;
  std::string body;
  HydrostaticSpec still;
  std::string tips_of{};  ///< membrane near whose lowest and highest node errors count apart; empty: none
  bool operator==(const HydrostaticProbeSpec&) const = default;

  static std::vector<Key> rows() {
    using Probe = HydrostaticProbeSpec;
    constexpr RowsOf<Probe> key;
    return {key("body", &Probe::body, required, reference, "whose particles are compared"),
            key(
                "fluid", [](Probe& probe, const std::string& fluid) { probe.still.fluid = fluid; }, required, reference,
                "the newtonian material of the still fluid"),
            key(
                "surface", [](Probe& probe, double level) { probe.still.surface = level; }, "m", required, any,
                "level of the fluid's free surface"),
            key("tips_of", &Probe::tips_of, standard("\"\""), free_text,
                "a membrane: what is within 2 h (of the finest cell) of its lowest or highest node counts apart in the "
                "99.9th percentile")};
  }
  void check(const ProbeCheck& probe) const {
    probe.body(body);
    probe.fluid(still.fluid, ".fluid");
    if (!tips_of.empty()) probe.membrane(tips_of, ".tips_of");
  }
  template <int Dim>
  void list(HistoryRow& row, const Scene& scene, const State<Dim>* state) const;
};

/// 99.9th percentiles of |p - still| over the particles [Pa]. `tips`: of those within 2 h of the lowest or highest node
/// of the membrane that the probe names, where no grid resolves the curvature; NaN if it names none or none is there.
struct PressureSpread {
  double elsewhere = 0, tips = 0;
};
template <int Dim>
PressureSpread pressure_spread(const Scene& scene, const HydrostaticProbeSpec& probe, const State<Dim>& state);

template <int Dim>
void HydrostaticProbeSpec::list(HistoryRow& row, const Scene& scene, const State<Dim>* state) const {
  PressureError error;
  PressureSpread spread;
  if (state) {
    const Material fluid = make_material(*find_material(scene, still.fluid));
    error = pressure_error(find_named(state->bodies, body), std::get<Newtonian>(fluid), still.surface,
                           -scene.gravity[vertical_axis<Dim>]);
    spread = pressure_spread(scene, *this, *state);
  }
  row.add(name + ".pressure_error_rms_Pa", error.rms);
  row.add(name + ".pressure_error_max_Pa", error.max);
  row.add(name + ".pressure_error_p999_Pa", spread.elsewhere);
  if (!tips_of.empty()) row.add(name + ".pressure_error_tips_p999_Pa", spread.tips);
}

}  // namespace geodrop
