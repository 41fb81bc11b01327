// Particles as pixels: each pixel has the colour of the nearest particle. Triangles as pixels: that of the foremost.
#pragma once

#include "colours.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace geodrop {

/// A part of the plane.
struct Window {
  std::array<double, 2> lower{}, upper{};  ///< [m]

  double width() const { return upper[0] - lower[0]; }
  double height() const { return upper[1] - lower[1]; }
};

struct PixelSize {
  int width = 0, height = 0;  ///< [px]
};

/// The pixels inside of closed lines, the lowest row first.
using Mask = std::vector<bool>;

/// `ends`: x and y of both ends of each piece of the lines, in any order [m]. Inside: a ray crosses an odd number.
Mask inside_of(const std::vector<std::array<double, 4>>& ends, const Window& window, PixelSize size);

/// One colour on the pixels of a mask, over what bytes as of draw_discs show.
void fill(std::string& pixels, const Mask& mask, Colour colour);

struct Disc {
  std::array<double, 2> centre{};  ///< [m]
  double radius = 0;               ///< [m]
  Colour colour;
  const Mask* within = nullptr;  ///< where it is seen, if its centre is there
};

/// Four bytes a pixel, red, green, blue, opacity, the lowest row first; opacity 0 where no disc is. Of discs that
/// overlap the one with the nearer centre is seen, so that particles fill the plane without an order; narrow gaps
/// between them are closed.
std::string draw_discs(const std::vector<Disc>& discs, const Window& window, PixelSize size);

/// A triangle in space.
struct Facet {
  std::array<std::array<double, 3>, 3> corners{};  ///< x and y of the plane, z towards the viewer [m]
  Colour colour;
};

/// Bytes as of draw_discs: each pixel has the colour of the triangle with the largest z at its centre.
std::string draw_facets(const std::vector<Facet>& facets, const Window& window, PixelSize size);

}  // namespace geodrop
