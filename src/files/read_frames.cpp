#include "read_frames.hpp"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <geodrop/base/error.hpp>
#include <geodrop/base/input_file.hpp>
#include <string>

#include "run_record.hpp"
#include "vtk_files.hpp"

namespace geodrop {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& found) {
  throw SceneError(file.string(), {{{}, "", found, "the frames of a run", ProblemSource::elsewhere}});
}

/// Whole numbers with a meaning of their own; all other arrays are fields.
constexpr std::array whole_numbers = {"layer", "material", "body", "id", "membrane", "rigid"};

template <class T>
void copy(vtkFieldData* from, const char* name, std::vector<T>& to) {
  vtkDataArray* const array = from->GetArray(name);
  if (!array) return;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) to.push_back(static_cast<T>(array->GetTuple1(i)));
}

std::vector<Field> fields_of(vtkFieldData* data) {
  std::vector<Field> fields;
  for (int a = 0; a < data->GetNumberOfArrays(); ++a) {
    vtkDataArray* const array = data->GetArray(a);
    if (!array || !array->GetName() ||
        std::ranges::find(whole_numbers, std::string(array->GetName())) != whole_numbers.end())
      continue;
    Field field{array->GetName(), {}, {}};
    const int width = array->GetNumberOfComponents();
    for (int c = 0; c < width && width > 1; ++c) {
      const char* const name = array->GetComponentName(c);
      field.components.emplace_back(name ? name : std::to_string(c));
    }
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
      for (int c = 0; c < width; ++c) field.values.push_back(static_cast<float>(array->GetComponent(i, c)));
    fields.push_back(std::move(field));
  }
  return fields;
}

std::vector<double> points_of(vtkPointSet* data) {
  std::vector<double> points;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
    points.insert(points.end(), data->GetPoint(i), data->GetPoint(i) + 3);
  return points;
}

template <class Reader>
void read(Reader* reader, const fs::path& file) {
  if (const std::string fault = open_input(file).fault; !fault.empty()) refuse(file, fault);
  bool failed = false;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&failed);
  observer->SetCallback([](vtkObject*, unsigned long, void* flag, void*) { *static_cast<bool*>(flag) = true; });
  // Of the file, of its syntax, of the pipeline around: none of them is to be told on stderr.
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->SetReaderErrorObserver(observer);
  reader->SetParserErrorObserver(observer);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->SetFileName(file.c_str());
  reader->Update();
  if (failed || reader->GetErrorCode() != 0) refuse(file, "a file that is damaged");
}

double time_of(vtkDataObject* data) {
  vtkDataArray* const time = data->GetFieldData()->GetArray("TimeValue");
  return time && time->GetNumberOfTuples() > 0 ? time->GetTuple1(0) : 0;
}

/// Lines, or triangles, of a file that is there; none if it is not. How many corners each has, 2 or 3.
template <class LineSnapshot>
int read_lines(const fs::path& file, LineSnapshot& to, const char* number, std::vector<std::uint32_t>& numbers) {
  if (!fs::exists(file)) return 2;
  vtkNew<vtkXMLPolyDataReader> reader;
  read(reader.Get(), file);
  vtkPolyData* const data = reader->GetOutput();
  to.points = points_of(data);
  const bool are_triangles = data->GetNumberOfPolys() > 0;
  vtkCellArray* const cells = are_triangles ? data->GetPolys() : data->GetLines();
  vtkIdType count = 0;
  const vtkIdType* nodes = nullptr;
  for (cells->InitTraversal(); cells->GetNextCell(count, nodes);)
    for (vtkIdType k = 0; k < count; ++k) to.connectivity.push_back(static_cast<std::uint32_t>(nodes[k]));
  to.fields = fields_of(data->GetCellData());
  copy(data->GetCellData(), number, numbers);
  return are_triangles ? 3 : 2;
}

}  // namespace

std::vector<double> frame_times(const fs::path& directory) {
  const fs::path file = directory / "particles.pvd";
  if (!fs::exists(file))
    if (const auto record = find_run_record(directory))
      refuse(directory, record->is_running() ? "a run without a frame so far: at work, or killed before its first one"
                                             : "a run without frames");
  const std::string text = read_input(file, "", "the frames of a run"), mark = "timestep=\"";
  std::vector<double> times;
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1))
    times.push_back(std::strtod(text.c_str() + at + mark.size(), nullptr));
  if (times.empty()) refuse(file, "no frame");
  return times;
}

std::size_t frame_near(const std::vector<double>& times, double t) {
  const auto nearest = std::ranges::min_element(times, {}, [t](double time) { return std::abs(time - t); });
  return static_cast<std::size_t>(nearest - times.begin());
}

Snapshot read_frame(const fs::path& directory, std::size_t index) {
  const auto path = [&](const char* kind, const char* extension) {
    return directory / frame_file_name(kind, index, extension);
  };
  Snapshot snapshot;
  snapshot.index = index;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  read(reader.Get(), path("particles", "vtu"));
  vtkUnstructuredGrid* const data = reader->GetOutput();
  snapshot.t = time_of(data);
  snapshot.particles.points = points_of(data);
  snapshot.particles.fields = fields_of(data->GetPointData());
  copy(data->GetPointData(), "layer", snapshot.particles.layer);
  copy(data->GetPointData(), "material", snapshot.particles.material);
  copy(data->GetPointData(), "body", snapshot.particles.body);
  copy(data->GetPointData(), "id", snapshot.particles.id);
  snapshot.membranes.corners =
      read_lines(path("membranes", "vtp"), snapshot.membranes, "membrane", snapshot.membranes.membrane);
  snapshot.has_rigid = fs::exists(path("rigid", "vtp"));
  read_lines(path("rigid", "vtp"), snapshot.rigid, "rigid", snapshot.rigid.rigid);
  return snapshot;
}

}  // namespace geodrop
