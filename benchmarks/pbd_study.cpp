#include "benchmark_hip.hpp"

#include <gracilis/anatomy/overlap/bone_field.hpp>
#include <gracilis/anatomy/overlap/bone_projection.hpp>
#include <gracilis/anatomy/overlap/voxel_projection.hpp>
#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/scene/motion.hpp>
#include <gracilis/simulate/measures.hpp>
#include <gracilis/view/comparison/comparison_rows.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

/// What bones as voxels or distance fields and the predictor 'arap' cost and give, on the built-in hip or, with the
/// argument 'cadaver', on the cadaver's: prints Markdown tables for docs/position-based-dynamics.md. Flexion to 60
/// degrees, 1 degree per frame; of each the worst muscle in the worst of the frames looked at, every tenth. Times are
/// those of the processor.
namespace gracilis {

namespace {

constexpr int frames_between_looks = 10;

Real milliseconds_since(std::clock_t started) {
  return 1000 * static_cast<Real>(std::clock() - started) / CLOCKS_PER_SEC;
}

Scene studied_scene(bool cadaver) {
  Scene scene;
  if (cadaver) {
    SceneOptions options;
    options.data = find_data_root(cadaver_scene_file(), {});
    scene = read_scene(cadaver_scene_file(), options).scene;
  } else {
    scene = builtin_hip();
  }
  Eigen::MatrixXd keys(1, 1);
  keys << radians(60);
  scene.motion = motion_through({"hip_flexion_r"}, keys, radians(1), usual_time_step);
  scene.sequence = {};
  return scene;
}

const std::vector<DistanceField>& fields_of(const Scene& scene) {
  static const std::vector<DistanceField> fields = [&] {
    std::vector<DistanceField> built;
    for (const Bone& bone : scene.bones) built.push_back(build_bone_field(bone, scene.distance_fields));
    return built;
  }();
  return fields;
}

/// Asks about every vertex of all muscles, as often; ns for one about all bones.
template <class Projection>
Real nanoseconds_per_vertex(const Scene& scene, const std::vector<Projection>& projections) {
  constexpr int repeats = 20;
  const Pose pose = capture_pose(scene.bodies.size());
  std::vector<Points> points;
  Real asked = 0;
  for (const Muscle& muscle : scene.muscles)
    points.push_back(muscle.surface.vertices), asked += muscle.surface.vertex_count();
  const std::clock_t started = std::clock();
  for (int i = 0; i < repeats; ++i)
    for (std::size_t m = 0; m < points.size(); ++m)
      projections[m].take_back(pose, scene.muscles[m].surface.vertices, points[m]);
  return 1e6 * milliseconds_since(started) / (repeats * asked);
}

std::vector<Index> all_free(const Muscle& muscle) {
  return std::vector<Index>(static_cast<std::size_t>(muscle.surface.vertex_count()), -1);
}

void costs(const Scene& scene) {
  fmt::print("\n| bones as | prepared in | memory | a vertex against all bones |\n| --- | --- | --- | --- |\n");
  {
    const std::clock_t started = std::clock();
    const std::vector<DistanceField>& fields = fields_of(scene);
    const Real built = milliseconds_since(started);
    std::size_t bytes = 0;
    for (const DistanceField& field : fields) bytes += field.values.size() * sizeof(float);
    std::vector<BoneProjection> projections;
    for (const Muscle& muscle : scene.muscles)
      projections.emplace_back(scene, muscle, all_free(muscle), fields, 0.0005, true);
    fmt::print("| fields, {:.1f} mm | {:.0f} ms | {:.1f} MB | {:.0f} ns |\n", 1000 * scene.distance_fields.cell_size,
               built, static_cast<Real>(bytes) / 1e6, nanoseconds_per_vertex(scene, projections));
  }
  for (const int boxes : {32, 64, 128, 256, 512}) {
    const std::clock_t started = std::clock();
    const BoneVoxels voxels = bone_voxels(scene, boxes);
    const Real built = milliseconds_since(started);
    std::size_t bytes = 0;
    Real largest = 0;
    for (const VoxelSolid& solid : *voxels) {
      bytes += solid.bytes();
      largest = std::max(largest, solid.box_size().maxCoeff());
    }
    std::vector<VoxelProjection> projections;
    for (const Muscle& muscle : scene.muscles) projections.emplace_back(scene, muscle, all_free(muscle), voxels, true);
    fmt::print("| {0} × {0} × {0} voxels, up to {1:.1f} mm long | {2:.0f} ms | {3:.1f} MB | {4:.0f} ns |\n", boxes,
               1000 * largest, built, static_cast<Real>(bytes) / 1e6, nanoseconds_per_vertex(scene, projections));
  }
}

/// The worst of all muscles in all frames looked at.
struct Worst {
  Real volume = 0, edges = 0, free_edge = 0, angles = 0, vertex = 0, midpoint = 0;
  Index dihedrals = 0, cuts = 0;
};

void look(const Scene& scene, Measurer& measurer, const Frame& frame, Worst& worst) {
  const std::vector<MuscleMeasures> measured = measurer.measure(frame);
  for (std::size_t m = 0; m < measured.size(); ++m) {
    const MuscleMeasures& now = measured[m];
    worst.volume = std::max(worst.volume, std::abs(now.volume_ratio - 1));
    worst.edges = std::max(worst.edges, std::abs(now.edge_ratio_mean - 1));
    worst.free_edge = std::max(worst.free_edge, now.edge_ratio_max_free);
    worst.angles = std::max(worst.angles, now.dihedral_change_mean);
    worst.dihedrals = std::max(worst.dihedrals, now.dihedrals_over_90);
    worst.vertex = std::max(worst.vertex, now.vertex_depth_beyond_rest);
    worst.midpoint = std::max(worst.midpoint, now.midpoint_depth_beyond_rest);
    worst.cuts = std::max(worst.cuts, new_self_intersections(scene.muscles[m].surface, frame.muscles[m].points));
  }
}

void row(Scene scene, const std::string& name, const std::string& method, const SettingValues& settings) {
  scene.method = {method, settings};
  for (Muscle& muscle : scene.muscles) muscle.settings.clear();
  const auto deforming = make_method(scene, [&](const DistanceFieldSettings& asked) {
    if (asked.cell_size == scene.distance_fields.cell_size) return fields_of(scene);
    std::vector<DistanceField> built;
    for (const Bone& bone : scene.bones) built.push_back(build_bone_field(bone, asked));
    return built;
  });
  Measurer measurer(scene);
  Worst worst;
  Real milliseconds = 0;
  int frames = 0;
  try {
    Frame frame;
    for (const Pose& pose : pose_sequence(scene)) {
      const std::clock_t started = std::clock();
      deforming->advance(pose, usual_time_step);
      milliseconds += milliseconds_since(started);
      frame.number = frames++;
      frame.pose = pose;
      deforming->write(frame);
      if (frame.number % frames_between_looks == 0) look(scene, measurer, frame, worst);
    }
  } catch (const QualityError& error) {
    fmt::print("| {} | {} |\n", name, error.what());
    return;
  }
  fmt::print("| {} | {:.0f} ms | {:.2f} % | {:.1f} % | {:.1f} | {:.1f}° | {} | {:.2f} mm, {:.2f} mm | {} |\n", name,
             milliseconds / frames, 100 * worst.volume, 100 * worst.edges, worst.free_edge, degrees(worst.angles),
             worst.dihedrals, 1000 * worst.vertex, 1000 * worst.midpoint, worst.cuts);
  std::fflush(stdout);
}

void head() {
  fmt::print(
      "\n| | time per frame, all muscles | error of volume | mean change of edges | longest free edge over rest | mean "
      "change of angles | dihedrals turned by more than 90° | vertex, edge midpoint in a bone | pairs of triangles "
      "that "
      "cut each other |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
}

SettingValues with(SettingValues settings, const SettingValues& changes) {
  for (const auto& [key, value] : changes) settings[key] = value;
  return settings;
}

void collisions(const Scene& scene) {
  head();
  const SettingValues voxels = {{"collision", "voxels"}}, entry = {{"push_back", "entry"}};
  const SettingValues published = find_preset("pbd-2020")->method.settings;
  row(scene, "`pbd`: fields, shortest way", "pbd", {});
  row(scene, "fields, way of entry", "pbd", entry);
  row(scene, "64 voxels, shortest way", "pbd", voxels);
  row(scene, "64 voxels, way of entry", "pbd", with(voxels, entry));
  row(scene, "256 voxels, shortest way", "pbd", with(voxels, {{"voxels", 256}}));
  row(scene, "`pbd-2020`: 64 voxels, way of entry", "pbd", published);
  row(scene, "256 voxels, way of entry", "pbd", with(published, {{"voxels", 256}}));
  row(scene, "fields, way of entry", "pbd", with(published, {{"collision", "fields"}}));
  row(scene, "fields, shortest way", "pbd", with(published, {{"collision", "fields"}, {"push_back", "normal"}}));
}

void predictors(const Scene& scene) {
  head();
  row(scene, "`pbd`, `carried`", "pbd", {});
  row(scene, "`pbd`, `arap`", "pbd", {{"predictor", "arap"}});
  row(scene, "`xpbd`, `carried` (by strings)", "xpbd", {});
  row(scene, "`xpbd`, `arap` (from there)", "xpbd", {{"predictor", "arap"}});
  row(scene, "`xpbd`, `carried` (by bodies)", "xpbd", {{"skinning", "bodies"}});
  row(scene, "`xpbd`, `arap` (from there)", "xpbd", {{"skinning", "bodies"}, {"predictor", "arap"}});
  row(scene, "`arap` alone", "arap", {});
}

}  // namespace

}  // namespace gracilis

int main(int count, char** arguments) {
  using namespace gracilis;
  const std::vector<std::string> words(arguments + 1, arguments + count);
  const auto is_asked = [&](const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  const ThreadLimit one_thread(1);
  const Scene scene = studied_scene(is_asked("cadaver"));
  if (!is_asked("predictors")) costs(scene), collisions(scene);
  if (!is_asked("collisions")) predictors(scene);
}
