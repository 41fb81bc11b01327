// Tension of a part of a membrane, and the spread of stress over particles.
#include "measure/probes/span_probe.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <geodrop/measure/history.hpp>
#include <geodrop/reader/scene_reader.hpp>
#include <geodrop/step/pipeline.hpp>

#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// Tension s N/m in segment s of the skin of the block, which is 2 m wide and 1 m high.
State<2> with_tension(const Scene& scene) {
  State<2> state = build_state<2>(scene);
  for (Membrane<2>& membrane : state.membranes)
    for (std::size_t s = 0; s < membrane.segments(); ++s) membrane.tension[s] = static_cast<double>(s);
  return state;
}

}  // namespace

TEST_CASE("A span of a closed membrane is the shorter way round, whichever end comes first") {
  const Scene scene = read_scene(source_path("tests/scenes/block_on_slab.toml"));
  const State<2> state = with_tension(scene);
  const Membrane<2>& skin = state.membranes[1];
  // The box begins at its lower left corner and runs anticlockwise: the bottom is the first segments.
  const auto bottom = static_cast<double>(skin.segments()) / 3;  // 2 of 6 m
  for (const bool turned : {false, true}) {
    const Point left{1.0, 1.03}, right{3.0, 1.03};
    const SpanTension tension =
        span_tension(scene, {"bottom", "skin", turned ? right : left, turned ? left : right}, state);
    CHECK(tension.max == near(bottom - 1, 1e-12));
    CHECK(tension.mean == near((bottom - 1) / 2, 1e-9));
  }
}

TEST_CASE("A span of an open membrane, and one of no length") {
  const Scene scene = read_scene(source_path("tests/scenes/block_on_slab.toml"));
  const State<2> state = with_tension(scene);
  const auto all = static_cast<double>(state.membranes[0].segments());
  const SpanTension half = span_tension(scene, {"half", "ground", {10.0, 1.03}, {5.0, 1.03}}, state);
  CHECK(half.max == all - 1);
  CHECK(half.mean == near((1.5 * all - 1) / 2, 1e-9));
  const SpanTension none = span_tension(scene, {"none", "ground", {5.0, 1.03}, {5.0, 1.03}}, state);
  CHECK(none.mean == 0);
  CHECK(none.max == 0);
}

TEST_CASE("The spread of vertical stress: percentiles over the particles") {
  const Scene scene = read_scene(source_path("tests/scenes/block_on_slab.toml"),
                                 {"probes=[{name='spread',type='stress',body='block'}]"});
  State<2> state = build_state<2>(scene);
  Body<2>& block = state.bodies[1];
  for (std::size_t p = 0; p < block.size(); ++p)
    block.stress[1][p] = 100.0 * static_cast<double>(p) / static_cast<double>(block.size() - 1);
  const std::vector<std::string> names = history_columns(scene);
  const std::vector<double> row = history_row(scene, state, {names, {}});
  const auto value = [&](const std::string& name) {
    return row[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())];
  };
  CHECK(value("spread.vertical_stress_p01_Pa") == near(1, 1e-9));
  CHECK(value("spread.vertical_stress_p50_Pa") == near(50, 1e-9));
  CHECK(value("spread.vertical_stress_p99_Pa") == near(99, 1e-9));
}
