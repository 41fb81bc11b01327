// Rows of the step for contact with rigid bodies and between membranes, in the plane, and of membranes on rigid
// bodies in space.
#pragma once

#include <geodrop/grid/row.hpp>

namespace geodrop {

Row<2> membrane_contact_row(const Scene& scene);
Row<3> space_contact_row(const Scene& scene);
Row<2> particle_contact_row(const Scene& scene);
Row<2> held_shift_row(const Scene& scene);
Row<2> hold_shift_row(const Scene& scene);
template <int Dim>
Row<Dim> move_rigid_bodies_row(const Scene& scene);

}  // namespace geodrop
