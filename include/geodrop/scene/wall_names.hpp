// Names of the walls of the domain, as scenes have them.
#pragma once

#include <array>
#include <cstddef>

namespace geodrop {

/// Both walls of an axis, the lower one first; of the vertical axis, which is the last one of a scene, at the end.
inline constexpr std::array<const char*, 6> wall_names{"left", "right", "front", "back", "bottom", "top"};

/// The name of a wall of a scene in so many dimensions.
inline const char* wall_name(std::size_t axis, bool upper, std::size_t dimension) {
  const std::size_t pair = axis + 1 == dimension ? 2 : axis;
  return wall_names[2 * pair + (upper ? 1 : 0)];
}

}  // namespace geodrop
