#include <gracilis/io/mesh/mesh_writer.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/mesh/vtk_mesh.hpp>
#include <gracilis/io/mesh/vtk_messages.hpp>

#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
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
  write_file_atomically(path, [&](const std::filesystem::path& temporary) {
    VtkMessages messages;
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetFileName(temporary.c_str());
    writer->SetInputData(mesh);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToLZ4();
    writer->SetIdTypeToInt32();
    const bool written = writer->Write() == 1 && writer->GetErrorCode() == vtkErrorCode::NoError;
    if (written && !messages.has_errors()) return;
    const std::string reason = writer->GetErrorCode() != vtkErrorCode::NoError
                                   ? vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode())
                                   : messages.first_error();
    throw InputError({path.string(), "", "cannot be written: " + reason,
                      "check the folder's permissions and the free space of the disk"});
  });
}

}  // namespace gracilis
