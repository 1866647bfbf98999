#pragma once

#include <gracilis/io/run/run_folder.hpp>

#include <Eigen/Geometry>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace gracilis {

inline TriangleMesh tetrahedron(const Vec3& offset) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, 4);
  mesh.vertices << 0, 0.1, 0, 0, 0, 0, 1.0 / 3, 0, 0, 0, 0, 0.1;
  mesh.vertices.colwise() += offset;
  mesh.faces.resize(3, 4);
  mesh.faces << 0, 0, 1, 2, 2, 1, 2, 0, 1, 3, 3, 3;
  return mesh;
}

/// One muscle and one bone, which turns about z.
struct TinyRun {
  Scene scene;
  std::vector<Pose> poses;

  TinyRun() {
    scene.name = "tiny";
    scene.bodies = {"ground", "leg"};
    scene.bones = {{"femur_r", 1, tetrahedron(Vec3(1, 0, 0))}};
    scene.muscles.resize(1);
    scene.muscles[0].name = "gluteus_maximus_r";
    scene.muscles[0].surface = tetrahedron(Vec3::Zero());
    Joint hip;
    hip.axes.resize(1);
    hip.axes[0].coordinate = "hip_flexion_r";
    scene.joints = {hip};
    for (int i = 0; i < 5; ++i) {
      const RigidTransform turn(Eigen::AngleAxisd(0.5 * i, Vec3::UnitZ()));
      poses.push_back({0.1 * i, {radians(10 * i)}, {RigidTransform::Identity(), turn}, {}});
    }
  }

  FrameRecord record(int number) const {
    FrameRecord result;
    result.frame.number = number;
    result.frame.pose = poses[static_cast<std::size_t>(number)];
    result.frame.muscles.resize(1);
    result.frame.muscles[0].points = scene.muscles[0].surface.vertices * (1 + 0.1 * number);
    result.measures.resize(1);
    result.measures[0].volume_ratio = 1 + 0.001 * number;
    return result;
  }
};

/// The whole file; empty where there is none.
inline std::string content(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace gracilis
