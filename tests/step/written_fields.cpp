// What rows say that they write, against what changes when they run: in all scenes of tests/golden, which have every
// feature in one of them. Debug builds look during every run (step/write_check).
#include <doctest/doctest.h>

#include "step/write_check.hpp"
#include "support/golden.hpp"

#include <geodrop/step/pipeline.hpp>

using namespace geodrop;

namespace {

/// Runs some steps and checks each row of each.
template <int Dim>
void check_rows(const Scene& scene) {
  State<Dim> state = build_state<Dim>(scene);
  Grids<Dim> grids = make_grids<Dim>(scene);
  Pipeline<Dim> pipeline = build_pipeline<Dim>(scene);
  for (int k = 0; k < 51; ++k) {
    StepContext step{0, state.t, state.step};
    const bool looks = k < 2 || k == 50;  // the energy watch acts in steps 0 and 50
    for (Row<Dim>& row : pipeline) {
      std::optional<DataHashes> before;
      if (looks) before = hashes_of(state, grids);
      row.run(state, grids, step);
      if (looks) CHECK_NOTHROW(check_writes(row, changed_data(*before, hashes_of(state, grids))));
    }
    state.t += step.dt;
    ++state.step;
  }
}

}  // namespace

TEST_CASE("Rows change only what they say that they write") {
  const std::vector<test::Golden> scenes = test::golden_scenes();
  CHECK_FALSE(scenes.empty());
  for (const test::Golden& golden : scenes) {
    CAPTURE(golden.name());
    const Scene scene = read_scene(source_path(golden.scene()), test::settings_of(golden));
    scene.dimension == 2 ? check_rows<2>(scene) : check_rows<3>(scene);
  }
}

TEST_CASE("A row that changes what it does not name is named, with the fields") {
  const Scene scene = read_scene(source_path("cases/hydrostatic_column.toml"));
  State<2> state = build_state<2>(scene);
  Grids<2> grids = make_grids<2>(scene);
  const Row<2> row{"meddler", Data::volume_ratio, Data::velocity, true, [](State<2>& s, Grids<2>& g, StepContext&) {
                     s.bodies[0].v[0][3] += 1;
                     s.bodies[0].J[2] *= 2;
                     g[0].cell_pressure[7] = 5;
                   }};
  const DataHashes before = hashes_of(state, grids);
  StepContext step;
  row.run(state, grids, step);
  CHECK_THROWS_WITH_AS(check_writes(row, changed_data(before, hashes_of(state, grids))),
                       "row meddler changes what it does not say that it writes: volume ratio, cell pressure",
                       std::logic_error);
}

TEST_CASE("Each group of fields has a name of its own, and a set lists those in it") {
  CHECK(names_of(Data::nodal_sums | Data::position) == "position, nodal sums");
  CHECK(names_of({}).empty());
  for (int i = 0; i < static_cast<int>(Data::count); ++i)
    for (int j = 0; j < i; ++j) CHECK(name_of(static_cast<Data>(i)) != name_of(static_cast<Data>(j)));
}
