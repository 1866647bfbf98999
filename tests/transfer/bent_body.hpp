#pragma once

#include <gracilis/anatomy/builtin/builtin_hip.hpp>
#include <gracilis/geometry/decimation.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/scene/scene.hpp>

#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace gracilis {

/// The built-in hip with a few of its muscles, made once.
inline const Scene& small_hip() {
  static const Scene scene = [] {
    Scene all = builtin_hip();
    std::vector<Muscle> kept;
    for (Muscle& muscle : all.muscles)
      if (muscle.name == "adductor_longus_r" || muscle.name == "iliacus_r") kept.push_back(std::move(muscle));
    all.muscles = std::move(kept);
    std::erase_if(all.bones, [](const Bone& bone) { return bone.name == "hip_bone_l"; });
    return all;
  }();
  return scene;
}

/// Somebody else: longer one way, narrower another, bent, and lying elsewhere.
inline Vec3 bent(const Vec3& p) {
  const Vec3 stretched(1.07 * p.x() + 0.35 * p.y() * p.y(), 0.95 * p.y(), 1.03 * p.z() + 0.25 * p.x() * p.y());
  return Eigen::AngleAxisd(0.15, Vec3(1, 2, 0.5).normalized()) * stretched + Vec3(0.3, -0.2, 0.1);
}

/// Bones of a scene in a folder under other names and with other triangles, placed.
inline void write_bones(const std::filesystem::path& folder, const Scene& scene,
                        const std::map<std::string, std::string>& files, const std::function<Vec3(const Vec3&)>& placed,
                        bool mirrored = false) {
  std::filesystem::create_directories(folder);
  for (const Bone& bone : scene.bones) {
    const auto file = files.find(bone.name);
    if (file == files.end()) continue;
    const CoarseSurface coarse = decimate(bone.surface, bone.surface.vertex_count() * 2 / 3);
    Points points = picked(bone.surface.vertices, coarse.vertices);
    for (auto point : points.colwise()) point = placed(point);
    Eigen::Matrix3Xi faces = coarse.faces;
    if (mirrored) faces.row(1).swap(faces.row(2));
    write_surface(folder / file->second, points, faces);
  }
}

}  // namespace gracilis
