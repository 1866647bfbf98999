#include <gracilis/methods/pbd/pbd_method.hpp>

#include <gracilis/anatomy/attachments/body_carriers.hpp>
#include <gracilis/anatomy/fibers/muscle_fibers.hpp>
#include <gracilis/anatomy/overlap/bone_projection.hpp>
#include <gracilis/anatomy/overlap/voxel_projection.hpp>
#include <gracilis/core/stop.hpp>
#include <gracilis/methods/arap_predictor.hpp>
#include <gracilis/methods/pbd/settings.hpp>
#include <gracilis/methods/pbd/surface.hpp>
#include <gracilis/methods/placed_method.hpp>
#include <gracilis/methods/shape_method.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

namespace gracilis {

namespace {

/// Rounds of volume and contact alone that end a frame with an as-rigid-as-possible predictor, as in the method `arap`.
constexpr int predicted_settling_rounds = 4;

/// What stays the same of one muscle.
struct PbdMuscle {
  PbdSettings settings;
  Points rest;  ///< world, in the capture pose, m
  BodyCarriers carriers;
  pbd::Surface surface;
  std::optional<ArapPredictor> predicted;  ///< where the predictor asks for it
  std::variant<BoneProjection, VoxelProjection> bones;
};

PbdMuscle prepare_pbd(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields,
                      const BoneVoxels& voxels) {
  const PbdSettings settings = muscle_settings<PbdSettings>(scene, muscle);
  const MeshTopology topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  BodyCarriers carriers = body_carriers(muscle, topology, settings.tendon_length);
  const Polylines fibers = settings.fiber_anisotropy ? fibers_of(muscle) : Polylines{};
  pbd::Surface surface = pbd::build_surface(muscle.surface, topology, carriers.fixed_body, fibers);
  std::optional<ArapPredictor> predicted;
  if (settings.predictor == Predictor::arap) predicted.emplace(muscle.surface, topology, held_vertices(carriers));
  std::variant<BoneProjection, VoxelProjection> bones;
  if (settings.collision == PbdCollision::voxels)
    bones = VoxelProjection(scene, muscle, carriers.fixed_body, voxels, settings.bone_rest_gap);
  else
    bones = BoneProjection(scene, muscle, carriers.fixed_body, fields, settings.bone_margin, settings.bone_rest_gap);
  return {settings,           muscle.surface.vertices, std::move(carriers),
          std::move(surface), std::move(predicted),    std::move(bones)};
}

/// The stiffness of one iteration of several, so that together they leave 1 - k of an error (Müller et al. 2007).
Real per_iteration(Real stiffness, int iterations) { return 1 - std::pow(1 - stiffness, 1.0 / iterations); }

/// Where vertices begin the frame.
Points begin_frame(const PbdMuscle& muscle, const Pose& last, const Pose& now, const Points& before) {
  if (muscle.settings.predictor != Predictor::none) {
    Points points = carried_on(muscle.carriers, muscle.rest, last, now, before);
    if (muscle.predicted)
      muscle.predicted->bring_nearer(
          [&](Points& places) { std::visit([&](const auto& bones) { bones.push_out(now, places); }, muscle.bones); },
          points);
    return points;
  }
  Points points = before;
  for (Index v = 0; v < static_cast<Index>(points.cols()); ++v)
    if (const Index body = muscle.carriers.fixed_body[static_cast<std::size_t>(v)]; body >= 0)
      points.col(v) = now.bodies[static_cast<std::size_t>(body)] * Vec3(muscle.rest.col(v));
  return points;
}

ShapeStep step(const PbdMuscle& muscle, const Pose& last, const Pose& now, const Points& before) {
  Points points = begin_frame(muscle, last, now, before);
  Index contacts = 0, skipped_angles = 0;
  const Index taken_along =
      std::visit([&](const auto& bones) { return bones.take_along(last, now, before, points); }, muscle.bones);
  const Points began = muscle.settings.push_back == PbdPushBack::entry ? points : Points();
  const int iterations = muscle.settings.iterations;
  const pbd::Stiffness stiffness = {per_iteration(muscle.settings.edge_stiffness, iterations),
                                    per_iteration(muscle.settings.angle_stiffness, iterations),
                                    per_iteration(muscle.settings.volume_stiffness, iterations),
                                    muscle.settings.dihedral_limit};
  const auto restore_and_push = [&] {
    pbd::project_volume(muscle.surface, stiffness.volume, points);
    contacts = std::visit(
        [&](const auto& bones) {
          return muscle.settings.push_back == PbdPushBack::entry ? bones.take_back(now, began, points)
                                                                 : bones.push_out(now, points);
        },
        muscle.bones);
  };
  for (int i = 0; i < iterations; ++i) {
    throw_if_stopped();
    skipped_angles += pbd::project_edges_and_angles(muscle.surface, stiffness, points);
    restore_and_push();
  }
  // Edges pull what was predicted against a bone through it, so much of the volume goes with the last contact.
  for (int i = 0; muscle.predicted && i < predicted_settling_rounds && contacts > 0; ++i) restore_and_push();
  return {std::move(points),
          {{"contacts", static_cast<Real>(contacts)},
           {"taken_along", static_cast<Real>(taken_along)},
           {"skipped_angles", static_cast<Real>(skipped_angles)}}};
}

ShapedMuscle shaped_by_pbd(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields,
                           const BoneVoxels& voxels) {
  const auto prepared = std::make_shared<const PbdMuscle>(prepare_pbd(scene, muscle, fields, voxels));
  return {muscle.name, muscle.surface.vertices, [prepared](const Pose& last, const Pose& now, const Points& before) {
            return step(*prepared, last, now, before);
          }};
}

/// Whether any muscle asks for this kind of collision.
bool is_asked_for(const Scene& scene, PbdCollision collision) {
  return std::any_of(scene.muscles.begin(), scene.muscles.end(), [&](const Muscle& muscle) {
    return muscle_settings<PbdSettings>(scene, muscle).collision == collision;
  });
}

/// Of the scene's muscles the most.
int voxels_of(const Scene& scene) {
  int most = 1;
  for (const Muscle& muscle : scene.muscles) most = std::max(most, muscle_settings<PbdSettings>(scene, muscle).voxels);
  return most;
}

Preset pbd_2020() {
  Preset preset;
  preset.name = "pbd-2020";
  preset.meaning = "position based dynamics as published, with what this project added switched off";
  preset.method.name = "pbd";
  PbdSettings published;
  published.predictor = Predictor::none;
  published.collision = PbdCollision::voxels;
  published.push_back = PbdPushBack::entry;
  published.bone_margin = 0;
  published.bone_rest_gap = false;
  preset.method.settings = changed_values(published);
  return preset;
}

}  // namespace

std::unique_ptr<DeformationMethod> make_pbd_method(const Scene& scene, std::vector<DistanceField> fields) {
  return made_near_origin(scene, std::move(fields), [](const Scene& near, std::vector<DistanceField> near_fields) {
    const BoneVoxels voxels = is_asked_for(near, PbdCollision::voxels) ? bone_voxels(near, voxels_of(near)) : nullptr;
    const auto make_muscle = [voxels](const Scene& of, const Muscle& muscle, const std::vector<DistanceField>& bones) {
      return shaped_by_pbd(of, muscle, bones, voxels);
    };
    return shape_method(near, std::move(near_fields), make_muscle,
                        "check the pose, or give 'edge_stiffness' and 'angle_stiffness' smaller values");
  });
}

MethodEntry pbd_entry() {
  return {.name = "pbd",
          .meaning = "their surfaces, by position based dynamics (2020)",
          .settings = describe_settings<PbdSettings>(),
          .presets = {pbd_2020()},
          .metrics = {{"contacts", 0}, {"taken_along", 0}, {"skipped_angles", 0}},
          .make = [](const Scene& scene, const BoneFieldSource& fields) {
            const bool needs_fields = is_asked_for(scene, PbdCollision::fields);
            return make_pbd_method(scene, needs_fields ? fields(scene.distance_fields) : std::vector<DistanceField>());
          }};
}

}  // namespace gracilis
