// What a material does in a box, against values set by hand.
#include "measure/probes/region_probe.hpp"

#include <doctest/doctest.h>
#include <geodrop/measure/history.hpp>
#include <geodrop/reader/scene_reader.hpp>
#include <geodrop/step/pipeline.hpp>

#include <algorithm>

#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

TEST_CASE("A region has the volume, mean pressure, vertical stress, velocity and flow of all bodies of its material") {
  const Scene scene = read_scene(source_path("cases/verification/terzaghi.toml"),
                                 {"probes=[{name='box',type='region',material='water',lower=[0.0,0.5],upper=[0.1,1.1]},"
                                  "{name='empty',type='region',material='soil',lower=[0.0,1.2],upper=[0.1,1.3]}]"});
  State<2> state = build_state<2>(scene);
  for (Body<2>& body : state.bodies)
    for (std::size_t p = 0; p < body.size(); ++p) body.v[0][p] = 0.2, body.v[1][p] = body.name == "soil" ? 9 : -0.3;
  const std::vector<std::string> names = history_columns(scene);
  const std::vector<double> row = history_row(scene, state, {names, {}});
  const auto value = [&](const std::string& name) {
    const auto at = std::find(names.begin(), names.end(), name);
    REQUIRE(at != names.end());
    return row[at - names.begin()];
  };
  // 0.1 m x (0.5 m of pores with n = 0.4, 0.1 m of free water); the pores have 100 Pa, the free water none.
  const double volume = 0.1 * (0.5 * 0.4 + 0.1);
  CHECK(value("box.volume_m2") == near(volume, 1e-12));
  CHECK(value("box.pressure_mean_Pa") == near(100 * 2.0 / 3, 1e-9));
  CHECK(value("box.vertical_stress_mean_Pa") == near(-100 * 2.0 / 3, 1e-9));
  CHECK(value("box.velocity_mean_x_m_s") == near(0.2, 1e-12));
  CHECK(value("box.flow_x_m2_s") == near(volume * 0.2 / 0.1, 1e-12));
  CHECK(value("box.flow_y_m2_s") == near(-volume * 0.3 / 0.6, 1e-12));
  CHECK(value("empty.volume_m2") == 0);
  CHECK(std::isnan(value("empty.pressure_mean_Pa")));
  CHECK(value("empty.flow_x_m2_s") == 0);
}
