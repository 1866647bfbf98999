#pragma once

#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/io/run/run_folder.hpp>

#include <shapes.hpp>

#include <cmath>
#include <filesystem>
#include <string>

namespace gracilis {

/// A leg that flexes by 3 degrees per frame, with two muscles: "gluteus_maximus_r" gets wider by 1 % in each frame,
/// which changes its volume and misses that gate from frame 1 on; "gluteus_medius_r" keeps its shape. x anterior, y
/// superior.
struct FlexingLeg {
  Scene scene;
  std::vector<Pose> poses;
  /// Of "bulging_r", by a method whose muscles are under tension: 10 kPa and 0.1 N in frame 0, twice as much in each
  /// next.
  bool knows_forces = false;
  int fibers = 1;         ///< of each muscle, all the same
  bool pull = false;      ///< it pulls at its ends, too: 10 N in frame 0, twice as much in each next
  bool corrects = false;  ///< bones push gluteus maximus by 1 mm a frame upward, distances by 0.2 mm forward

  explicit FlexingLeg(int frames = 21) {
    scene.name = "flexing_leg";
    scene.bodies = {"pelvis", "femur_r"};
    scene.bones = {{"femur_r", 1, shapes::sphere(Vec3(0, -0.2, 0), 0.05, 3)}};
    scene.muscles.resize(2);
    scene.muscles[0].name = "gluteus_maximus_r";
    scene.muscles[0].surface = shapes::sphere(Vec3(-0.1, -0.1, 0), 0.04, 3);
    scene.muscles[1].name = "gluteus_medius_r";
    scene.muscles[1].surface = shapes::sphere(Vec3(0.1, -0.1, 0), 0.03, 3);
    Joint hip;
    hip.name = "hip_r";
    hip.child_body = 1;
    hip.axes.resize(1);
    hip.axes[0].coordinate = "hip_flexion_r";
    scene.joints = {hip};
    for (int i = 0; i < frames; ++i) {
      const RigidTransform turn(Eigen::AngleAxisd(radians(3 * i), Vec3::UnitZ()));
      poses.push_back({i / 60.0, {radians(3 * i)}, {RigidTransform::Identity(), turn}, {0.01 * i, 0}});
    }
  }

  FrameRecord record(int number) const {
    const Real growth = 1 + 0.01 * number;
    const Vec3 center = scene.muscles[0].surface.vertices.rowwise().mean();
    FrameRecord result;
    result.frame.number = number;
    result.frame.pose = poses[static_cast<std::size_t>(number)];
    const Points& rest = scene.muscles[0].surface.vertices;
    result.frame.muscles = {{(growth * (rest.colwise() - center)).colwise() + center},
                            {scene.muscles[1].surface.vertices}};
    result.measures.resize(2);
    result.measures[0].volume_ratio = std::pow(growth, 3);
    result.measures[0].edge_ratio_mean = growth;
    result.fibers.resize(2);
    for (std::size_t m = 0; m < 2; ++m) {
      const Vec3 middle = scene.muscles[m].surface.vertices.rowwise().mean();
      Points line(3, 3);
      line << -0.02, 0, 0.02, 0, 0.001, 0, 0, 0, 0;
      line *= m == 0 ? growth : 1;
      result.fibers[m].lines = join(std::vector<Points>(static_cast<std::size_t>(fibers), line.colwise() + middle));
      result.fibers[m].lengths = polyline_lengths(result.fibers[m].lines);
      result.fibers[m].mean_length = result.fibers[m].lengths[0];
    }
    if (knows_forces) add_forces(result);
    if (corrects) result.corrections.resize(2);
    if (corrects && number > 0) {
      const Index vertices = scene.muscles[0].surface.vertex_count();
      result.corrections[0] = {{"bone contact", Vec3(0, 0.001, 0).replicate(1, vertices)},
                               {"distance", Vec3(0.0002, 0, 0).replicate(1, vertices)}};
    }
    return result;
  }

  void add_forces(FrameRecord& record) const {
    const Real factor = std::pow(2, record.frame.number);
    record.frame.muscles[0].fiber_stresses =
        Eigen::VectorXd::Constant(scene.muscles[0].surface.vertex_count(), 1e4 * factor);
    record.forces.resize(2);
    MuscleForces& forces = record.forces[0];
    forces.is_known = true;
    forces.tension = 0.1 * factor;
    forces.fiber_tensions = {0.1 * factor};
    if (pull) {
      forces.origin = {{0, {Vec3(0, -10 * factor, 0), Vec3::Zero()}}};
      forces.insertion = {{1, {Vec3(0, 10 * factor, 0), Vec3::Zero()}}};
    }
    forces.moments = forces.moments_by_work = {-0.01 * factor};
  }

  /// Writes the whole run and its manifest, and opens it again.
  RecordedRun written(const std::filesystem::path& folder) const {
    {
      RunFolder run(folder, scene, poses, ExistingRun::replace);
      for (int i = 0; i < static_cast<int>(poses.size()); ++i) run.write_frame(record(i));
      RunManifest manifest;
      manifest.scene = scene.name;
      manifest.preset = "physical";
      manifest.settings = "iterations = 30 # </script> & <b>\n";
      manifest.warnings = {"gluteus_medius_r looks <b>suspicious</b>"};
      manifest.status = "complete";
      manifest.corrections = corrects;
      run.write_manifest(manifest);
      run.finish();
    }
    return open_recorded_run(folder);
  }
};

}  // namespace gracilis
