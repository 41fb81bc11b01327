// paraview/to_vtkhdf.py, read as the specification of VTKHDF says. Where Python lacks numpy or h5py, or
// GEODROP_NO_PARAVIEW is set, there is nothing to test.
#include <doctest/doctest.h>

#include <cstdlib>

#include "support/not_tested.hpp"
#include "support/program.hpp"
#include "support/python.hpp"
#include "support/text.hpp"

using namespace geodrop::test;

namespace {

/// Converts the run in `directory` and compares the file with its frames; prints how many fields were compared.
const char* const comparison = R"(
import geodrop, h5py, numpy, pathlib, to_vtkhdf
file = pathlib.Path(directory) / "frames.vtkhdf"
to_vtkhdf.convert(pathlib.Path(directory), file)
run, root = geodrop.read(directory), h5py.File(file)["VTKHDF"]
assert root.attrs["Type"] == b"MultiBlockDataSet" and len(run.times) > 2
compared = 0
for name in root["Assembly"]:
    block = root["Assembly"][name]
    steps = block["Steps"]
    assert block.attrs["Type"] == b"PolyData" and steps.attrs["NSteps"] == len(run.times)
    assert (steps["Values"][:] == run.times).all()
    for k in range(len(run.times)):
        frame = getattr(run.frame_number(k), name)
        part, first = steps["PartOffsets"][k], steps["PointOffsets"][k]
        points = block["NumberOfPoints"][part]
        assert (block["Points"][first:first + points] == frame["points"]).all()
        cells = 0
        for kind, column in (("Vertices", 0), ("Lines", 1), ("Polygons", 2), ("Strips", 3)):
            group, here = block[kind], block[kind]["NumberOfCells"][part]
            begin = steps["CellOffsets"][k][column] + part  # a frame has one offset more than cells
            offsets = group["Offsets"][begin:begin + here + 1]
            ids = steps["ConnectivityIdOffsets"][k][column]
            connectivity = group["Connectivity"][ids:ids + group["NumberOfConnectivityIds"][part]]
            assert offsets[0] == 0 and offsets[-1] == len(connectivity)
            assert len(connectivity) == 0 or connectivity.max() < points
            cells += here
        for data, size in (("PointData", points), ("CellData", cells)):
            for field in block.get(data, ()):
                begin = steps[data + "Offsets"][field][k]
                values = block[data][field][begin:begin + size]
                assert numpy.array_equal(values, frame[field], equal_nan=True), (name, field)
                compared += 1
print("compared", compared)
)";

}  // namespace

TEST_CASE("A VTKHDF file has all arrays of all frames of a run") {
  if (std::getenv("GEODROP_NO_PARAVIEW") || !python_has("h5py, numpy")) {
    not_tested("no " + python + " with h5py and numpy, or GEODROP_NO_PARAVIEW");
    return;
  }
  for (const std::string scene : {"tests/scenes/hanging.toml", "tests/scenes/bag_3d.toml"}) {
    CAPTURE(scene);
    const SceneRun run(scene);
    const std::string said = ask_python("directory = '" + run.file("").string() + "'\n" + comparison);
    CAPTURE(said);
    CHECK(said.starts_with("compared "));
    CHECK(std::stoi(said.substr(said.find(' '))) > 40);
  }
}

TEST_CASE("What is no run directory with frames is not converted, by its name") {
  if (std::getenv("GEODROP_NO_PARAVIEW") || !python_has("h5py, numpy")) return;
  const std::string said = ask_python("import sys, to_vtkhdf\nsys.argv[1:] = ['/nowhere']\nto_vtkhdf.main()\n");
  CHECK(said.starts_with("failed"));
  CHECK(contains(said, "/nowhere has no particles.pvd"));
}
