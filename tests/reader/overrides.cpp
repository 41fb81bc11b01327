// --set KEY=VALUE.
#include "support/scene_files.hpp"

#include <doctest/doctest.h>

using namespace geodrop;

namespace {

const std::string every_key = source_path("tests/reader/every_key.toml");

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("values by key, by name and by index") {
  const Scene scene =
      read_scene(every_key, {"grid.spacing=0.25", "materials.water.viscosity = 0", "bodies.bag.shape.tilt_deg=5",
                             "bodies.0.jitter=0.2", "gravity.1=-1.62", "walls.left=no_slip", "title=two words",
                             "membranes.mat.points.1.0=2.5", "expect.1.tolerance=1", "materials.sand.density=1700"});
  CHECK(scene.grid.spacing == 0.25);
  CHECK(std::get<EllipseShape>(scene.bodies[2].shape).tilt_deg == 5);
  CHECK(scene.bodies[0].jitter == 0.2);
  CHECK(scene.gravity == Point{0, -1.62});
  CHECK(scene.walls.lower[0] == WallKind::no_slip);
  CHECK(scene.title == "two words");
  CHECK(scene.membranes[1].points[1] == Point{2.5, 8});
  CHECK(scene.expect[1].tolerance == 1);
  CHECK(has(scene.as_run, "spacing = 0.25"));
}

TEST_CASE("the last of several wins; an empty value removes; a table can be made") {
  CHECK(read_scene(every_key, {"time.end=3", "time.end=4"}).time.end == 4);
  CHECK(read_scene(every_key,
                   {"materials.sand.density=9007199254740993", "materials.sand.youngs_modulus=9007199254740993"})
            .materials.size() == 11);  // 2^53 + 1: no double, yet a number
  CHECK(read_scene(every_key, {"solver.transfer=tpic", "solver.blend_rate="}).solver.transfer == Transfer::tpic);
  const Scene moving =
      read_scene(every_key, {"bodies.bag.initial_velocity.type=uniform", "bodies.bag.initial_velocity.value=[0, -2]"});
  CHECK(moving.bodies[2].initial_velocity == InitialVelocity{UniformVelocitySpec{{0, -2}}});
  const Scene whole =
      read_scene(every_key, {"bodies.bag.shape={ type = 'ellipse', centre = [5, 4.5], semi_axes = [1, 1] }"});
  CHECK(std::get<EllipseShape>(whole.bodies[2].shape).semi_axes == Point{1, 1});
}

TEST_CASE("mistakes name the key, without a place in the file, and the nearest name") {
  struct Mistake {
    const char *override, *message;
  };
  for (const Mistake& mistake : {
           Mistake{"grid.spacng=1",
                   ": --set: grid.spacng: found an unknown key; allowed: one of \"lower\", \"upper\", \"spacing\", "
                   "\"basis\", \"refine\"; the nearest is \"spacing\""},
           Mistake{"gird.spacing=1", ": --set: gird: found an unknown key"},
           Mistake{"materials.wter.viscosity=1", ": --set: materials.wter.viscosity: found \"wter\""},
           Mistake{"bodies.bog.jitter=0", "the nearest is \"bag\"; or an index from 0 to 11"},
           Mistake{"bodies.12.jitter=0", ": --set: bodies.12.jitter: found \"12\""},
           Mistake{"expect.last_m_s.tolerance=1", "found \"last_m_s\", the name of 2; allowed: an index from 0 to 1"},
           Mistake{"grid.spacing.x=1", "found grid.spacing, which is a single value"},
           Mistake{"gravity.2=1", ": --set: gravity.2: found \"2\"; allowed: an index from 0 to 1"},
           Mistake{"gravity.1=up", ": --set: gravity: found \"up\" (a text) in [0, \"up\"]"},
           Mistake{"grid.spacing=-1", ": --set: grid.spacing: found -1; allowed: a number > 0 [m]"},
           Mistake{"grid.spacing=1 2", ": --set: grid.spacing: found 1 2; allowed: a TOML value"},
           Mistake{"grid.spacing=1\ny=2", "allowed: a TOML value"},
           Mistake{"grid.spacing", "found \"grid.spacing\"; allowed: KEY=VALUE"},
           Mistake{"grid..spacing=1", "found \"grid..spacing\"; allowed: a key such as"},
           Mistake{"=1", "allowed: a key such as"},
           Mistake{"solver.couran=",
                   "found no such key to remove; allowed: one of \"blend_rate\", \"courant\", \"damping_rate\", "
                   "\"even_out_volumes\", "
                   "\"transfer\"; the nearest is \"courant\""},
           Mistake{"grid.spacing=0.0005",
                   "found 5e-04, which is 400 million cells, about 74 GB of memory for the grid; allowed: at most 200 "
                   "million cells, about 37 GB of memory for the grid"},
           Mistake{"grid.spacing=1e-5", "allowed: at most 200 million cells"},
           Mistake{"grid.spacing=", "grid.spacing: found nothing: the key is missing"},
       }) {
    const std::string error = scene_error(every_key, {mistake.override});
    CAPTURE(error);
    CHECK(has(error, mistake.message));
  }
}
