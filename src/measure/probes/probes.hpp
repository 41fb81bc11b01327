// The list of all probes. Only what reads or measures them includes this: a new probe does not recompile the rest.
#pragma once

#include <variant>

#include "cut_probe.hpp"
#include "exact_probe.hpp"
#include "extremes_probe.hpp"
#include "front_probe.hpp"
#include "geotube_probe.hpp"
#include "patch_probe.hpp"
#include "pressure_probe.hpp"
#include "region_probe.hpp"
#include "section_probe.hpp"
#include "span_probe.hpp"
#include "stress_probe.hpp"
#include "tracer_probe.hpp"

namespace geodrop {

struct ProbeSpec {
  std::variant<TracerSpec, HydrostaticProbeSpec, ExactProbeSpec, GeotubeProbeSpec, SectionProbeSpec, SpanProbeSpec,
               StressProbeSpec, FrontProbeSpec, ExtremesProbeSpec, PatchProbeSpec, RegionProbeSpec, CutProbeSpec>
      probe;
  SourceRef at;
  bool operator==(const ProbeSpec&) const = default;
};

}  // namespace geodrop
