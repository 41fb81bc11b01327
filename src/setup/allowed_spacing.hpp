// Which spacings a grid may have: whole cells along each axis, not too many of them, enough between periodic walls.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <cstddef>

namespace geodrop {

constexpr double most_cells = 2e8;

/// Between the walls [m].
double length_along(const GridSpec& grid, std::size_t axis);
/// Whether an axis has finer cells somewhere.
bool has_zone(const GridSpec& grid, std::size_t axis);
bool is_periodic(const Scene& scene, std::size_t axis);

/// The spacing divides the axis, or zones of finer cells have their own way to do so.
bool divides(double spacing, const GridSpec& grid, std::size_t axis);

/// Of a graded axis the cells that the closed form gives, also where they are too many to be built.
double cell_count(const GridSpec& grid);

/// The allowed spacing nearest to that of the scene, from a third of it to three times it; 0: none was found [m].
double nearest_allowed_spacing(const Scene& scene);

/// The largest allowed spacing that is not above `most`, and not below a third of it; 0: none was found [m].
double largest_allowed_spacing(const Scene& scene, double most);

}  // namespace geodrop
