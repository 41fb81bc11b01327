// The pressure of a fluid that fills a closed membrane of triangles: enclosed_fluid.hpp word by word, with the cells
// that clipped_cells finds. All bodies of the field are such fluids.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Cut cells, their hosts and pressures, from membranes and particles.
void update_enclosed_cells(const State<3>& state, Grid<3>& grid);

/// Adds the loads of enclosed fluids to their membranes.
void add_fluid_loads(State<3>& state, const Grid<3>& grid);

/// Adds the forces of pressure jumps to the grid, and takes gravity `g` [m/s2] from the enclosed fluids.
void enclosed_force_to_grid(const State<3>& state, Grid<3>& grid, const Point& g, double dt);

/// Volume rates of enclosed cells from the nodal velocities; evens out J within cells.
void update_enclosed_rates(State<3>& state, Grid<3>& grid, double dt);

}  // namespace geodrop
