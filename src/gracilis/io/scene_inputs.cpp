#include <gracilis/core/errors.hpp>
#include <gracilis/io/scene_inputs.hpp>

#include <vtkCell.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>

#include <fstream>
#include <sstream>
#include <vector>

namespace gracilis {

std::string read_scene_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  if (!file) throw InputError({path.string(), "", "cannot be read", ""});
  return text.str();
}

TriangleMesh read_scene_surface(const std::filesystem::path& path, Real unit) {
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  if (data->GetNumberOfCells() == 0) throw InputError({path.string(), "", "holds no triangles", ""});
  TriangleMesh mesh{Points(3, data->GetNumberOfPoints()), Eigen::Matrix3Xi(3, data->GetNumberOfCells())};
  for (Index i = 0; i < mesh.vertex_count(); ++i) mesh.vertices.col(i) = Vec3(data->GetPoint(i)) * unit;
  for (Index i = 0; i < mesh.face_count(); ++i)
    for (int k = 0; k < 3; ++k) mesh.faces(k, i) = static_cast<Index>(data->GetCell(i)->GetPointId(k));
  return mesh;
}

std::map<std::string, Points> read_scene_landmarks(const std::filesystem::path& path, Real unit) {
  std::istringstream text(read_scene_text(path));
  std::map<std::string, std::vector<Vec3>> clouds;
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line)) {
    std::istringstream row(line);
    std::string cloud, index, x, y, z;
    std::getline(row, cloud, ',');
    std::getline(row, index, ',');
    std::getline(row, x, ',');
    std::getline(row, y, ',');
    std::getline(row, z, ',');
    clouds[cloud].push_back(Vec3(std::stod(x), std::stod(y), std::stod(z)) * unit);
  }
  std::map<std::string, Points> result;
  for (const auto& [name, points] : clouds) {
    Points& columns = result[name];
    columns.resize(3, static_cast<Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) columns.col(i) = points[i];
  }
  return result;
}

Motion read_scene_motion(const std::filesystem::path& path) {
  throw InputError({path.string(), "", "motion tables cannot be read yet", "use 'key_poses_deg'"});
}

}  // namespace gracilis
