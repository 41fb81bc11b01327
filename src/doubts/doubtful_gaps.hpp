// Room between bodies that was probably left by mistake.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <string>
#include <vector>

namespace geodrop {

/// Fluids at rest that begin above something with nothing between, so that they would fall, and fluids that end just
/// before a wall or another body, so that they would flow there. Looked for along lines through the domain, so that a
/// gap smaller than their distance may be missed; the first of each kind is told.
std::vector<std::string> doubtful_gaps(const Scene& scene);

}  // namespace geodrop
