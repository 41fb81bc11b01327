// Tension of a part of a membrane (2D).
#pragma once

#include "probe.hpp"

namespace geodrop {

struct SpanProbeSpec {
  static constexpr const char* word = "span";
  static constexpr const char* meaning = "tension of a part of a membrane";

  std::string name;
  std::string membrane;
  Point from, to;  ///< on the membrane as drawn [m]
  bool operator==(const SpanProbeSpec&) const = default;

  static std::vector<Key> rows() {
    constexpr RowsOf<SpanProbeSpec> key;
    return {
        key("membrane", &SpanProbeSpec::membrane, required, reference, "the membrane"),
        key("from", &SpanProbeSpec::from, "m", required, any, "one end of the part, on the membrane as drawn"),
        key("to", &SpanProbeSpec::to, "m", required, any, "its other end; round a closed membrane the shorter way")};
  }
  void check(const ProbeCheck& probe) const {
    probe.membrane(membrane);
    probe.plane(word);
  }
  void list(HistoryRow& row, const Scene& scene, const State<2>* state) const;
};

struct SpanTension {
  double mean = 0, max = 0;  ///< over unstretched length [N/m]
};

SpanTension span_tension(const Scene& scene, const SpanProbeSpec& probe, const State<2>& state);

inline void SpanProbeSpec::list(HistoryRow& row, const Scene& scene, const State<2>* state) const {
  const SpanTension tension = state ? span_tension(scene, *this, *state) : SpanTension{};
  row.add(name + ".tension_mean_N_m", tension.mean);
  row.add(name + ".tension_max_N_m", tension.max);
}

}  // namespace geodrop
