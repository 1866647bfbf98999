#include <gracilis/io/mesh_reader.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/vtk_messages.hpp>

#include <fmt/format.h>

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <array>
#include <limits>
#include <new>

namespace gracilis {

namespace fs = std::filesystem;

[[noreturn]] static void fail(const fs::path& path, const std::string& where, const std::string& what,
                              const std::string& remedy = "export the surface again") {
  throw InputError({path.string(), where, what, remedy});
}

template <typename Reader>
static vtkSmartPointer<vtkPolyData> output_of(const fs::path& path) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// Runs the reader for the file's extension; every complaint of VTK becomes an InputError.
static vtkSmartPointer<vtkPolyData> read_with_vtk(const fs::path& path) {
  const std::string extension = lower_case_extension(path);
  VtkMessages messages;
  vtkSmartPointer<vtkPolyData> data;
  try {
    if (extension == ".ply") {
      data = output_of<vtkPLYReader>(path);
    } else if (extension == ".stl") {
      data = output_of<vtkSTLReader>(path);
    } else if (extension == ".obj") {
      data = output_of<vtkOBJReader>(path);
    } else if (extension == ".vtk") {
      data = output_of<vtkPolyDataReader>(path);
    } else if (extension == ".vtp") {
      data = output_of<vtkXMLPolyDataReader>(path);
    } else {
      fail(path, "", fmt::format("'{}' is not a mesh format that can be read", extension),
           "use .ply, .stl, .obj, .vtk or .vtp");
    }
  } catch (const std::bad_alloc&) {
    fail(path, "", "announces more data than memory can hold: the file is damaged");
  } catch (const std::length_error&) {
    fail(path, "", "announces more data than memory can hold: the file is damaged");
  }
  if (messages.has_errors()) fail(path, "", "is damaged or not of its kind: " + messages.first_error());
  if (!data || !data->GetPoints() || data->GetNumberOfPoints() == 0) {
    fail(path, "", "holds no vertices" + (messages.first_warning().empty() ? "" : ": " + messages.first_warning()));
  }
  return data;
}

/// Indices beyond the vertices would make VTK's own filters read foreign memory: found before anything else runs.
static void require_valid_indices(const fs::path& path, vtkPolyData& data) {
  const vtkIdType point_count = data.GetNumberOfPoints();
  for (vtkCellArray* cells : {data.GetPolys(), data.GetStrips()}) {
    const auto cell = vtk::TakeSmartPointer(cells->NewIterator());
    for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell()) {
      vtkIdType size = 0;
      const vtkIdType* corners = nullptr;
      cell->GetCurrentCell(size, corners);
      for (vtkIdType i = 0; i < size; ++i) {
        if (corners[i] >= 0 && corners[i] < point_count) continue;
        fail(path, fmt::format("face {}", cell->GetCurrentCellId()),
             fmt::format("names vertex {}, but the vertices go from 0 to {}", corners[i], point_count - 1));
      }
    }
  }
}

static bool only_triangles(vtkPolyData& data) {
  return data.GetStrips()->GetNumberOfCells() == 0 && data.GetPolys()->IsHomogeneous() == 3;
}

static vtkSmartPointer<vtkPolyData> triangulated(vtkPolyData& data) {
  if (only_triangles(data)) return &data;
  vtkNew<vtkTriangleFilter> filter;
  filter->SetInputData(&data);
  filter->PassLinesOff();
  filter->PassVertsOff();
  filter->Update();
  return filter->GetOutput();
}

static TriangleMesh to_mesh(vtkPolyData& data, Real unit) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, data.GetNumberOfPoints());
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
    data.GetPoint(i, mesh.vertices.col(i).data());
    mesh.vertices.col(i) *= unit;
  }
  vtkCellArray* triangles = data.GetPolys();
  mesh.faces.resize(3, triangles->GetNumberOfCells());
  for (vtkIdType i = 0; i < triangles->GetNumberOfCells(); ++i) {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    triangles->GetCellAtId(i, size, corners);
    for (int k = 0; k < 3; ++k) mesh.faces(k, i) = static_cast<Index>(corners[k]);
  }
  return mesh;
}

TriangleMesh read_mesh(const fs::path& path, Real unit) {
  require_readable_file(path);
  const vtkSmartPointer<vtkPolyData> data = read_with_vtk(path);
  require_valid_indices(path, *data);
  VtkMessages messages;  // a polygon that cannot be cut is left out; the inspection then sees the hole
  const vtkSmartPointer<vtkPolyData> triangles = triangulated(*data);
  if (triangles->GetNumberOfPolys() == 0) {
    fail(path, "", data->GetNumberOfLines() > 0 ? "holds lines but no surface" : "holds vertices but no triangle",
         "export a triangle surface");
  }
  if (triangles->GetNumberOfPoints() > std::numeric_limits<Index>::max() / 3 ||
      triangles->GetNumberOfPolys() > std::numeric_limits<Index>::max() / 3) {
    fail(path, "", "has too many vertices or triangles", "decimate the surface");
  }
  return to_mesh(*triangles, unit);
}

}  // namespace gracilis
