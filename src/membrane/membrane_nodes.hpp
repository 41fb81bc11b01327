// Where the nodes of a membrane are when it is drawn.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <vector>

namespace geodrop {

/// In order along the membrane [m], about h / segments_per_cell apart; the last of a closed one does not repeat the
/// first.
std::vector<Point> membrane_nodes(const Scene& scene, const MembraneSpec& spec);

}  // namespace geodrop
