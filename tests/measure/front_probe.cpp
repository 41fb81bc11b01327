// How far a heap reaches.
#include "measure/probes/front_probe.hpp"

#include <doctest/doctest.h>

#include <geodrop/measure/history.hpp>
#include <geodrop/reader/scene_reader.hpp>
#include <geodrop/step/pipeline.hpp>

#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// A heap like a roof, 4 m wide from x = 1 m on, 1 m high: its thickness is T at 2 T m from either end.
Scene roof(const std::string& spacing) {
  return read_scene(source_path("cases/verification/column_collapse.toml"),
                    {"grid.spacing=" + spacing, "bodies.column.particles_per_cell_axis=4",
                     "bodies.column.shape={type='polygon',points=[[1,0],[5,0],[3,1]]}",
                     "probes=[{name='heap',type='front',body='column',thickness=0.2}]"});
}

}  // namespace

TEST_CASE("The fronts of a roof lie where it is as thick as told, at any spacing") {
  for (const char* spacing : {"0.1", "0.05"}) {
    const Scene scene = roof(spacing);
    const HeapFronts fronts = heap_fronts(scene.grid, {"heap", "column", 0.2}, build_state<2>(scene).bodies[0]);
    CHECK(fronts.left == near(1.4, 1e-12));
    CHECK(fronts.right == near(4.6, 1e-12));
  }
}

TEST_CASE("Lone particles ahead are left out; at a wall the heap ends at the wall") {
  const Scene scene = roof("0.1");
  State<2> state = build_state<2>(scene);
  Body<2>& heap = state.bodies[0];
  const double before = heap_fronts(scene.grid, {"heap", "column", 0.2}, heap).right;
  heap.x[0][0] = 5.95;
  heap.x[0][1] = 5.5;
  const HeapFronts fronts = heap_fronts(scene.grid, {"heap", "column", 0.2}, heap);
  CHECK(fronts.right == near(before, 1e-12));
  for (double& x : heap.x[0]) x -= 2.95;
  CHECK(heap_fronts(scene.grid, {"heap", "column", 0.2}, heap).left == near_zero(1e-12));
}

TEST_CASE("What is nowhere as thick as told has both fronts where it is thickest") {
  const Scene scene = roof("0.1");
  const HeapFronts fronts = heap_fronts(scene.grid, {"heap", "column", 1.5}, build_state<2>(scene).bodies[0]);
  CHECK(fronts.left == fronts.right);
  CHECK(fronts.left == near(3.0, 0.02));
}

TEST_CASE("Both fronts are columns of the history") {
  const Scene scene = roof("0.1");
  const std::vector<std::string> columns = history_columns(scene);
  const std::vector<double> row = history_row(scene, build_state<2>(scene), {columns, {}});
  const auto value = [&](const std::string& name) { return row[HistoryTable{columns, {}}.find(name)]; };
  CHECK(value("heap.left_m") == near(1.4, 1e-12));
  CHECK(value("heap.right_m") == near(4.6, 1e-12));
}
