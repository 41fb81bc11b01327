// The worst of all particles, against values set by hand.
#include "measure/probes/extremes_probe.hpp"

#include <doctest/doctest.h>
#include <geodrop/measure/history.hpp>
#include <geodrop/reader/scene_reader.hpp>
#include <geodrop/step/pipeline.hpp>

#include <algorithm>

#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

TEST_CASE("Extremes of J, of the pressure, and the largest principal stress in the plane and across it") {
  Body<2> body = blank_body<2>(LinearElastic{1000, 1e6, 1e6}, 3);
  body.J = {0.5, 1.0, 2.5};
  // Particle 0: 50 +- 10 in the plane (40 and 40 with a shear of 10); particle 2: under pressure in the plane, 70
  // across.
  body.stress[0] = {50.0, 0.0, -90.0};
  body.stress[1] = {50.0, 0.0, -10.0};
  body.stress[2] = {0.0, 0.0, 70.0};
  body.stress[3] = {10.0, 0.0, 0.0};
  const Extremes found = extremes_of(body);
  CHECK(found.volume_min == 0.5);
  CHECK(found.volume_max == 2.5);
  CHECK(found.pressure_min == near(-100.0 / 3, 1e-12));
  CHECK(found.pressure_max == near(10, 1e-12));
  CHECK(found.tension == near(70, 1e-12));
  body.stress[2][2] = 0;
  CHECK(extremes_of(body).tension == near(60, 1e-12));
}

TEST_CASE("The tension of wet soil is the effective one, in space with all its shears") {
  MohrCoulomb soil{};
  soil.density = 2000;
  soil.pore_stiffness = 1e7;
  Body<3> body = blank_body<3>(soil, 1);
  body.pore_pressure = {1000.0};
  // All components equal: the principal stresses are 3 s, 0, 0.
  for (auto& component : body.stress) component = {5.0};
  const Extremes found = extremes_of(body);
  CHECK(found.tension == near(15, 1e-12));
  CHECK(found.pressure_min == near(995, 1e-12));
  CHECK(found.pressure_max == near(995, 1e-12));
}

TEST_CASE("The probe lists its columns with the values of its body") {
  const Scene scene = read_scene(source_path("tests/scenes/block_on_slab.toml"),
                                 {"probes=[{name='worst',type='extremes',body='block'}]"});
  State<2> state = build_state<2>(scene);
  state.bodies[1].J[3] = 0.25;
  state.bodies[1].J[4] = 4;
  state.bodies[1].stress[1][5] = 3e6;
  const std::vector<std::string> names = history_columns(scene);
  const std::vector<double> row = history_row(scene, state, {names, {}});
  const auto value = [&](const std::string& name) {
    return row[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())];
  };
  CHECK(value("worst.volume_min_ratio") == 0.25);
  CHECK(value("worst.volume_max_ratio") == 4);
  CHECK(value("worst.pressure_min_Pa") == near(-1e6, 1e-12));
  CHECK(value("worst.pressure_max_Pa") == 0);
  CHECK(value("worst.tension_max_Pa") == near(3e6, 1e-12));
}
