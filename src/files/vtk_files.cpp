// Inline binary, not appended: ParaView 5.11 as in Debian 12 cannot read appended data of more than a few thousand
// points, since its XML parser refuses what comes after the last element.
#include "vtk_files.hpp"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedIntArray.h>
#include <vtkUnsignedShortArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <geodrop/base/error.hpp>
#include <limits>

#include "base/atomic_file.hpp"

namespace geodrop {
namespace {

/// A VTK array that looks at our numbers without a copy; it neither changes nor frees them.
template <class VtkArray, class T>
vtkSmartPointer<VtkArray> view(const std::string& name, const std::vector<T>& values, std::size_t width) {
  constexpr int keep = 1;
  auto array = vtkSmartPointer<VtkArray>::New();
  if (!name.empty()) array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(width));
  array->SetArray(const_cast<T*>(values.data()), static_cast<vtkIdType>(values.size()), keep);
  return array;
}

template <class VtkArray, class T>
void add(vtkFieldData* to, const std::string& name, const std::vector<T>& values) {
  to->AddArray(view<VtkArray>(name, values, 1));
}

void add_fields(vtkFieldData* to, const std::vector<Field>& fields) {
  for (const Field& field : fields) {
    const auto array = view<vtkFloatArray>(field.name, field.values, field.width());
    for (std::size_t c = 0; c < field.components.size(); ++c)
      array->SetComponentName(static_cast<vtkIdType>(c), field.components[c].c_str());
    to->AddArray(array);
  }
}

/// A copy of integers in a narrower type.
template <class VtkArray>
vtkSmartPointer<VtkArray> narrowed(const std::string& name, const std::vector<std::uint32_t>& values) {
  auto array = vtkSmartPointer<VtkArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
    array->SetValue(static_cast<vtkIdType>(i), static_cast<typename VtkArray::ValueType>(values[i]));
  return array;
}

/// Numbers of bodies, materials, ...: one byte each wherever they fit.
void add_numbers(vtkFieldData* to, const std::string& name, const std::vector<std::uint32_t>& values) {
  const std::uint32_t largest = values.empty() ? 0 : *std::max_element(values.begin(), values.end());
  if (largest <= std::numeric_limits<std::uint8_t>::max())
    to->AddArray(narrowed<vtkUnsignedCharArray>(name, values));
  else if (largest <= std::numeric_limits<std::uint16_t>::max())
    to->AddArray(narrowed<vtkUnsignedShortArray>(name, values));
  else
    add<vtkUnsignedIntArray>(to, name, values);
}

void set_points(vtkPointSet* to, const std::vector<double>& points, Precision precision) {
  vtkNew<vtkPoints> vtk_points;
  if (precision == Precision::twice) {
    vtk_points->SetData(view<vtkDoubleArray>("Points", points, 3));
  } else {
    vtkNew<vtkFloatArray> array;
    array->SetName("Points");
    array->SetNumberOfComponents(3);
    array->SetNumberOfValues(static_cast<vtkIdType>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
      array->SetValue(static_cast<vtkIdType>(i), static_cast<float>(points[i]));
    vtk_points->SetData(array);
  }
  to->SetPoints(vtk_points);
}

/// ParaView shows this as the time of the data.
void set_time(vtkDataObject* of, double t) {
  vtkNew<vtkDoubleArray> time;
  time->SetName("TimeValue");
  time->InsertNextValue(t);
  of->GetFieldData()->AddArray(time);
}

/// Cells of `size` points each: offsets 0, size, 2 size, ... 32-bit, which halves them in the file.
vtkSmartPointer<vtkCellArray> make_cells(vtkTypeInt32Array* connectivity, int size) {
  vtkNew<vtkTypeInt32Array> offsets;
  const vtkIdType cells = connectivity->GetNumberOfValues() / size;
  offsets->SetNumberOfValues(cells + 1);
  for (vtkIdType c = 0; c <= cells; ++c) offsets->SetValue(c, static_cast<vtkTypeInt32>(c * size));
  auto array = vtkSmartPointer<vtkCellArray>::New();
  array->SetData(offsets, connectivity);
  return array;
}

/// Lines of two points each, or triangles of three.
template <class LineSnapshot>
vtkSmartPointer<vtkPolyData> make_lines(const LineSnapshot& snapshot, int corners = 2) {
  auto lines = vtkSmartPointer<vtkPolyData>::New();
  set_points(lines, snapshot.points, snapshot.precision);
  vtkNew<vtkTypeInt32Array> connectivity;
  for (const std::uint32_t node : snapshot.connectivity) connectivity->InsertNextValue(static_cast<vtkTypeInt32>(node));
  if (corners == 2)
    lines->SetLines(make_cells(connectivity, corners));
  else
    lines->SetPolys(make_cells(connectivity, corners));
  return lines;
}

/// VTK's own codes begin where errno's end.
std::string describe(unsigned long code, const std::string& reported) {
  if (code == vtkErrorCode::OutOfDiskSpaceError) return "no space left on the disk";
  if (code != vtkErrorCode::NoError && code < vtkErrorCode::FirstVTKErrorCode)
    return std::strerror(static_cast<int>(code));
  return "VTK error " + std::to_string(code) + " " + reported;
}

/// Empty if it was written. VTK reports a failed write by a code, and by events that it prints on stderr unless
/// somebody listens.
std::string try_to_write(vtkXMLWriter* writer, vtkDataObject* data, const std::string& path, Compression compression) {
  std::string reported;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&reported);
  observer->SetCallback([](vtkObject*, unsigned long, void* text, void* message) {
    *static_cast<std::string*>(text) = message ? static_cast<const char*>(message) : "";
  });
  writer->AddObserver(vtkCommand::ErrorEvent, observer);
  writer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  writer->SetFileName(path.c_str());
  writer->SetInputDataObject(data);
  writer->SetDataModeToBinary();
  // A frame of the main case costs two threads 20 ms with LZ4, 50 ms with zlib, whose files are a third smaller.
  if (compression == Compression::none)
    writer->SetCompressorTypeToNone();
  else
    writer->SetCompressorTypeToLZ4();
  writer->SetCompressionLevel(9);  // of 1 to 9; 1 gives files that are a fifth larger in the same time
  writer->Write();
  const unsigned long code = writer->GetErrorCode();
  return code != vtkErrorCode::NoError || !reported.empty() ? describe(code, reported) : std::string();
}

void write(vtkXMLWriter* writer, vtkDataObject* data, const std::filesystem::path& path, Compression compression) {
  AtomicFile file(path);
  const std::string failure = try_to_write(writer, data, file.name_for_others(), compression);
  if (!failure.empty()) throw WriteError("cannot write " + path.string() + ": " + failure);
  file.commit();
}

void write_lines(vtkPolyData* lines, double t, const std::filesystem::path& path, Compression compression) {
  set_time(lines, t);
  vtkNew<vtkXMLPolyDataWriter> writer;
  write(writer, lines, path, compression);
}

}  // namespace

std::string frame_file_name(const std::string& kind, std::size_t index, const std::string& extension) {
  return fmt::format("{}_{:06}.{}", kind, index, extension);
}

void write_particles(const std::filesystem::path& path, const ParticleSnapshot& particles, double t,
                     Compression compression) {
  vtkNew<vtkUnstructuredGrid> grid;
  set_points(grid, particles.points, particles.precision);
  vtkNew<vtkTypeInt32Array> connectivity;
  connectivity->SetNumberOfValues(static_cast<vtkIdType>(particles.id.size()));
  for (vtkIdType i = 0; i < connectivity->GetNumberOfValues(); ++i)
    connectivity->SetValue(i, static_cast<vtkTypeInt32>(i));
  grid->SetCells(VTK_VERTEX, make_cells(connectivity, 1));
  add_fields(grid->GetPointData(), particles.fields);
  add<vtkUnsignedCharArray>(grid->GetPointData(), "layer", particles.layer);
  add_numbers(grid->GetPointData(), "material", particles.material);
  add_numbers(grid->GetPointData(), "body", particles.body);
  add<vtkUnsignedIntArray>(grid->GetPointData(), "id", particles.id);
  set_time(grid, t);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  write(writer, grid, path, compression);
}

void write_membranes(const std::filesystem::path& path, const MembraneSnapshot& membranes, double t,
                     Compression compression) {
  const auto lines = make_lines(membranes, membranes.corners);
  add_fields(lines->GetCellData(), membranes.fields);
  add_numbers(lines->GetCellData(), "membrane", membranes.membrane);
  write_lines(lines, t, path, compression);
}

void write_rigid(const std::filesystem::path& path, const RigidSnapshot& rigid, double t, Compression compression) {
  const auto lines = make_lines(rigid);
  add_fields(lines->GetPointData(), rigid.fields);
  add_numbers(lines->GetCellData(), "rigid", rigid.rigid);
  write_lines(lines, t, path, compression);
}

void write_collection(const std::filesystem::path& directory, const std::string& kind, const std::string& extension,
                      const std::vector<double>& times) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (std::size_t i = 0; i < times.size(); ++i)
    text += fmt::format("    <DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n", times[i],
                        frame_file_name(kind, i, extension));
  write_file_atomically(directory / (kind + ".pvd"), text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace geodrop
