// Particles of a body: a lattice aligned with the grid, cut to the body's shape.
#pragma once

#include <geodrop/scene.hpp>
#include <geodrop/state.hpp>

namespace geodrop {

/// Fills positions, volumes (as `J` = volume [m3] until the initial stress is known), ids, layers of `body`.
/// A lattice site that the outline cuts gets one particle with the share of the site that lies inside, at that share's
/// centroid, so that area and centre of mass are those of the shape (error of the sub-sampling: see
/// fill_particles.cpp).
template <int Dim>
void fill_particles(const Scene& scene, const BodySpec& spec, Body<Dim>& body);

}  // namespace geodrop
