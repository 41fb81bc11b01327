// How far the pressure of water is from that of still water, near the tips of a membrane and elsewhere.
#pragma once

#include <geodrop/scene.hpp>
#include <geodrop/scene/probes.hpp>
#include <geodrop/state.hpp>

namespace geodrop {

/// 99.9th percentiles of |p - still| over the particles [Pa]. `tips`: of those within 2 h of the lowest or highest node
/// of the membrane that the probe names, where no grid resolves the curvature; NaN if it names none or none is there.
struct PressureSpread {
  double elsewhere = 0, tips = 0;
};
template <int Dim>
PressureSpread pressure_spread(const Scene& scene, const HydrostaticProbeSpec& probe, const State<Dim>& state);

}  // namespace geodrop
