// Tension of a part of a membrane (2D).
#pragma once

#include <geodrop/scene.hpp>
#include <geodrop/scene/probes.hpp>
#include <geodrop/state.hpp>

namespace geodrop {

struct SpanTension {
  double mean = 0, max = 0;  ///< over unstretched length [N/m]
};

SpanTension span_tension(const Scene& scene, const SpanProbeSpec& probe, const State<2>& state);

}  // namespace geodrop
