// Frames read back with VTK, and what happens when the disk does not take them.
#include <geodrop/base/error.hpp>
#include <geodrop/base/find_named.hpp>
#include <geodrop/measure/measure.hpp>

#include "files/frame_writer.hpp"
#include "files/vtk_files.hpp"
#include "support/near.hpp"
#include "support/scene_files.hpp"
#include "support/small_state.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <array>
#include <string>

using namespace geodrop;
using namespace geodrop::test;

namespace {

const std::vector<std::string> materials = {"water", "sand"};

template <class Reader, class Data>
vtkSmartPointer<Data> read_back(const std::filesystem::path& path) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// A state in which every field of particle 2 of the sand has a value of its own.
State<2> varied_state() {
  State<2> state = small_state();
  state.t = 0.625;
  Body<2>& sand = state.bodies[1];
  sand.x[0][2] = 3.25;
  sand.v[0][2] = 1;
  sand.v[1][2] = -2;
  for (int k = 0; k < 4; ++k) sand.stress[k][2] = -100.0 * (k + 1);
  sand.pore_pressure[2] = 50;
  sand.deviatoric_strain[2] = 0.125;
  sand.J[2] = 1.25;
  return state;
}

constexpr vtkIdType varied = 4 + 2;  ///< its place in the file: after four particles of water

}  // namespace

TEST_CASE("particles come back with all fields, components, time") {
  const TemporaryDirectory directory;
  write_particles(directory / "a.vtu", take_snapshot(varied_state(), materials).particles, 0.625, Compression::none);
  const auto grid = read_back<vtkXMLUnstructuredGridReader, vtkUnstructuredGrid>(directory / "a.vtu");
  REQUIRE(grid->GetNumberOfPoints() == 8);
  CHECK(grid->GetNumberOfCells() == 8);
  CHECK(grid->GetCellType(7) == VTK_VERTEX);
  CHECK(grid->GetPoint(varied)[0] == 3.25);
  CHECK(grid->GetPoint(varied)[2] == 0);
  vtkPointData* data = grid->GetPointData();
  const auto value = [&](const char* name, int component) {
    vtkDataArray* array = data->GetArray(name);
    REQUIRE_MESSAGE(array != nullptr, name);
    return array->GetComponent(varied, component);
  };
  CHECK(value("velocity", 0) == 1);
  CHECK(value("velocity", 1) == -2);
  CHECK(value("velocity", 2) == 0);
  CHECK(value("displacement", 0) == -0.25);
  // Total stress: pore pressure is subtracted from the normal components.
  const std::array<double, 6> stress = {-150, -250, -350, -400, 0, 0};
  for (int k = 0; k < 6; ++k) CHECK(value("stress", k) == stress[static_cast<std::size_t>(k)]);
  CHECK(value("mean_pressure", 0) == 250);
  CHECK(value("pore_pressure", 0) == 50);
  CHECK(value("deviatoric_strain", 0) == 0.125);
  CHECK(value("volumetric_strain", 0) == 0.25);
  CHECK(value("density", 0) == 1280);
  CHECK(value("layer", 0) == 1);
  CHECK(value("material", 0) == 1);
  CHECK(value("body", 0) == 1);
  CHECK(value("id", 0) == 2);
  CHECK(data->GetNumberOfArrays() == 12);
  const std::array<const char*, 6> names = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
  for (int k = 0; k < 6; ++k)
    CHECK(std::string(data->GetArray("stress")->GetComponentName(k)) == names[static_cast<std::size_t>(k)]);
  CHECK(std::string(data->GetArray("stress")->GetDataTypeAsString()) == "float");
  CHECK(grid->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0) == 0.625);
}

TEST_CASE("particles keep their layer and their start when they were sorted") {
  State<2> state = small_state();
  state.bodies[1].id = {3, 0, 1, 2};
  const ParticleSnapshot particles = take_snapshot(state, materials).particles;
  CHECK(particles.layer == std::vector<std::uint8_t>{0, 0, 1, 1, 1, 0, 0, 1});
  CHECK(particles.id[4] == 3);
  CHECK(particles.fields[1].values[3 * 4] == -1);  // from (4.5, 4.5), where particle 3 was, to (3.5, 3.5)
}

TEST_CASE("the six components of three dimensions are in VTK's order") {
  Body<3> body;
  body.material = LinearElastic{1000, 1, 1};
  body.material_name = "sand";
  for (int a = 0; a < 3; ++a) {
    body.x[a] = {a + 1.0};
    body.initial_x[a] = {0.0};
    body.v[a] = {0.0};
  }
  for (int k = 0; k < 6; ++k) body.stress[k] = {k + 1.0};
  body.mass = {1};
  body.J = {1};
  body.id = {0};
  State<3> state;
  state.bodies = {body};
  const ParticleSnapshot particles = take_snapshot(state, materials).particles;
  CHECK(particles.points == std::vector<double>{1, 2, 3});
  CHECK(particles.fields[2].values == std::vector<float>{1, 2, 3, 4, 5, 6});  // XX YY ZZ XY YZ XZ, as in types.hpp
}

TEST_CASE("only the fields that are asked for are copied, in the order of all") {
  const ParticleSnapshot all = take_snapshot(small_state(), materials).particles;
  const ParticleSnapshot some = take_snapshot(small_state(), materials, {"density", "velocity"}).particles;
  REQUIRE(some.fields.size() == 2);
  CHECK(some.fields[0].name == "velocity");
  CHECK(some.fields[0].values == all.fields[0].values);
  CHECK(some.fields[1].name == "density");
  CHECK(some.fields[1].values == find_named(all.fields, "density").values);
  CHECK(some.points == all.points);
  CHECK(some.id == all.id);
}

TEST_CASE("files are inline binary, compressed on request only") {
  const TemporaryDirectory directory;
  const ParticleSnapshot particles = take_snapshot(small_state(), materials).particles;
  write_particles(directory / "plain.vtu", particles, 0, Compression::none);
  const std::string plain = read_file(directory / "plain.vtu");
  CHECK(plain.find("format=\"binary\"") != std::string::npos);
  CHECK(plain.find("appended") == std::string::npos);
  CHECK(plain.find("ompressor") == std::string::npos);
  write_particles(directory / "small.vtu", particles, 0, Compression::lz4);
  CHECK(read_file(directory / "small.vtu").find("vtkLZ4DataCompressor") != std::string::npos);
  CHECK(read_back<vtkXMLUnstructuredGridReader, vtkUnstructuredGrid>(directory / "small.vtu")->GetNumberOfPoints() ==
        8);
}

TEST_CASE("membranes come back as lines with their tension") {
  const TemporaryDirectory directory;
  write_membranes(directory / "m.vtp", take_snapshot(small_state(), materials).membranes, 2, Compression::none);
  const auto lines = read_back<vtkXMLPolyDataReader, vtkPolyData>(directory / "m.vtp");
  REQUIRE(lines->GetNumberOfLines() == 4);
  vtkIdType count = 0;
  const vtkIdType* nodes = nullptr;
  lines->GetCellPoints(3, count, nodes);
  CHECK(count == 2);
  CHECK(nodes[0] == 3);
  CHECK(nodes[1] == 0);
  CHECK(lines->GetPoint(2)[1] == 5);
  CHECK(lines->GetCellData()->GetArray("tension")->GetComponent(2, 0) == 300);
  CHECK(lines->GetCellData()->GetArray("strain")->GetComponent(3, 0) == -0.5);
  CHECK(lines->GetCellData()->GetArray("utilisation")->GetComponent(1, 0) == near(0.4, 4e-8));
  CHECK(std::isnan(lines->GetCellData()->GetArray("contents_pressure")->GetComponent(0, 0)));
  CHECK(std::isnan(lines->GetCellData()->GetArray("water_pressure")->GetComponent(0, 0)));
  CHECK(lines->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0) == 2);
}

TEST_CASE("The page of ParaView has all fields of membranes") {
  const std::string page = read_file(source_path("paraview/README.md"));
  const std::string table = page.substr(page.find("## Fields of the membranes"));
  std::vector<std::string> names;
  for (const Field& field : take_snapshot(small_state(), materials).membranes.fields) names.push_back(field.name);
  for (const Field& field : take_snapshot(State<3>(), {}).membranes.fields) names.push_back(field.name);
  CHECK(names.size() >= 10);
  for (const std::string& name : names)
    CHECK_MESSAGE(table.substr(0, table.find("\n\n")).find("| `" + name + "` |") != std::string::npos, name);
}

TEST_CASE("rigid bodies come back as their outlines with their velocity; what is not there has none") {
  const TemporaryDirectory directory;
  State<2> state = small_state();
  RigidBody<2> disc, slope, gone;
  disc.from = disc.to = {3, 4};
  disc.radius = 2;
  disc.velocity = {0.5, -1};
  slope.half_plane = true;
  slope.from = {0, 0};
  slope.to = {-6, 8};
  slope.normal = {0.8, 0.6};
  gone.present = false;
  state.rigid = {gone, disc, slope};
  write_rigid(directory / "r.vtp", take_snapshot(state, materials).rigid, 2, Compression::none);
  const auto lines = read_back<vtkXMLPolyDataReader, vtkPolyData>(directory / "r.vtp");
  auto* const rigid = lines->GetCellData()->GetArray("rigid");
  const vtkIdType count = lines->GetNumberOfLines(), points = lines->GetNumberOfPoints();
  REQUIRE(count > 20);
  CHECK(points == count + 1);  // a closed line and an open one
  for (vtkIdType line = 0; line < count; ++line) CHECK(rigid->GetComponent(line, 0) == (line + 1 < count ? 1 : 2));
  for (vtkIdType k = 0; k + 2 < points; ++k) {
    const double* const x = lines->GetPoint(k);
    CHECK(std::hypot(x[0] - 3, x[1] - 4) == near(2, 3e-7));
    CHECK(lines->GetPointData()->GetArray("velocity")->GetComponent(k, 1) == -1);
  }
  CHECK(lines->GetPoint(points - 1)[0] == -6);
}

TEST_CASE("the writer thread numbers frames and lists them in the collections") {
  const TemporaryDirectory directory;
  {
    FrameWriter writer(directory / "", Compression::none, {0});
    for (int i = 1; i < 6; ++i) {
      State<2> state = small_state();
      state.t = 0.1 * i;
      writer.submit(take_snapshot(state, materials));
    }
    CHECK(writer.times().size() == 6);
  }
  const auto last = read_back<vtkXMLUnstructuredGridReader, vtkUnstructuredGrid>(directory / "particles_000005.vtu");
  CHECK(last->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0) == 0.5);
  const std::string collection = read_file(directory / "particles.pvd");
  CHECK(collection.find("timestep=\"0\" part=\"0\" file=\"particles_000000.vtu\"") != std::string::npos);
  CHECK(collection.find("timestep=\"0.5\" part=\"0\" file=\"particles_000005.vtu\"") != std::string::npos);
  CHECK(collection.find("</VTKFile>") != std::string::npos);
  CHECK(read_file(directory / "membranes.pvd").find("membranes_000003.vtp") != std::string::npos);
}

TEST_CASE("a scene without membranes has no membrane files") {
  const TemporaryDirectory directory;
  State<2> state = small_state();
  state.membranes.clear();
  FrameWriter writer(directory / "", Compression::none, {});
  writer.submit(take_snapshot(state, materials));
  writer.wait();
  CHECK(std::filesystem::exists(directory / "particles.pvd"));
  CHECK_FALSE(std::filesystem::exists(directory / "membranes.pvd"));
  CHECK_FALSE(std::filesystem::exists(directory / "rigid.pvd"));
  state.rigid.resize(1);
  state.rigid[0].present = false;  // in the collection all the same: it may come later
  writer.submit(take_snapshot(state, materials));
  writer.wait();
  CHECK(read_file(directory / "rigid.pvd").find("rigid_000001.vtp") != std::string::npos);
}

TEST_CASE("a frame that the disk does not take waits until it does, and those behind it") {
  const TemporaryDirectory directory;
  const std::filesystem::path in_the_way = directory / "particles_000001.vtu.part";
  std::filesystem::create_directory(in_the_way);
  FrameWriter writer(directory / "", Compression::none, {});
  writer.submit(take_snapshot(small_state(), materials));
  writer.wait();
  CHECK_FALSE(writer.failed());
  for (int more = 0; more < 4; ++more) writer.submit(take_snapshot(small_state(), materials));
  writer.wait();
  CHECK(writer.failed());
  CHECK(writer.failure().find("particles_000001.vtu: File exists") != std::string::npos);
  CHECK(read_file(directory / "particles.pvd").find("particles_000001") == std::string::npos);
  CHECK(std::filesystem::exists(directory / "particles_000000.vtu"));
  CHECK_FALSE(std::filesystem::exists(directory / "particles_000001.vtu"));
  CHECK(writer.try_again() == 4);
  std::filesystem::remove(in_the_way);
  CHECK(writer.try_again() == 0);
  const std::string collection = read_file(directory / "particles.pvd");
  CHECK(collection.find("particles_000004.vtu") != std::string::npos);
  CHECK(collection.find("particles_000001.vtu") == collection.rfind("particles_000001.vtu"));
}

TEST_CASE("a link in the place of an unfinished frame is not followed") {
  const TemporaryDirectory directory;
  std::ofstream(directory / "victim") << "precious";
  std::filesystem::create_symlink(directory / "victim", directory / "particles_000000.vtu.part");
  FrameWriter writer(directory / "", Compression::none, {});
  writer.submit(take_snapshot(small_state(), materials));
  writer.wait();
  CHECK_FALSE(writer.failed());
  CHECK(read_file(directory / "victim") == "precious");
  CHECK(std::filesystem::is_regular_file(std::filesystem::symlink_status(directory / "particles_000000.vtu")));
}

TEST_CASE("what a frame may take on the disk is known beforehand") {
  const TemporaryDirectory directory;
  FrameWriter writer(directory / "", Compression::none, {});
  writer.submit(take_snapshot(small_state(), materials));
  writer.wait();
  std::size_t bytes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(directory / ""))
    if (entry.path().extension() != ".pvd") bytes += entry.file_size();
  CHECK(writer.frame_bytes() > bytes);
}

TEST_CASE("a directory that went away is an error, too") {
  const TemporaryDirectory directory;
  FrameWriter writer(directory / "gone", Compression::none, {});
  writer.submit(take_snapshot(small_state(), materials));
  writer.wait();
  CHECK(writer.failure().find("No such file") != std::string::npos);
}
