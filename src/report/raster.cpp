#include "raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace geodrop {
namespace {

/// How far a gap may be closed: particles of a sheared flow stand in rows, and leave a cell without any now and then,
/// yet there is no void that the grid knows of.
constexpr double reach = 2.8;  // radii: a cell, of two particles along each axis

/// What of the discs is nearest to a pixel.
struct Nearest {
  float distance = std::numeric_limits<float>::infinity();  ///< of its centre [px]
  float radius = 0;                                         ///< [px]
};

/// Distance of each pixel from the nearest one that no disc reaches [px], about: chamfer distance, right to 8 %. What
/// is beyond the picture counts as reached.
std::vector<float> distance_from_void(const std::vector<Nearest>& nearest, PixelSize size) {
  const auto width = static_cast<std::size_t>(size.width), height = static_cast<std::size_t>(size.height);
  constexpr float diagonal = std::numbers::sqrt2_v<float>, far = 1e9F;
  std::vector<float> distance(nearest.size());
  for (std::size_t i = 0; i < nearest.size(); ++i) distance[i] = nearest[i].radius > 0 ? far : 0.0F;
  // From below and from the left, then from above and from the right.
  const auto pass = [&](const auto& index) {
    for (std::size_t j = 0; j < height; ++j)
      for (std::size_t i = 0; i < width; ++i) {
        float& here = distance[index(i, j)];
        if (i > 0) here = std::min(here, distance[index(i - 1, j)] + 1);
        if (j > 0) here = std::min(here, distance[index(i, j - 1)] + 1);
        if (i > 0 && j > 0) here = std::min(here, distance[index(i - 1, j - 1)] + diagonal);
        if (i + 1 < width && j > 0) here = std::min(here, distance[index(i + 1, j - 1)] + diagonal);
      }
  };
  pass([&](std::size_t i, std::size_t j) { return j * width + i; });
  pass([&](std::size_t i, std::size_t j) { return (height - 1 - j) * width + (width - 1 - i); });
  return distance;
}

void paint(std::string& pixels, std::size_t pixel, Colour colour) {
  pixels[4 * pixel] = static_cast<char>(colour.red);
  pixels[4 * pixel + 1] = static_cast<char>(colour.green);
  pixels[4 * pixel + 2] = static_cast<char>(colour.blue);
}

void paint_opaque(std::string& pixels, std::size_t pixel, Colour colour) {
  paint(pixels, pixel, colour);
  pixels[4 * pixel + 3] = '\xff';
}

// Pixels of `most` whose centres lie beyond or before a place [px], which may be far beyond what an int holds.
int first_from(double at, int most) { return static_cast<int>(std::ceil(std::clamp(at - 0.5, 0.0, 1.0 * most))); }
int last_to(double at, int most) { return static_cast<int>(std::floor(std::clamp(at - 0.5, -1.0, most - 1.0))); }

}  // namespace

Mask inside_of(const std::vector<std::array<double, 4>>& ends, const Window& window, PixelSize size) {
  const auto width = static_cast<std::size_t>(size.width), height = static_cast<std::size_t>(size.height);
  const double scale = size.width / window.width();  // [px/m]
  Mask mask(width * height, false);
  std::vector<double> crossings;
  for (std::size_t j = 0; j < height; ++j) {
    const double y = window.lower[1] + (static_cast<double>(j) + 0.5) / scale;
    crossings.clear();
    for (const auto& [x0, y0, x1, y1] : ends)
      if ((y0 <= y) != (y1 <= y))
        crossings.push_back((x0 + (y - y0) / (y1 - y0) * (x1 - x0) - window.lower[0]) * scale);
    std::ranges::sort(crossings);
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      const double from = std::max(0.0, std::ceil(crossings[k] - 0.5)),
                   to = std::min(crossings[k + 1] - 0.5, size.width - 1.0);
      for (double i = from; i <= to; ++i) mask[j * width + static_cast<std::size_t>(i)] = true;
    }
  }
  return mask;
}

void fill(std::string& pixels, const Mask& mask, Colour colour) {
  for (std::size_t pixel = 0; pixel < mask.size(); ++pixel)
    if (mask[pixel]) paint_opaque(pixels, pixel, colour);
}

std::string draw_discs(const std::vector<Disc>& discs, const Window& window, PixelSize size) {
  const auto width = static_cast<std::size_t>(size.width), height = static_cast<std::size_t>(size.height);
  const double scale = size.width / window.width();  // [px/m]
  std::string pixels(4 * width * height, '\0');
  std::vector<Nearest> nearest(width * height);
  for (const Disc& disc : discs) {
    const double x = (disc.centre[0] - window.lower[0]) * scale, y = (disc.centre[1] - window.lower[1]) * scale;
    const double radius = std::max(disc.radius * scale, 0.75),
                 far = reach * radius;  // at least the pixel that it is in
    const bool centre_seen = x >= 0 && y >= 0 && x < size.width && y < size.height;
    const auto pixel_at = [&](double px, double py) {
      return static_cast<std::size_t>(py) * width + static_cast<std::size_t>(px);
    };
    // What has got out is seen as it is.
    const bool bounded = disc.within && (!centre_seen || (*disc.within)[pixel_at(x, y)]);
    for (int j = first_from(y - far, size.height); j <= last_to(y + far, size.height); ++j)
      for (int i = first_from(x - far, size.width); i <= last_to(x + far, size.width); ++i) {
        const auto distance = static_cast<float>(std::hypot(i + 0.5 - x, j + 0.5 - y));
        const std::size_t pixel = static_cast<std::size_t>(j) * width + static_cast<std::size_t>(i);
        if (bounded && !(*disc.within)[pixel]) continue;
        if (static_cast<double>(distance) > far || distance >= nearest[pixel].distance) continue;
        nearest[pixel] = {distance, static_cast<float>(radius)};
        paint(pixels, pixel, disc.colour);
      }
  }
  constexpr float chamfer = 1.09F;  // for what the distance is too large
  const std::vector<float> from_void = distance_from_void(nearest, size);
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    const float radius = nearest[i].radius;
    const bool covered = radius > 0 && nearest[i].distance <= radius;
    const bool in_gap = radius > 0 && from_void[i] > chamfer * (static_cast<float>(reach) - 1) * radius;
    if (covered || in_gap) pixels[4 * i + 3] = '\xff';
  }
  return pixels;
}

std::string draw_facets(const std::vector<Facet>& facets, const Window& window, PixelSize size) {
  const auto width = static_cast<std::size_t>(size.width), height = static_cast<std::size_t>(size.height);
  const double scale = size.width / window.width();  // [px/m]
  std::string pixels(4 * width * height, '\0');
  constexpr double rounding = 1e-9;  // no gap between neighbours
  std::vector<double> foremost(width * height, -std::numeric_limits<double>::infinity());
  for (const Facet& facet : facets) {
    std::array<double, 3> x, y;  // [px]
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = (facet.corners[k][0] - window.lower[0]) * scale;
      y[k] = (facet.corners[k][1] - window.lower[1]) * scale;
    }
    const auto twice_area = [&](std::size_t a, std::size_t b, double px, double py) {
      return (x[b] - x[a]) * (py - y[a]) - (px - x[a]) * (y[b] - y[a]);
    };
    const double whole = twice_area(0, 1, x[2], y[2]);
    if (whole == 0) continue;  // seen edge on
    const auto [left, right] = std::ranges::minmax(x);
    const auto [low, high] = std::ranges::minmax(y);
    for (int j = first_from(low, size.height); j <= last_to(high, size.height); ++j)
      for (int i = first_from(left, size.width); i <= last_to(right, size.width); ++i) {
        std::array<double, 3> share;  // of the corners
        for (std::size_t k = 0; k < 3; ++k) share[k] = twice_area((k + 1) % 3, (k + 2) % 3, i + 0.5, j + 0.5) / whole;
        if (std::ranges::min(share) < -rounding) continue;
        double z = 0;
        for (std::size_t k = 0; k < 3; ++k) z += share[k] * facet.corners[k][2];
        const std::size_t pixel = static_cast<std::size_t>(j) * width + static_cast<std::size_t>(i);
        if (z <= foremost[pixel]) continue;
        foremost[pixel] = z;
        paint_opaque(pixels, pixel, facet.colour);
      }
  }
  return pixels;
}

}  // namespace geodrop
