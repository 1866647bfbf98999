#pragma once

#include <gracilis/anatomy/attachments/muscle_bodies.hpp>
#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/anatomy/overlap/bone_field.hpp>
#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/methods/xpbd/settings.hpp>
#include <gracilis/methods/xpbd/xpbd_method.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/scene/setting_values.hpp>

#include <shapes.hpp>

#include <cmath>
#include <memory>
#include <vector>

/// A small joint that solves in milliseconds.
namespace gracilis {

/// Attaches the vertices above a height (m) by one attachment and those below another by the other.
inline void attach_by_height(Muscle& muscle, Attachment origin, Real above, Attachment insertion, Real below) {
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v) {
    const Real z = muscle.surface.vertices(2, v);
    if (z > above) origin.vertices.push_back(v);
    if (z < below) insertion.vertices.push_back(v);
  }
  muscle.attachments = {origin, insertion};
}

/// Two box bones in line, a hinge between them, and a tube of muscle along their front that is attached to both:
///
///            ┌────┐▒
///   upper    │    │▒
///            │    │▒   muscle, 160 mm long, 0.5 mm clear of the bones
///            └────┘▒
///            ×     ▒   hinge about y
///            ┌────┐▒
///   lower    │    │▒
///            │    │▒
///            └────┘▒
///
/// Flexion swings the lower bone back, so that the muscle is drawn around the edges of both bones.
inline Scene tube_scene(const XpbdSettings& settings = {}) {
  Scene scene;
  scene.name = "tube";
  scene.bodies = {"upper", "lower"};
  scene.bones = {{"upper", 0, shapes::box({-0.015, -0.03, 0.005}, {0.015, 0.03, 0.1})},
                 {"lower", 1, shapes::box({-0.015, -0.03, -0.1}, {0.015, 0.03, -0.005})}};
  scene.joints = {{"hinge", 0, 1, RigidTransform::Identity(), {{"flexion", Vec3::UnitY(), 0, 0, radians(120)}}}};
  scene.joints[0].frame = Eigen::Translation3d(-0.015, 0, 0) * RigidTransform::Identity();
  Muscle muscle;
  muscle.name = "tube";
  muscle.surface = shapes::cylinder(0.01, 0.16, 20, 40);
  muscle.surface.vertices.colwise() += Vec3(0.0255, 0, -0.08);
  attach_by_height(muscle, {"upper end", AttachmentEnd::origin, 0, {}, false}, 0.07,
                   {"lower end", AttachmentEnd::insertion, 1, {}, false}, -0.07);
  scene.method.settings = changed_values(settings);
  scene.muscles = {muscle};
  return scene;
}

/// The same with a second muscle in front of the tube, from the upper bone to the tube's middle, which it lies on.
inline Scene end_on_muscle_scene(const XpbdSettings& settings = {}) {
  Scene scene = tube_scene(settings);
  Muscle rider;
  rider.name = "rider";
  rider.surface = shapes::cylinder(0.006, 0.1, 14, 30);
  rider.surface.vertices.colwise() += Vec3(0.0422, 0, -0.03);
  attach_by_height(rider, {"bone", AttachmentEnd::origin, 0, {}, false}, 0.06,
                   {"tube", AttachmentEnd::insertion, 0, {}, false}, -0.02);
  Attachment& end = rider.attachments[1];
  end.body = add_muscle_body(scene, "rider_on_tube", 0, rider.surface.vertices(Eigen::all, end.vertices));
  scene.muscles.push_back(rider);
  return scene;
}

inline Pose flexed(const Scene& scene, Real angle) { return pose_at(scene, std::vector<Real>{angle}); }

/// The fields of the two bones, built once.
inline const std::vector<DistanceField>& tube_fields() {
  static const std::vector<DistanceField> fields = [] {
    const Scene scene = tube_scene();
    std::vector<DistanceField> built;
    for (const Bone& bone : scene.bones) built.push_back(build_bone_field(bone, scene.distance_fields));
    return built;
  }();
  return fields;
}

inline std::unique_ptr<DeformationMethod> xpbd_on_tube(const Scene& scene) {
  return make_xpbd_method(scene, tube_fields());
}

inline Frame frame_of(const DeformationMethod& method, const Pose& pose, int number) {
  Frame frame;
  frame.number = number;
  frame.pose = pose;
  method.write(frame);
  return frame;
}

inline Real farthest(const Frame& one, const Frame& other) {
  Real largest = 0;
  for (std::size_t m = 0; m < one.muscles.size(); ++m)
    largest = std::max(largest, (one.muscles[m].points - other.muscles[m].points).colwise().norm().maxCoeff());
  return largest;
}

}  // namespace gracilis
