#include "small_state.hpp"

#include "measure/probes/probes.hpp"

namespace geodrop {

Scene small_scene() {
  Scene scene;
  scene.file = "cases/small.toml";
  scene.title = "Four and four particles";
  scene.walls.lower.assign(2, WallKind::slip);
  scene.walls.upper.assign(2, WallKind::slip);
  scene.grid.lower = {0, 0};
  scene.grid.upper = {8, 8};
  scene.grid.spacing = 1.0;
  scene.gravity = {0.0, -10.0};
  scene.time.end = 1.0;
  scene.output.frame_interval = 0.5;
  scene.output.history_interval = 0.25;
  scene.materials = {{"water", NewtonianSpec{1000, 2e6, 0}, {}},
                     {"sand", MohrCoulombSpec{1600, 3e6, 0.25, 0, 30, 0, 0, UndrainedSpec{0.5, 1e7}}, {}}};
  BodySpec pool, bag;
  pool.name = "pool";
  pool.material = "water";
  bag.name = "bag";
  bag.material = "sand";
  scene.bodies = {pool, bag};
  MembraneSpec skin;
  skin.name = "skin";
  skin.body = "bag";
  scene.membranes = {skin};
  scene.probes = {{TracerSpec{"cork", {0.5, 0.5}}, {}},
                  {HydrostaticProbeSpec{"still", "pool", HydrostaticSpec{"water", 4.0}}, {}}};
  scene.as_run = "title = \"Four and four particles\"\n";
  return scene;
}

Body<2> body_at(const MaterialSpec& material, const std::vector<std::array<double, 2>>& places, double mass) {
  Body<2> body;
  body.material_name = material.name;
  body.material = make_material(material);
  for (std::size_t p = 0; p < places.size(); ++p) {
    for (int a = 0; a < 2; ++a) {
      body.x[a].push_back(places[p][a]);
      body.initial_x[a].push_back(places[p][a]);
      body.v[a].push_back(0);
    }
    for (auto& component : body.affine) component.push_back(0);
    body.mass.push_back(mass);
    body.J.push_back(1);
    body.id.push_back(static_cast<std::uint32_t>(p));
    body.layer.push_back(static_cast<std::uint8_t>(p / 2));
  }
  return body;
}

Membrane<2> square_membrane() {
  Membrane<2> skin;
  skin.name = "skin";
  skin.body = "bag";
  skin.axial_stiffness = 1000;
  skin.strength = 500;
  skin.x = {Array<double>{3, 5, 5, 3}, Array<double>{3, 3, 5, 5}};
  skin.v = {Array<double>(4, 0.0), Array<double>(4, 0.0)};
  skin.mass.assign(4, 0.5);
  skin.rest_length = {2, 2, 2, 4};
  skin.strain = {0.1, 0.2, 0.3, -0.5};
  skin.tension = {100, 200, 300, 0};
  return skin;
}

State<2> small_state() {
  const Scene scene = small_scene();
  State<2> state;
  state.bodies = {body_at(scene.materials[0], {{0.5, 0.5}, {1.5, 0.5}, {2.5, 0.5}, {3.5, 0.5}}, 1000),
                  body_at(scene.materials[1], {{3.5, 3.5}, {4.5, 3.5}, {3.5, 4.5}, {4.5, 4.5}}, 1600)};
  state.bodies[0].name = "pool";
  state.bodies[1].name = "bag";
  for (auto& component : state.bodies[1].stress) component.assign(4, 0.0);
  state.bodies[1].pore_pressure.assign(4, 0.0);
  state.bodies[1].deviatoric_strain.assign(4, 0.0);
  state.membranes = {square_membrane()};
  state.tracers = {{"cork", {0.75, 0.25}, {0.1, -0.2}, {0.5, 0.5}}};
  return state;
}

}  // namespace geodrop
