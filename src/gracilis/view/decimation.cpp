#include <gracilis/view/decimation.hpp>

#include <gracilis/io/vtk_mesh.hpp>

#include <vtkCellArray.h>
#include <vtkDecimatePro.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <numeric>

namespace gracilis {

/// All of a surface, as if decimated.
static CoarseSurface whole(const TriangleMesh& mesh) {
  CoarseSurface coarse{std::vector<Index>(static_cast<std::size_t>(mesh.vertex_count())), mesh.faces};
  std::iota(coarse.vertices.begin(), coarse.vertices.end(), 0);
  return coarse;
}

CoarseSurface decimate(const TriangleMesh& mesh, Index vertex_count) {
  if (mesh.vertex_count() <= vertex_count || mesh.face_count() == 0) return whole(mesh);
  const vtkSmartPointer<vtkPolyData> input = to_vtk(mesh.vertices, mesh.faces);
  vtkNew<vtkIntArray> numbers;
  numbers->SetName("vertex");
  for (Index v = 0; v < mesh.vertex_count(); ++v) numbers->InsertNextValue(v);
  input->GetPointData()->SetScalars(numbers);

  vtkNew<vtkDecimatePro> decimation;
  decimation->SetInputData(input);
  decimation->SetTargetReduction(1 - static_cast<double>(vertex_count) / mesh.vertex_count());
  decimation->PreserveTopologyOn();
  decimation->SplittingOff();
  decimation->BoundaryVertexDeletionOff();
  decimation->Update();
  vtkPolyData* output = decimation->GetOutput();
  const auto* left = vtkIntArray::SafeDownCast(output->GetPointData()->GetArray("vertex"));
  if (!left || output->GetNumberOfCells() == 0) return whole(mesh);

  CoarseSurface coarse;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i) coarse.vertices.push_back(left->GetValue(i));
  coarse.faces.resize(3, output->GetNumberOfPolys());
  vtkNew<vtkIdList> cell;
  vtkCellArray* polygons = output->GetPolys();
  polygons->InitTraversal();
  for (Index f = 0; polygons->GetNextCell(cell) != 0; ++f)
    for (int k = 0; k < 3; ++k) coarse.faces(k, f) = static_cast<int>(cell->GetId(k));
  return coarse;
}

Points picked(const Points& points, const std::vector<Index>& vertices) {
  Points result(3, static_cast<Index>(vertices.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i) result.col(static_cast<Index>(i)) = points.col(vertices[i]);
  return result;
}

}  // namespace gracilis
