#pragma once

#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/scene/scene.hpp>

#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace gracilis {

/// Writes a scene's bones and muscles into a folder, under other names: those without one in `names` are left out.
inline void write_body(const std::filesystem::path& folder, const Scene& scene,
                       const std::map<std::string, std::string>& names, Real unit = 1,
                       const std::function<Vec3(const Vec3&)>& placed = {}, bool mirrored = false) {
  const auto write = [&](const std::string& name, const TriangleMesh& mesh) {
    const auto found = names.find(name);
    if (found == names.end()) return;
    Points points = mesh.vertices;
    if (placed)
      for (auto point : points.colwise()) point = placed(point);
    Eigen::Matrix3Xi faces = mesh.faces;
    if (mirrored) faces.row(1).swap(faces.row(2));
    const std::filesystem::path file = folder / found->second;
    std::filesystem::create_directories(file.parent_path());
    write_surface(file, points / unit, faces);
  };
  for (const Bone& bone : scene.bones) write(bone.name, bone.surface);
  for (const Muscle& muscle : scene.muscles) write(muscle.name, muscle.surface);
}

}  // namespace gracilis
