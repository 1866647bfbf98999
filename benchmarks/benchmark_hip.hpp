#pragma once

#include <gracilis/anatomy/builtin/builtin_hip.hpp>
#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/io/scene/data_root.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/strings/bone_distances.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// A hip with all that its muscles need: the cadaver's where its data are (GRACILIS_DATA, or ../shared/data beside the
/// checkout), otherwise the built-in one.
struct BenchmarkHip {
  Scene scene;
  std::vector<DistanceField> fields, far_fields;
  strings::BoneDistances bones;  ///< of the fields that reach far

  /// The hip flexed by so much, rad.
  Pose flexed(Real angle) const {
    std::vector<Real> values = capture_coordinates(scene);
    const std::vector<std::string> names = coordinate_names(scene);
    const auto flexion = std::find(names.begin(), names.end(), "hip_flexion_r") - names.begin();
    values.at(static_cast<std::size_t>(flexion)) = angle;
    return pose_at(scene, values);
  }
};

inline std::filesystem::path cadaver_scene_file() {
  return std::filesystem::path(GRACILIS_SOURCE_DIR) / "scenes" / "lhdl_hip" / "flexion.toml";
}

inline bool cadaver_is_there() {
  const std::filesystem::path data = find_data_root(cadaver_scene_file(), {});
  return !data.empty() && std::filesystem::is_directory(data / "lhdl-hip");
}

inline BenchmarkHip with_fields(Scene scene) {
  BenchmarkHip hip{std::move(scene), {}, {}, {}};
  hip.fields = cached_bone_fields(hip.scene);
  hip.far_fields = cached_bone_fields(hip.scene, strings::far_field_settings());
  hip.bones = strings::bone_distances(hip.scene, hip.far_fields);
  return hip;
}

inline const BenchmarkHip& builtin_benchmark_hip() {
  static const BenchmarkHip hip = with_fields(builtin_hip());
  return hip;
}

inline const BenchmarkHip& benchmark_hip() {
  if (!cadaver_is_there()) return builtin_benchmark_hip();
  SceneOptions options;
  options.data = find_data_root(cadaver_scene_file(), {});
  options.only = {"gluteus_maximus_r", "gluteus_medius_r", "iliacus_r", "psoas_major_r"};
  static const BenchmarkHip hip = with_fields(read_scene(cadaver_scene_file(), options).scene);
  return hip;
}

}  // namespace gracilis
