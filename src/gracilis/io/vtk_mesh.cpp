#include <gracilis/io/vtk_mesh.hpp>

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>

#include <algorithm>

namespace gracilis {

vtkSmartPointer<vtkPolyData> to_vtk(const Points& points, const Eigen::Matrix3Xi& faces) {
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(points.cols());
  std::copy(points.data(), points.data() + points.size(), coordinates->GetPointer(0));
  vtkNew<vtkPoints> vtk_points;
  vtk_points->SetData(coordinates);

  // Offsets 0, 3, 6, ... and the face indices as they stand: the layout of VTK's own 32-bit cell arrays.
  vtkNew<vtkTypeInt32Array> offsets;
  offsets->SetNumberOfValues(faces.cols() + 1);
  for (Eigen::Index i = 0; i <= faces.cols(); ++i) offsets->SetValue(i, static_cast<vtkTypeInt32>(3 * i));
  vtkNew<vtkTypeInt32Array> indices;
  indices->SetNumberOfValues(faces.size());
  std::copy(faces.data(), faces.data() + faces.size(), indices->GetPointer(0));
  vtkNew<vtkCellArray> triangles;
  triangles->SetData(offsets, indices);

  const auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(vtk_points);
  mesh->SetPolys(triangles);
  return mesh;
}

}  // namespace gracilis
