// How far a heap reaches, lone particles ahead of it left out (2D).
#pragma once

#include "probe.hpp"

namespace geodrop {

struct FrontProbeSpec {
  static constexpr const char* word = "front";
  static constexpr const char* meaning = "how far a heap reaches to both sides, lone particles left out";

  std::string name;
  std::string body;
  double thickness = 0;  ///< that a heap has at its front [m]
  bool operator==(const FrontProbeSpec&) const = default;

  static std::vector<Key> rows() {
    constexpr RowsOf<FrontProbeSpec> key;
    return {key("body", &FrontProbeSpec::body, required, reference, "the heap"),
            key("thickness", &FrontProbeSpec::thickness, "m", required, positive,
                "of a heap at its front: volume in an upright column of cells over its width")};
  }
  void check(const ProbeCheck& probe) const {
    probe.body(body);
    probe.plane(word);
  }
  void list(HistoryRow& row, const Scene& scene, const State<2>* state) const;
};

struct HeapFronts {
  double left = 0, right = 0;  ///< [m]
};

/// From the upright column of cells that holds most of the body, to both sides, as far as its thickness (volume over
/// width of a column, linear between their middles) stays above that of the probe; at most to the walls.
HeapFronts heap_fronts(const GridSpec& grid, const FrontProbeSpec& probe, const Body<2>& body);

inline void FrontProbeSpec::list(HistoryRow& row, const Scene& scene, const State<2>* state) const {
  const HeapFronts fronts = state ? heap_fronts(scene.grid, *this, find_named(state->bodies, body)) : HeapFronts{};
  row.add(name + ".left_m", fronts.left);
  row.add(name + ".right_m", fronts.right);
}

}  // namespace geodrop
