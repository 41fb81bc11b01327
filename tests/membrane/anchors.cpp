// Anchors step by step, in the plane and in space: the node, the law of the line, the momentum.
#include <doctest/doctest.h>
#include <geodrop/measure/measure.hpp>
#include <geodrop/step/pipeline.hpp>

#include <cmath>

#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

template <int Dim>
struct Stepped {
  Scene scene;
  State<Dim> state;
  Grids<Dim> grids;
  Pipeline<Dim> pipeline;
  explicit Stepped(const std::string& path, const std::vector<std::string>& settings)
      : scene(read_scene(source_path(path), settings)),
        state(build_state<Dim>(scene)),
        grids(make_grids<Dim>(scene)),
        pipeline(build_pipeline<Dim>(scene)) {}

  /// Momentum that the anchors and gravity owe the last step, over that of all weight in it [-].
  double step() {
    const Totals<Dim> before = measure(state, scene.gravity);
    const double t = state.t;
    advance(pipeline, state, grids);
    const double dt = state.t - t;
    Vec<Dim> given = before.mass * Vec<Dim>(scene.gravity.data());
    for (const Anchor<Dim>& anchor : state.anchors) given += Vec<Dim>(anchor.force.data());
    const Vec<Dim> gained = (measure(state, scene.gravity).momentum - before.momentum) / dt;
    return (gained - given).norm() / (before.mass * 9.81);
  }
  Vec<Dim> node(std::size_t anchor) const { return vector_at(state.membranes[0].x, state.anchors[anchor].node); }
};

/// The largest force of the first anchor along z in steps that keep the momentum [N].
double largest_push(Stepped<3>& run, int steps) {
  double largest = 0;
  for (int k = 0; k < steps; ++k) {
    CHECK(run.step() < 1e-9);
    largest = std::max(largest, std::abs(run.state.anchors[0].force[2]));
  }
  return largest;
}

}  // namespace

TEST_CASE("Each step a held node is where it was drawn, a rope obeys its law, and momentum is what both gave") {
  for (const std::string transfer : {"tpic", "blend", "musl"}) {
    CAPTURE(transfer);
    std::vector<std::string> settings{"rigid=[]", "contacts=[]", "solver.transfer=" + transfer,
                                      "anchors.rope.to=[0.0,1.5]", "anchors.rope.length=1.0"};
    if (transfer == "tpic") settings.emplace_back("solver.blend_rate=");
    Stepped<2> run("tests/scenes/hanging.toml", settings);
    const Vec<2> drawn = run.node(0);
    int taut = 0;
    for (int k = 0; k < 200; ++k) {
      const double missing = run.step();
      CHECK(missing < 1e-9);
      CHECK((run.node(0) - drawn).norm() < 1e-12);
      const Anchor<2>& rope = run.state.anchors[1];
      const Vec<2> way = Vec<2>(rope.to.data()) - run.node(1), force(rope.force.data());
      if (force.norm() < 1000) continue;  // slack, or just taut, where its direction turns within the step
      ++taut;
      CHECK(force.norm() * rope.compliance == near(way.norm() - rope.length, 1e-4));
      CHECK(force.dot(way) == near(force.norm() * way.norm(), 1e-6));
    }
    CHECK(taut > 50);
  }
}

TEST_CASE(
    "On a sharp membrane, dry or in water, a node is held, a rope obeys its law, and momentum is what both gave") {
  for (const std::string fluid : {"lower=[1.0,-0.5],upper=[1.5,0.5]", "lower=[-1.25,-0.5],upper=[0.75,1.0]"}) {
    CAPTURE(fluid);  // it falls freely: beside the block, around it
    Stepped<2> run("tests/scenes/hanging.toml",
                   {"rigid=[]", "contacts=[]", "membranes.net.interface=sharp", "membranes.net.shear=none",
                    "materials={rubber={model='linear_elastic',density=1600.0,youngs_modulus=5e6,poissons_ratio=0.3},"
                    "water={model='newtonian',density=1000.0,sound_speed=60.0,viscosity=1.0}}",
                    "bodies=[{name='load',material='rubber',shape={type='box',lower=[-0.75,0.0],upper=[0.25,0.5]},"
                    "initial_stress={type='zero'}},{name='water',material='water',minus=['load'],shape={type='box'," +
                        fluid + "},initial_stress={type='zero'}}]",
                    "anchors=[{name='nail',membrane='net',at=[-0.75,0.5],type='held'},{name='rope',membrane='net',"
                    "at=[0.25,0.5],type='line',to=[0.25,1.5],length=1.0,stiffness=1e5}]"});
    const Vec<2> drawn = run.node(0);
    double astray = 0;
    for (int k = 0; k < 200; ++k) {
      CHECK(run.step() < 1e-9);
      astray = std::max(astray, (run.node(0) - drawn).norm());
    }
    CHECK(astray < 5e-5);  // by the difference between its velocity and the one that impulses see, times dt; found 2e-5
    const Anchor<2>& rope = run.state.anchors[1];
    const Vec<2> way = Vec<2>(rope.to.data()) - run.node(1), force(rope.force.data());
    CHECK(force.norm() > 100);
    CHECK(force.norm() * rope.compliance == near(way.norm() - rope.length, 1e-3));
    CHECK(rope.stretch == near(force.norm() * rope.compliance, 1e-6));
    CHECK(force.dot(way) == near(force.norm() * way.norm(), 1e-6));
  }
}

TEST_CASE("A rope on a sharp membrane that is too long bears nothing and says how long it is") {
  Stepped<2> run("tests/scenes/hanging.toml",
                 {"rigid=[]", "contacts=[]", "membranes.net.interface=sharp", "membranes.net.shear=none",
                  "bodies.load.pressure=cell", "bodies.stone.pressure=cell",
                  "anchors=[{name='rope',membrane='net',at=[-1.0,0.5],type='line',to=[-1.0,1.5],length=3.0,"
                  "stiffness=1e5}]"});
  for (int k = 0; k < 50; ++k) CHECK(run.step() < 1e-9);
  const Anchor<2>& rope = run.state.anchors[0];
  CHECK(Vec<2>(rope.force.data()).norm() == 0);
  CHECK(rope.stretch + 3 == near((Vec<2>(rope.to.data()) - run.node(0)).norm(), 1e-5));
}

TEST_CASE("Anchors that share nodes of the grid hold both") {
  Stepped<2> run("tests/scenes/hanging.toml", {"rigid=[]", "contacts=[]",
                                               "anchors=[{name='one',membrane='net',at=[-1.5,0.5],type='held'},"
                                               "{name='two',membrane='net',at=[-1.4375,0.5],type='held'}]"});
  const Vec<2> one = run.node(0), two = run.node(1);
  CHECK((one - two).norm() == near(0.0625, 1e-9));
  for (int k = 0; k < 50; ++k) CHECK(run.step() < 1e-9);
  CHECK((run.node(0) - one).norm() < 1e-9);
  CHECK((run.node(1) - two).norm() < 1e-9);
}

TEST_CASE("In space, too, a held node stays and the nail takes its momentum") {
  Stepped<3> run("tests/scenes/bag_3d.toml",
                 {"grid.lower=[-2.0,-1.0,-1.0]", "grid.upper=[2.0,1.0,2.0]", "contacts=[]", "still_fluids=[]",
                  "anchors=[{name='nail',membrane='bag',at=[0.0,0.015,1.03],type='held'}]"});
  const Vec<3> drawn = run.node(0);
  CHECK(largest_push(run, 60) > 10);
  CHECK((run.node(0) - drawn).norm() < 1e-12);
}

TEST_CASE("In space, too, a sharp membrane's node is held, and the nail takes its momentum") {
  Stepped<3> run("cases/verification/sphere_release_3d.toml",
                 {"grid.lower=[-3.0,-3.0,-3.0]", "grid.upper=[3.0,3.0,3.0]", "grid.spacing=0.5",
                  "bodies.water.shape={type='box',lower=[-1.5,-1.5,-1.5],upper=[1.5,1.5,1.5]}",
                  "bodies.water.initial_stress={type='zero'}", "bodies.ball.initial_stress={type='zero'}",
                  "anchors=[{name='nail',membrane='skin',at=[0.0,0.0,1.0],type='held'}]"});
  const Vec<3> drawn = run.node(0);
  CHECK(largest_push(run, 30) > 10);
  CHECK((run.node(0) - drawn).norm() < 3e-6);
}
