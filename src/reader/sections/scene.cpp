// The top level of a scene.
#include "sections.hpp"

#include "measure/probes/probes.hpp"

namespace geodrop {
namespace {

constexpr Range two_or_three{"2 or 3", [](double x) { return x == 2 || x == 3; }};

/// A velocity of type "rest" has no numbers.
void rest_in_all_directions(Scene& scene, const toml::table&) {
  for (BodySpec& body : scene.bodies)
    if (auto* velocity = std::get_if<UniformVelocitySpec>(&body.initial_velocity))
      velocity->value.resize(static_cast<std::size_t>(scene.dimension));
}

/// Of fluids with a still level.
void weigh_still_fluids(Scene& scene) {
  if (scene.gravity.empty()) return;  // missing, which is said elsewhere
  for (MaterialSpec& material : scene.materials)
    if (auto* fluid = std::get_if<NewtonianSpec>(&material.model); fluid && fluid->still_level)
      fluid->unit_weight = -scene.gravity.back() * fluid->density;
}

void complete_values(Scene& scene, const toml::table& written) {
  rest_in_all_directions(scene, written);
  weigh_still_fluids(scene);
}

/// A membrane in space may be alone.
Key may_be_none(Key row) {
  row.need = standard("{}");
  return row;
}

}  // namespace

// clang-format off
SectionOf<Scene> top_level() {
  constexpr RowsOf<Scene> key;
  return {
      "Top level", "",
      "What the scene is about, and its tables.",
      R"(title = "A geocontainer dropped in 6 m of water"
question = "How fast does it fall, and what does its geotextile bear?"
dimension = 2
gravity = [0.0, -9.81])", {
      key("title", &Scene::title, required, filled, "what the scene shows, in a few words"),
      key("question", &Scene::question, standard("\"\""), free_text, "what this case asks"),
      key("start_from", &Scene::start_from, standard("\"\""), free_text, "the directory of another run, from where geodrop is started: bodies and membranes of the same name begin as its newest checkpoint has them, whatever their shape, velocity and stress say here; everything else, time too, begins anew. \"\": none"),
      key("dimension", &Scene::dimension, "", standard("2"), two_or_three, "2: plane strain in x and y, per metre of depth; 3: space. The last axis is the vertical one"),
      key("gravity", &Scene::gravity, "m/s2", required, any, "acceleration of gravity"),
      key.table("grid", &Scene::grid, grid_section(), required, "the domain and its cells"),
      key.table("walls", &Scene::walls, walls_section(), required, "the sides of the domain"),
      key.table("solver", &Scene::solver, solver_section(), required, "the scheme"),
      key.table("relaxation", &Scene::relaxation, relaxation_section(), standard("{ damping = \"none\" }"), "how the run comes to rest"),
      key.table("time", &Scene::time, time_section(), required, "how long to run"),
      key.table("output", output_section(), required, "what is written"),
      may_be_none(key.named("materials", &Scene::materials, materials_section(), "the materials by name; in the plane at least one")),
      key.list("bodies", &Scene::bodies, bodies_section(), standard("[]"), "what fills the domain; in the plane at least one"),
      key.list("membranes", &Scene::membranes, membranes_section(), standard("[]"), "geotextiles"),
      key.list("rigid", &Scene::rigid, rigid_section(), standard("[]"), "rigid ground and walls"),
      key.list("contacts", &Scene::contacts, contacts_section(), standard("[]"), "what touches what"),
      key.list("still_fluids", &Scene::still_fluids, still_fluids_section(), standard("[]"), "still water around or in membranes"),
      key.list("anchors", &Scene::anchors, anchors_section(), standard("[]"), "points at which membranes hang"),
      key.list("stages", &Scene::stages, stages_section(), standard("[]"), "the parts of a run in time"),
      key.list("viscous_boundaries", &Scene::viscous_boundaries, viscous_boundaries_section(), standard("[]"), "edges of the ground that let waves out").in(2),
      key.list("absorbing_layers", &Scene::silent_sides, absorbing_layers_section(), standard("[]"), "layers beside walls through which waves in water leave").in(2).formerly("silent_sides"),
      key.list("pumps", &Scene::pumps, pumps_section(), standard("[]"), "fluid that is pumped in"),
      key.list("exact", &Scene::exact, exact_section(), standard("[]"), "exact solutions that bodies follow"),
      key.list("probes", &Scene::probes, probes_section(), standard("[]"), "additional measurements"),
      key.list("results", &Scene::results, results_section(), standard("[]"), "numbers that the run ends with"),
      key.list("expect", &Scene::expect, expect_section(), standard("[]"), "what the results should be"),
      key.list("verify", &Scene::verify, verify_section(), standard("[]"), "targets of `geodrop verify`"),
      key.list("variants", &Scene::variants, variants_section(), standard("[]"), "runs of `geodrop verify`"),
  }, complete_values};
}
// clang-format on

}  // namespace geodrop
