#include "rows.hpp"

#include "scene/needs.hpp"

#include <algorithm>

#include "membrane_contact.hpp"
#include "rigid_motion.hpp"
#include "shift_at_rigid.hpp"
#include "space_contact.hpp"
#include "surface_contact.hpp"

namespace geodrop {

Row<2> membrane_contact_row(const Scene& scene) {
  return {"membrane_contact",
          Data::membrane_position | Data::membrane_velocity | Data::membrane_cloth | Data::rigid_bodies,
          Data::membrane_load | Data::contacts, any_membrane_contact(scene),
          [](State<2>& s, const Grids<2>&, const StepContext& step) {
            add_contact_forces(s, step.dt);
            add_membrane_contacts(s, step.dt);
          }};
}

Row<3> space_contact_row(const Scene& scene) {
  return {"space_contact", Data::membranes | Data::membrane_position | Data::membrane_velocity | Data::rigid_bodies,
          Data::membrane_load | Data::contacts, any_membrane_contact(scene),
          [](State<3>& s, const Grids<3>&, const StepContext& step) {
            add_space_contacts(s, step.dt);
            add_membrane_contacts(s, step.dt);
          }};
}

Row<2> particle_contact_row(const Scene& scene) {
  return {"particle_contact", Data::position | Data::velocity | Data::rigid_bodies | Data::nodal_sums,
          Data::contacts | Data::nodal_sums | Data::nodal_force,
          any_contact_of(scene, ContactPair::Kind::body_on_rigid),
          each_field<2>([](State<2>& s, Grid<2>& g, const StepContext& step) { contact_to_grid(s, g, step.dt); })};
}

Row<2> held_shift_row(const Scene& scene) {
  return {
      "held_shift",
      Data::position | Data::rigid_bodies | Data::contacts | Data::velocity | Data::nodal_velocity | Data::cell_flags,
      Data::rigid_share, any_body_shifts(scene) && any_fluid_at_rigid(scene),
      each_field<2>([](const State<2>& s, Grid<2>& g, const StepContext& step) { find_held_shifts(s, g, step.dt); })};
}

Row<2> hold_shift_row(const Scene& scene) {
  return {"hold_shift", Data::rigid_share | Data::affine_rate, Data::position | Data::velocity,
          any_body_shifts(scene) && any_fluid_at_rigid(scene),
          each_field<2>([](State<2>& s, const Grid<2>& g, const StepContext&) { hold_shifts(s, g); })};
}

template <int Dim>
Row<Dim> move_rigid_bodies_row(const Scene& scene) {
  const bool moves = std::any_of(scene.rigid.begin(), scene.rigid.end(), [](const RigidSpec& rigid) {
    return !std::holds_alternative<std::monostate>(rigid.motion);
  });
  return {"move_rigid_bodies", Data::time, Data::rigid_bodies, moves,
          [rigid = scene.rigid](State<Dim>& s, const Grids<Dim>&, const StepContext& step) {
            move_rigid_bodies(rigid, step.dt, s);
          }};
}

template Row<2> move_rigid_bodies_row(const Scene&);
template Row<3> move_rigid_bodies_row(const Scene&);

}  // namespace geodrop
