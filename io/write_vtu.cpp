#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <array>
#include <string>

#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/geometry/dihedral.h"
#include "cavea/geometry/quality.h"
#include "cavea/io/formats.h"
#include "cavea/io/output_file.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {
namespace {

/// An array of n numbers, value(i) each.
template <class Array, class Value>
vtkNew<Array> make_array(const char* name, std::size_t n, Value&& value) {
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(n));
  auto* to = array->GetPointer(0);
  parallel_for(n, [&](std::size_t i) { to[i] = value(i); });
  return array;
}

void set_points(vtkUnstructuredGrid& grid, const MeshData& data) {
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(static_cast<vtkIdType>(data.vertices.size()));
  double* to = coordinates->GetPointer(0);
  parallel_for(data.vertices.size(), [&](std::size_t v) {
    for (int k = 0; k < 3; ++k) to[3 * v + k] = data.vertices[v][k];
  });
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  grid.SetPoints(points);
}

void set_cells(vtkUnstructuredGrid& grid, const MeshData& data) {
  const std::size_t n = data.tets.size();
  const auto offsets = make_array<vtkTypeInt32Array>(
      "offsets", n + 1, [](std::size_t t) { return static_cast<vtkTypeInt32>(4 * t); });
  const auto corners = make_array<vtkTypeInt32Array>(
      "connectivity", 4 * n, [&](std::size_t i) { return data.tets[i / 4][i % 4]; });
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, corners);
  grid.SetCells(VTK_TETRA, cells);
}

std::array<Vec3, 4> corners(const MeshData& data, std::size_t t) {
  const auto& [a, b, c, d] = data.tets[t];
  return {data.vertices[a], data.vertices[b], data.vertices[c], data.vertices[d]};
}

float quality(const std::array<Vec3, 4>& p) {
  return static_cast<float>(tet_quality(p[0], p[1], p[2], p[3]));
}

float smallest_dihedral(const std::array<Vec3, 4>& p) {
  double smallest = 180;
  for (const auto& e : kEdgeVertices)
    smallest = std::min(smallest, dihedral(p[e[0]], p[e[1]], p[e[2]], p[e[3]]));
  return static_cast<float>(smallest);
}

void add_arrays(vtkUnstructuredGrid& grid, const MeshData& data) {
  const std::size_t n = data.tets.size();
  vtkCellData& cells = *grid.GetCellData();
  cells.AddArray(make_array<vtkIntArray>(
      "reference", n, [&](std::size_t t) { return data.tet_refs.empty() ? 0 : data.tet_refs[t]; }));
  cells.AddArray(make_array<vtkFloatArray>(
      "quality", n, [&](std::size_t t) { return quality(corners(data, t)); }));
  cells.AddArray(make_array<vtkFloatArray>("minimum_dihedral_angle", n, [&](std::size_t t) {
    return smallest_dihedral(corners(data, t));
  }));
  if (!data.parts.empty())
    cells.AddArray(
        make_array<vtkIntArray>("part", n, [&](std::size_t t) { return data.parts[t]; }));
  if (!data.sizes.empty())
    grid.GetPointData()->AddArray(make_array<vtkDoubleArray>(
        "size", data.sizes.size(), [&](std::size_t v) { return data.sizes[v]; }));
}

/// Keeps what VTK would print.
void keep_message(vtkObject*, unsigned long, void* kept, void* message) {
  if (message) *static_cast<std::string*>(kept) = static_cast<const char*>(message);
}

}  // namespace

/// What the module is asked for. \throw OutputError
extern "C" void cavea_write_vtu(OutputFile& file, const MeshData& data) {
  // VTK counts with 32 bits here: the corners of more tets would not fit.
  if (data.tets.size() > std::size_t{VTK_INT_MAX} / 4)
    throw OutputError(fmt::format("{}: {} tetrahedra are too many for this format",
                                  file.target().string(), data.tets.size()));
  vtkNew<vtkUnstructuredGrid> grid;
  set_points(*grid, data);
  set_cells(*grid, data);
  add_arrays(*grid, data);

  std::string message;
  vtkNew<vtkCallbackCommand> on_error;
  on_error->SetCallback(keep_message);
  on_error->SetClientData(&message);
  vtkNew<vtkZLibDataCompressor> compressor;
  compressor->SetCompressionLevel(1);  // higher levels take several times as long for a tenth less
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  // Whoever in VTK has an observer tells that one instead of printing.
  for (vtkObject* speaker :
       {static_cast<vtkObject*>(writer.Get()), static_cast<vtkObject*>(writer->GetExecutive())}) {
    speaker->AddObserver(vtkCommand::ErrorEvent, on_error);
    speaker->AddObserver(vtkCommand::WarningEvent, on_error);
  }
  writer->SetInputData(grid);
  writer->SetFileName(file.temporary().c_str());
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetIdTypeToInt32();
  writer->SetCompressor(compressor);
  if (!writer->Write() || writer->GetErrorCode() != vtkErrorCode::NoError)
    throw OutputError(fmt::format(
        "{}: cannot be written: {}", file.target().string(),
        message.empty() ? vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()) : message));
}

}  // namespace cavea
