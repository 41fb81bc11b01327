// Particles of a body: a lattice aligned with the grid, cut to the body's shape.
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Fills positions, volumes (as `J` = volume [m3] until the initial stress is known), ids, layers of `body`.
/// A lattice site that the outline cuts gets one particle with the share of the site that lies inside, at that share's
/// centroid, so that area (3D: volume) and centre of mass are those of the shape (accuracy: see BodyRegion::share). A
/// share below 2 % is added to the particle of a neighbouring site. Throws SceneError if no particle is left.
template <int Dim>
void fill_particles(const Scene& scene, const BodySpec& spec, Body<Dim>& body);

/// Whether fill_particles gives a body any particle.
bool has_particles(const Scene& scene, const BodySpec& spec);

}  // namespace geodrop
