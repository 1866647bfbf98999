#include <gracilis/io/mesh/mesh_writer.hpp>

#include <gracilis/io/mesh/vtk_mesh.hpp>
#include <gracilis/io/mesh/vtk_writing.hpp>

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

namespace gracilis {

static void add_array(const VertexArray& values, vtkPolyData& mesh) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(values.name.c_str());
  array->SetNumberOfComponents(values.components);
  array->SetNumberOfTuples(values.values.size() / values.components);
  std::copy(values.values.data(), values.values.data() + values.values.size(), array->GetPointer(0));
  mesh.GetPointData()->AddArray(array);
}

void write_surface(const std::filesystem::path& path, const Points& points, const Eigen::Matrix3Xi& faces,
                   const std::vector<VertexArray>& arrays) {
  const vtkSmartPointer<vtkPolyData> mesh = to_vtk(points, faces);
  for (const VertexArray& each : arrays) add_array(each, *mesh);
  vtkNew<vtkXMLPolyDataWriter> writer;
  write_by_vtk(path, *writer, *mesh);
}

}  // namespace gracilis
