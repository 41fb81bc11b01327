// Colours of pictures: scales for values, fixed ones for materials and layers.
#pragma once

#include <cstdint>

namespace geodrop {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  bool operator==(const Colour&) const = default;
};

/// viridis rises in lightness; heat is for lines on top of it; difference has its white at one half.
enum class ColourScale { viridis, heat, difference };

/// `share`: from 0, the lowest value, to 1; beyond them the colours of the ends, grey if it is not finite.
Colour colour_at(ColourScale scale, double share);

/// 0xRRGGBB
std::uint32_t rgb(Colour colour);

}  // namespace geodrop
