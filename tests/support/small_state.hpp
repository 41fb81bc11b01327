// A scene and a state by hand, small enough to work out every number on paper: four particles of water in a row, a
// square of four soil particles with a membrane around it, one tracer.
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

#include <array>
#include <vector>

namespace geodrop {

Scene small_scene();

/// Particles of `mass` each at rest where they are now.
Body<2> body_at(const MaterialSpec& material, const std::vector<std::array<double, 2>>& places, double mass);

/// Closed square of side 2 around (4, 4), axial stiffness 1000 N/m, strength 500 N/m.
Membrane<2> square_membrane();

State<2> small_state();

}  // namespace geodrop
