// What rows say that they write, against what changes when they run: in all scenes of tests/golden, which have every
// feature in one of them. Debug builds look during every run (pipeline/write_check).
#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "pipeline/write_check.hpp"
#include "support/scene_files.hpp"

#include <geodrop/pipeline.hpp>

using namespace geodrop;

namespace {

/// Cells of a line; those between `;` of one.
std::vector<std::string> split(const std::string& text, char separator) {
  std::istringstream stream(text);
  std::vector<std::string> parts;
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

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
      std::optional<DataHashes<Dim>> before;
      if (looks) before.emplace(state, grids);
      row.run(state, grids, step);
      if (looks) CHECK_NOTHROW(check_writes(row, before->changed(state, grids)));
    }
    state.t += step.dt;
    ++state.step;
  }
}

}  // namespace

TEST_CASE("Rows change only what they say that they write") {
  std::ifstream file(source_path("tests/golden/hashes.csv"));
  std::string line, last;
  std::getline(file, line);
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = split(line, ',');
    if (cells[0] == last) continue;
    last = cells[0];
    CAPTURE(last);
    const Scene scene = read_scene(source_path(cells[1]), split(cells[2], ';'));
    scene.dimension == 2 ? check_rows<2>(scene) : check_rows<3>(scene);
  }
  CHECK_FALSE(last.empty());
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
  const DataHashes<2> before(state, grids);
  StepContext step;
  row.run(state, grids, step);
  CHECK_THROWS_WITH_AS(check_writes(row, before.changed(state, grids)),
                       "row meddler changes what it does not say that it writes: volume ratio, cell pressure",
                       std::logic_error);
}

TEST_CASE("Each group of fields has a name of its own, and a set lists those in it") {
  CHECK(names_of(Data::nodal_sums | Data::position) == "position, nodal sums");
  CHECK(names_of({}).empty());
  for (int i = 0; i < static_cast<int>(Data::count); ++i)
    for (int j = 0; j < i; ++j) CHECK(name_of(static_cast<Data>(i)) != name_of(static_cast<Data>(j)));
}
