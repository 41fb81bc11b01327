// Points of the scales at equal distances, linear between them. viridis: Smith & van der Walt 2015 (matplotlib, CC0);
// difference: Moreland 2009, cool to warm.
#include "colours.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace geodrop {
namespace {

constexpr Colour viridis[] = {{68, 1, 84},    {71, 44, 122}, {59, 81, 139},  {44, 113, 142}, {33, 144, 141},
                              {39, 173, 129}, {92, 200, 99}, {170, 220, 50}, {253, 231, 37}};
constexpr Colour heat[] = {{60, 60, 60}, {120, 28, 60}, {190, 20, 40}, {232, 90, 20}, {255, 190, 30}};
constexpr Colour difference[] = {{59, 76, 192}, {141, 176, 254}, {221, 221, 221}, {244, 154, 123}, {180, 4, 38}};
constexpr Colour no_value = {160, 160, 160};

std::span<const Colour> points_of(ColourScale scale) {
  switch (scale) {
    case ColourScale::viridis:
      return viridis;
    case ColourScale::heat:
      return heat;
    case ColourScale::difference:
      return difference;
  }
  return viridis;
}

}  // namespace

Colour colour_at(ColourScale scale, double share) {
  if (!std::isfinite(share)) return no_value;
  const std::span<const Colour> points = points_of(scale);
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(points.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(at), points.size() - 2);
  const double part = at - static_cast<double>(low);
  const auto mix = [part](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + part * (to - from)));
  };
  const Colour &a = points[low], &b = points[low + 1];
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

std::uint32_t rgb(Colour colour) {
  return static_cast<std::uint32_t>(colour.red) << 16U | static_cast<std::uint32_t>(colour.green) << 8U | colour.blue;
}

}  // namespace geodrop
