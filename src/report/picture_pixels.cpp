#include "picture_pixels.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "scene/needs.hpp"

namespace geodrop {
namespace {

using Ends = std::array<double, 4>;  ///< x and y of both

/// Of a line of a snapshot.
Ends ends_of(const std::vector<double>& points, const std::vector<std::uint32_t>& connectivity, std::size_t line) {
  const double *from = &points[3 * connectivity[2 * line]], *to = &points[3 * connectivity[2 * line + 1]];
  return {from[0], from[1], to[0], to[1]};
}

/// Where each body is seen: inside the closed membrane around it; a body without one outside of all. Empty if there
/// are no closed membranes.
std::vector<Mask> masks_of(const Scene& scene, const MembraneSnapshot& membranes, const Panel& panel) {
  std::vector<Mask> masks(scene.bodies.size());
  for (std::size_t m = 0; m < scene.membranes.size(); ++m) {
    const auto body = std::ranges::find(scene.bodies, body_inside(scene, scene.membranes[m]), &BodySpec::name);
    std::vector<Ends> ends;
    for (std::size_t s = 0; s < membranes.membrane.size(); ++s)
      if (membranes.membrane[s] == m) ends.push_back(ends_of(membranes.points, membranes.connectivity, s));
    if (scene.membranes[m].closed && !ends.empty() && body != scene.bodies.end())
      masks[static_cast<std::size_t>(body - scene.bodies.begin())] = inside_of(ends, panel.window, panel.pixels);
  }
  Mask open;
  for (const Mask& mask : masks) {
    if (open.empty()) open.assign(mask.size(), true);
    for (std::size_t pixel = 0; pixel < mask.size(); ++pixel) open[pixel] = open[pixel] && !mask[pixel];
  }
  for (Mask& mask : masks)
    if (mask.empty()) mask = open;
  return masks;
}

std::vector<Disc> discs_of(const Scene& scene, const ParticleSnapshot& particles, const std::vector<Colour>& colours,
                           const std::vector<Mask>& masks) {
  constexpr double reach = 0.72;  // of the spacing of particles; 0.707 fill a square lattice
  std::vector<double> radius;
  for (const BodySpec& body : scene.bodies) radius.push_back(reach * scene.grid.spacing / body.particles_per_cell_axis);
  std::vector<Disc> discs;
  std::vector<bool> hidden;
  for (const BodySpec& body : scene.bodies) hidden.push_back(lies_in_pores(scene, body));
  for (std::size_t p = 0; p < colours.size(); ++p) {
    if (hidden.at(particles.body[p])) continue;
    const Mask& mask = masks.at(particles.body[p]);
    discs.push_back({{particles.points[3 * p], particles.points[3 * p + 1]},
                     radius[particles.body[p]],
                     colours[p],
                     mask.empty() ? nullptr : &mask});
  }
  return discs;
}

/// The inside of the rigid bodies of the plane. What has no end has no inside in a picture.
void fill_rigid(const Scene& scene, const RigidSnapshot& rigid, const Panel& panel, std::string& pixels) {
  constexpr Colour grey{0xb8, 0xb8, 0xb8};
  if (scene.dimension == 3) return;
  for (const auto& [first, end] : lines_by_body(rigid)) {
    if (is_plane_without_end(scene, rigid.rigid[first])) continue;
    std::vector<Ends> ends;
    for (std::size_t line = first; line < end; ++line) ends.push_back(ends_of(rigid.points, rigid.connectivity, line));
    fill(pixels, inside_of(ends, panel.window, panel.pixels), grey);
  }
}

std::vector<Facet> facets_of(const MembraneSnapshot& triangles, const std::vector<Colour>& colours) {
  std::vector<Facet> facets(colours.size());
  for (std::size_t t = 0; t < facets.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k)
      std::copy_n(&triangles.points[3 * triangles.connectivity[3 * t + k]], 3, facets[t].corners[k].begin());
    facets[t].colour = colours[t];
  }
  return facets;
}

}  // namespace

std::string pixels_of(const Scene& scene, const PaintedView& painted, const Panel& panel) {
  const Snapshot& frame = painted.view.frame;
  if (frame.membranes.corners == 3)
    return draw_facets(facets_of(frame.membranes, painted.colours), panel.window, panel.pixels);
  const std::vector<Mask> masks = masks_of(scene, frame.membranes, panel);
  std::string pixels = draw_discs(discs_of(scene, frame.particles, painted.colours, masks), panel.window, panel.pixels);
  fill_rigid(scene, frame.rigid, panel, pixels);
  return pixels;
}

}  // namespace geodrop
