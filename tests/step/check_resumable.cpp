// Each part of a state that a step relies on, broken in turn: the fault is named by its owner.
#include "step/check_resumable.hpp"
#include "support/scene_files.hpp"

#include <geodrop/reader/scene_reader.hpp>
#include <geodrop/step/pipeline.hpp>

#include <doctest/doctest.h>

#include <functional>
#include <limits>

using namespace geodrop;

namespace {

struct Ran {
  Scene scene;
  State<2> built, state;
};

Ran run(const std::string& file, const std::vector<std::string>& settings, int steps) {
  Ran ran{read_scene(source_path(file), settings), {}, {}};
  ran.built = ran.state = build_state<2>(ran.scene);
  Grids<2> grids = make_grids<2>(ran.scene);
  Pipeline<2> pipeline = build_pipeline<2>(ran.scene);
  for (int i = 0; i < steps; ++i) advance(pipeline, ran.state, grids);
  return ran;
}

struct Break {
  std::string says;
  std::function<void(State<2>&)> change;
};

void check_breaks(const Ran& ran, const std::vector<Break>& breaks) {
  CHECK(fault_in_state(ran.scene, ran.built, ran.state) == "");
  for (const Break& one : breaks) {
    State<2> state = ran.state;
    one.change(state);
    CHECK(fault_in_state(ran.scene, ran.built, state) == one.says);
  }
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double endless = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("Bodies, membranes and tracers") {
  using S = State<2>;
  const Ran ran = run("cases/dump_kekerdom.toml",
                      {"grid.spacing=1.0", "grid.refine=[]", "probes=[{name='cork',type='tracer',position=[3.0,5.0]}]",
                       "results=[]", "expect=[]", "verify=[]", "variants=[]"},
                      3);
  const std::string water = "body 'water': ", skin = "membrane 'geotextile': ";
  check_breaks(
      ran,
      {{"clock: a time that is not >= 0 and finite", [](S& s) { s.t = none; }},
       {"clock: a value that is not finite", [](S& s) { s.drift = none; }},
       {"clock: a largest speed that is not >= 0 and finite", [](S& s) { s.v_max = endless; }},
       {"bodies: another number than in the scene", [](S& s) { s.bodies.pop_back(); }},
       {water + "another name or material", [](S& s) { s.bodies[0].name = "wine"; }},
       {water + "another name or material",
        [](S& s) {
          s.bodies[0].material = LinearElastic{1000, 1e6, 1e6};
        }},
       {water + "another velocity field", [](S& s) { s.bodies[0].field = 7; }},
       {water + "other settings", [](S& s) { s.bodies[0].enclosed = 3; }},
       {water + "other settings", [](S& s) { s.bodies[0].half_size = 1e9; }},
       {water + "other settings", [](S& s) { s.bodies[0].pressure = static_cast<PressureSupport>(17); }},
       {water + "another number of particles or of their quantities", [](S& s) { s.bodies[0].v[1].pop_back(); }},
       {water + "another number of particles or of their quantities", [](S& s) { s.bodies[0].layer.clear(); }},
       {water + "numbers of particles that are not each there once", [](S& s) { s.bodies[0].id[3] = 4000000000; }},
       {water + "numbers of particles that are not each there once",
        [](S& s) { s.bodies[0].id[3] = s.bodies[0].id[4]; }},
       {water + "a value of a particle that is not finite", [](S& s) { s.bodies[0].x[0][5] = none; }},
       {water + "a value of a particle that is not finite", [](S& s) { s.bodies[0].affine[2][5] = endless; }},
       {water + "a particle outside of the domain", [](S& s) { s.bodies[0].x[1][5] = 1e6; }},
       {water + "a particle without mass or volume", [](S& s) { s.bodies[0].J[5] = 0; }},
       {water + "a particle without mass or volume", [](S& s) { s.bodies[0].mass[5] = -1; }},
       {water + "particles that are not sorted", [](S& s) { s.bodies[0].slab_begin[1] = 4000000000; }},
       {water + "particles that are not sorted", [](S& s) { s.bodies[0].slab_begin.pop_back(); }},
       {water + "particles that are not sorted",
        [](S& s) { std::swap(s.bodies[0].x[1].front(), s.bodies[0].x[1].back()); }},
       {skin + "another name, body or bed", [](S& s) { s.membranes[0].body = "water"; }},
       {skin + "another velocity field", [](S& s) { s.membranes[0].field = -5; }},
       {skin + "other settings", [](S& s) { s.membranes[0].contents_friction = 99; }},
       {skin + "another number of nodes or of their quantities", [](S& s) { s.membranes[0].rest_length.pop_back(); }},
       {skin + "another number of nodes or of their quantities", [](S& s) { s.membranes[0].gauge.sums.pop_back(); }},
       {skin + "a value of a node that is not finite", [](S& s) { s.membranes[0].tension[0] = none; }},
       {skin + "a node outside of the domain", [](S& s) { s.membranes[0].x[0][0] = -1e6; }},
       {"tracer 'cork': another name, body or velocity field", [](S& s) { s.tracers[0].field = 9; }},
       {"tracer 'cork': a place outside of the domain", [](S& s) { s.tracers[0].x[0] = 1e9; }},
       {"stages: a stage that the scene has not", [](S& s) { s.stages_entered = 3; }}});
  State<2> unsorted = ran.state;  // it is sorted before its first step
  unsorted.drift = -1;
  unsorted.bodies[0].slab_begin.clear();
  CHECK(fault_in_state(ran.scene, ran.built, unsorted) == "");
}

TEST_CASE("Rigid bodies, contacts and stages") {
  using S = State<2>;
  const Ran ran = run("tests/scenes/tube.toml", {"grid.spacing=0.2"}, 12);
  REQUIRE_FALSE(ran.state.rigid_contacts.empty());
  const std::string contact =
      "contact of '" + ran.state.rigid_contacts[0].touching + "' with '" + ran.state.rigid_contacts[0].rigid + "': ";
  check_breaks(ran, {{"rigid bodies: another number than in the scene", [](S& s) { s.rigid.clear(); }},
                     {"rigid body '" + ran.state.rigid[0].name + "': a value that is not finite",
                      [](S& s) { s.rigid[0].displacement[0] = none; }},
                     {contact + "another pair or other settings", [](S& s) { s.rigid_contacts[0].touching = "air"; }},
                     {contact + "another number of points than of what is known of them",
                      [](S& s) { s.rigid_contacts[0].slip.push_back(0); }},
                     {contact + "points that are out of order or not there",
                      [](S& s) {
                        s.rigid_contacts[0].points = {4000000000};
                        s.rigid_contacts[0].slip = {0};
                        s.rigid_contacts[0].side = {0};
                      }},
                     {contact + "a point on no side", [](S& s) {
                        s.rigid_contacts[0].points = {0};
                        s.rigid_contacts[0].slip = {0};
                        s.rigid_contacts[0].side = {99};
                      }}});
}

TEST_CASE("Silent sides and viscous boundaries") {
  using S = State<2>;
  check_breaks(run("tests/scenes/round_pulse.toml", {"grid.spacing=0.5"}, 2),
               {{"silent side 'left': another number of rows", [](S& s) { s.silent_sides[0].flow = {1}; }}});
  check_breaks(run("tests/scenes/viscous_bed.toml", {}, 2),
               {{"viscous boundary 'base': another name, field, number of points or other settings",
                 [](S& s) { s.viscous_boundaries[0].half_size = 50; }},
                {"viscous boundary 'base': a point that is not in the domain",
                 [](S& s) { s.viscous_boundaries[0].x[0][0] = 1e5; }}});
}
