#pragma once

#include <gracilis/anatomy/builtin_hip.hpp>
#include <gracilis/anatomy/joint_pose.hpp>
#include <gracilis/io/data_root.hpp>
#include <gracilis/io/field_cache.hpp>
#include <gracilis/io/scene_reader.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// A hip with all that its muscles need: the cadaver's where its data are (GRACILIS_DATA, or ../shared/data beside the
/// checkout), otherwise the built-in one.
struct BenchmarkHip {
  Scene scene;
  std::vector<DistanceField> fields;

  /// The hip flexed by so much, rad.
  Pose flexed(Real angle) const {
    std::vector<Real> values = capture_coordinates(scene);
    const std::vector<std::string> names = coordinate_names(scene);
    const auto flexion = std::find(names.begin(), names.end(), "hip_flexion_r") - names.begin();
    values.at(static_cast<std::size_t>(flexion)) = angle;
    return pose_at(scene, values);
  }
};

inline Scene benchmark_scene() {
  const std::filesystem::path file =
      std::filesystem::path(GRACILIS_SOURCE_DIR) / "scenes" / "lhdl_hip" / "flexion.toml";
  const std::filesystem::path data = find_data_root(file, {});
  if (data.empty() || !std::filesystem::is_directory(data / "lhdl-hip")) return builtin_hip();
  return read_scene(file, {data, {}, {}}).scene;
}

inline const BenchmarkHip& benchmark_hip() {
  static const BenchmarkHip hip = [] {
    BenchmarkHip h{benchmark_scene(), {}};
    for (const Bone& bone : h.scene.bones)
      h.fields.push_back(cached_bone_field(bone, h.scene.distance_fields, default_cache_folder()));
    return h;
  }();
  return hip;
}

}  // namespace gracilis
