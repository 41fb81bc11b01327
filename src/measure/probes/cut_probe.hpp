// What a membrane in space bears across a plane, and what the plane cuts out of it.
#pragma once

#include "probe.hpp"

namespace geodrop {

struct CutProbeSpec {
  static constexpr const char* word = "cut";
  static constexpr const char* meaning =
      "force of a membrane in space across a plane, girth and area of the section that the plane cuts out of it";

  std::string name;
  std::string membrane;
  Point point;       ///< of the plane [m]
  Point normal;      ///< across it
  double width = 0;  ///< of the slab of planes that the force is a mean over [m]
  bool operator==(const CutProbeSpec&) const = default;

  static std::vector<Key> rows() {
    constexpr RowsOf<CutProbeSpec> key;
    return {key("membrane", &CutProbeSpec::membrane, required, reference, "the membrane, of triangles").in(3),
            key("point", &CutProbeSpec::point, "m", required, any,
                "a point of the plane; where the membrane ends at a plane of symmetry a point of that too, so that the "
                "area is that of what is left")
                .in(3),
            key("normal", &CutProbeSpec::normal, required, any,
                "across the plane: the force is that of the cloth ahead on the cloth behind")
                .in(3),
            key("width", &CutProbeSpec::width, "m", required, positive,
                "the force is the mean over planes up to half of this ahead and behind; that of a single one hangs on "
                "the few triangles that it meets: several of their edges")
                .in(3)};
  }
  void check(const ProbeCheck& probe) const {
    probe.membrane(membrane);
    probe.space(word, "cuts");
    if (probe.report.healthy(probe.key) && normal.size() == 3 && Vec<3>(normal.data()).norm() == 0)
      probe.report.add(probe.key + ".normal", to_text(normal), "a direction");
  }
  void list(HistoryRow& row, const Scene& scene, const State<3>* state) const;
};

/// The section of a membrane by a plane. The force is that of virtual work, less the sum of w f over the forces of the
/// triangles on the nodes, with w from 0 to 1 across the slab.
struct Cut {
  Vec<3> force = Vec<3>::Zero();   ///< of the cloth ahead on the cloth behind [N]
  double girth = 0;                ///< length of the cut now [m]
  double area = 0;                 ///< that it encloses [m2]
  Vec<3> middle = Vec<3>::Zero();  ///< of that area [m]; NaN without area
};
/// `normal` of length 1, `width` of the slab [m].
Cut cut_membrane(const Membrane<3>& membrane, const Vec<3>& point, const Vec<3>& normal, double width);

inline void CutProbeSpec::list(HistoryRow& row, const Scene&, const State<3>* state) const {
  const Cut cut = state ? cut_membrane(find_named(state->membranes, membrane), Vec<3>(point.data()),
                                       Vec<3>(normal.data()).normalized(), width)
                        : Cut{};
  row.add_vector(name + ".force", "N", cut.force, 3);
  row.add(name + ".girth_m", cut.girth);
  row.add(name + ".area_m2", cut.area);
  row.add_vector(name + ".middle", "m", cut.middle, 3);
}

}  // namespace geodrop
