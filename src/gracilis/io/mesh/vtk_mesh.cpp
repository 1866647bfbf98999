#include <gracilis/io/mesh/vtk_mesh.hpp>

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>

#include <algorithm>

namespace gracilis {

static vtkSmartPointer<vtkPoints> to_vtk_points(const Points& points) {
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(points.cols());
  std::copy(points.data(), points.data() + points.size(), coordinates->GetPointer(0));
  auto vtk_points = vtkSmartPointer<vtkPoints>::New();
  vtk_points->SetData(coordinates);
  return vtk_points;
}

vtkSmartPointer<vtkPolyData> to_vtk(const Polylines& lines) {
  vtkNew<vtkTypeInt32Array> offsets, indices;
  for (const Index offset : lines.offsets) offsets->InsertNextValue(offset);
  for (Eigen::Index i = 0; i < lines.points.cols(); ++i) indices->InsertNextValue(static_cast<vtkTypeInt32>(i));
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, indices);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(to_vtk_points(lines.points));
  data->SetLines(cells);
  return data;
}

vtkSmartPointer<vtkPolyData> to_vtk(const Points& points, const Eigen::Matrix3Xi& faces) {
  // Offsets 0, 3, 6, ... and the face indices as they stand: the layout of VTK's own 32-bit cell arrays.
  vtkNew<vtkTypeInt32Array> offsets;
  offsets->SetNumberOfValues(faces.cols() + 1);
  for (Eigen::Index i = 0; i <= faces.cols(); ++i) offsets->SetValue(i, static_cast<vtkTypeInt32>(3 * i));
  vtkNew<vtkTypeInt32Array> indices;
  indices->SetNumberOfValues(faces.size());
  std::copy(faces.data(), faces.data() + faces.size(), indices->GetPointer(0));
  vtkNew<vtkCellArray> triangles;
  triangles->SetData(offsets, indices);

  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(to_vtk_points(points));
  mesh->SetPolys(triangles);
  return mesh;
}

}  // namespace gracilis
