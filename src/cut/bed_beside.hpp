// What lies beside a stretch of a sharp membrane on a bed.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include "interface_contacts.hpp"

namespace geodrop {

/// Where the bed is around a membrane: volume of its particles in each cell of the box, and that times pore pressure.
struct BedCells {
  Array<double> volume, pore;
  double grains = 0;  ///< share of a coupled bed that is grains [-]; 0: it is not coupled, or not near
};

/// That of the bed that a membrane names.
template <int Dim>
BedCells bed_around(const State<Dim>& state, const Grid<Dim>& around, const Membrane<Dim>& membrane,
                    const Outline<Dim>& cells);

/// Whether a stretch lies on the bed, and how far a coupled one is.
template <int Dim>
void look_for_bed(const Grid<Dim>& around, const Outline<Dim>& cells, const BedCells& bed, Contact<Dim>& contact);

}  // namespace geodrop
