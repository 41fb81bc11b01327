// What a scene needs, asked once for all who allocate, run or judge it.
#pragma once

#include <geodrop/scene/scene.hpp>

namespace geodrop {

bool any_body_shifts(const Scene& scene);

/// Whether a body shifts with a `shift_speed`: its volume follows the room that it has.
bool makes_room(const BodySpec& body);
bool any_body_with(const Scene& scene, PressureSupport pressure);
bool any_contact_of(const Scene& scene, ContactPair::Kind kind);

/// A fluid whose cells have a pressure touches a rigid body, in the plane, on quadratic B-splines: it ends at the
/// surface.
bool any_fluid_at_rigid(const Scene& scene);

/// A membrane touches a rigid body or a membrane.
bool any_membrane_contact(const Scene& scene);
/// A drag law acts on a membrane, without the fluid around.
bool any_model_drag(const Scene& scene);
/// Something loads membrane nodes directly, not through the grid.
bool any_membrane_load(const Scene& scene);

/// Pressures act on membranes in space: their own gauge pressure, or that of fluids at rest.
bool any_surface_pressure(const Scene& scene);
bool presses_out(const MembraneSpec& membrane);

/// A coupled soil, whose pore water is a body of its own.
bool any_pores(const Scene& scene);
/// Whether its drag on pore water has Forchheimer's term.
bool has_inertial_drag(const Scene& scene, const BodySpec& soil);
/// Whether this body is the water in the pores of another.
bool saturates(const Scene& scene, const std::string& body);

/// The pores of a coupled soil; null if the body is none.
const CoupledSpec* pores_of(const Scene& scene, const BodySpec& body);

/// The law of a body: that of its material and, for the water in pores, with the gas of the soils around it.
Material law_of(const Scene& scene, const BodySpec& body);

/// The body inside a membrane; "" if a membrane in space is empty.
std::string body_inside(const Scene& scene, const MembraneSpec& membrane);

/// Whether a closed membrane lies around a body.
bool is_enclosed(const Scene& scene, const BodySpec& body);

/// Whether one that bears tension does: a skin only marks a surface, as that of a bed.
bool in_geotextile(const Scene& scene, const BodySpec& body);

/// Whether a body is inside a membrane with a sharp interface.
bool in_sharp_membrane(const Scene& scene, const std::string& body);

/// gamma_w of Darcy's law [N/m3] of the water in pores, with the gravity of the scene; 9.81 m/s2 where it has none.
double water_unit_weight(const Scene& scene, const BodySpec& water);

/// The still fluid that a body starts from; null if its stress tells of none.
const HydrostaticSpec* still_fluid_of(const InitialStress& stress);

/// mu between a membrane and its body, given or as the material of the body says; infinite: glued [-].
double contents_friction(const Scene& scene, const MembraneSpec& membrane);
/// It has a tension, and is not glued to its body.
bool slides(const Scene& scene, const MembraneSpec& membrane);
bool any_membrane_slides(const Scene& scene);

/// There is a skin with a sharp interface.
bool any_sharp_skin(const Scene& scene);

/// A sharp membrane lies on a bed of coupled soil.
bool lies_on_grains(const Scene& scene, const MembraneSpec& membrane);

/// Friction of what is around acts on a sharp membrane.
bool rubs_sharply(const MembraneSpec& membrane);

bool any_tracer(const Scene& scene);
/// The fluid that a body is of; null if it is of none.
const NewtonianSpec* fluid_of(const Scene& scene, const BodySpec& body);
bool any_fluid(const Scene& scene);

/// A body is of a fluid with eddies that the grid does not resolve.
bool any_mixing_length(const Scene& scene);

}  // namespace geodrop
