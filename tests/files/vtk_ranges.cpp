// What does not fit the narrow types of a frame gets wider ones: many bodies, places far from the origin.
#include "files/vtk_files.hpp"
#include "support/scene_files.hpp"
#include "support/small_state.hpp"

#include <doctest/doctest.h>

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

using namespace geodrop;

namespace {

vtkSmartPointer<vtkUnstructuredGrid> written(const State<2>& state) {
  const TemporaryDirectory directory;
  write_particles(directory / "a.vtu", take_snapshot(state, {"water", "sand"}).particles, 0, Compression::none);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((directory / "a.vtu").c_str());
  reader->Update();
  return reader->GetOutput();
}

std::string type_of(vtkUnstructuredGrid* grid, const char* name) {
  return grid->GetPointData()->GetArray(name)->GetDataTypeAsString();
}

}  // namespace

TEST_CASE("Body 256 is not body 0") {
  State<2> state = small_state();
  CHECK(type_of(written(state), "body") == "unsigned char");
  while (state.bodies.size() < 300) state.bodies.push_back(state.bodies[0]);
  const auto grid = written(state);
  CHECK(type_of(grid, "body") == "unsigned short");
  CHECK(grid->GetPointData()->GetArray("body")->GetComponent(4 * 256, 0) == 256);
  CHECK(grid->GetPointData()->GetArray("body")->GetComponent(4 * 300 - 1, 0) == 299);
}

TEST_CASE("In national coordinates positions are written in full") {
  State<2> state = small_state();
  CHECK(std::string(written(state)->GetPoints()->GetData()->GetDataTypeAsString()) == "float");
  const double far = 190000.0;  // of particles 1 m wide; in single precision 0.0156 m apart there
  for (Body<2>& body : state.bodies)
    for (double& x : body.x[0]) x += far + 0.001;
  const auto grid = written(state);
  CHECK(std::string(grid->GetPoints()->GetData()->GetDataTypeAsString()) == "double");
  CHECK(grid->GetPoint(1)[0] == state.bodies[0].x[0][1]);
}
