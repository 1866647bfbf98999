#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/signed_distance.hpp>

#include <scenes_for_tests.hpp>

#include "shape_hash.hpp"

#include <gtest/gtest.h>

#include <set>

namespace gracilis {
namespace {

/// Two balls of muscle of 10 mm, 1 mm apart, each attached to a plate of bone; the plates come nearer:
///
///      ▔▔▔▔▔▔▔▔  upper, comes down
///         ●
///         ●
///      ▁▁▁▁▁▁▁▁  lower
Scene two_balls_in_a_press(const std::string& contact) {
  Scene scene;
  scene.name = "press";
  scene.bodies = {"lower", "upper"};
  scene.bones = {{"lower", 0, shapes::box({-0.02, -0.02, -0.006}, {0.02, 0.02, -0.001})},
                 {"upper", 1, shapes::box({-0.02, -0.02, 0.042}, {0.02, 0.02, 0.047})}};
  scene.joints = {{"press", 0, 1, RigidTransform::Identity(), {{"down", -Vec3::UnitZ(), 0, 0, 0.02}}}};
  scene.joints[0].axes[0].translation = true;
  Muscle low, high;
  low.name = "low", high.name = "high";
  low.surface = shapes::sphere(Vec3::Zero(), 0.01, 4);
  // Turned, so that vertices do not lie on vertices.
  high.surface = {Eigen::AngleAxisd(0.3, Vec3(2, 1, 2) / 3).toRotationMatrix() * low.surface.vertices,
                  low.surface.faces};
  low.surface.vertices.colwise() += Vec3(0, 0, 0.01);
  high.surface.vertices.colwise() += Vec3(0, 0, 0.031);
  Attachment bottom{"bottom", AttachmentEnd::origin, 0, {}, false}, top{"top", AttachmentEnd::origin, 1, {}, false};
  for (Index v = 0; v < low.surface.vertex_count(); ++v) {
    if (low.surface.vertices(2, v) < 0.003) bottom.vertices.push_back(v);
    if (high.surface.vertices(2, v) > 0.038) top.vertices.push_back(v);
  }
  low.attachments = {bottom}, high.attachments = {top};
  scene.muscles = {low, high};
  scene.method.contact["muscle"] = contact;
  return scene;
}

/// How deep vertices of one muscle are in the other, m, the deepest.
Real deepest(const Scene& scene, const Frame& frame) {
  Real depth = 0;
  for (std::size_t one : {0u, 1u}) {
    const SignedDistance other({frame.muscles[1 - one].points, scene.muscles[1 - one].surface.faces});
    for (Index v = 0; v < frame.muscles[one].points.cols(); ++v)
      depth = std::max(depth, -other.query(frame.muscles[one].points.col(v)).distance);
  }
  return depth;
}

const std::vector<DistanceField>& plates() {
  static const std::vector<DistanceField> fields = [] {
    const Scene scene = two_balls_in_a_press("none");
    std::vector<DistanceField> built;
    for (const Bone& bone : scene.bones) built.push_back(build_bone_field(bone, scene.distance_fields));
    return built;
  }();
  return fields;
}

/// The upper plate so many mm lower.
Pose lowered(const Scene& scene, Real by) { return pose_at(scene, std::vector<Real>{0.001 * by}); }

struct Pressed {
  Real depth = 0;  ///< m, deepest in any frame
  StepReport last;
  Frame end;
};

/// Pressed by 6 mm, half a millimeter per frame, and held.
Pressed pressed(const Scene& scene) {
  const auto method = make_xpbd_method(scene, plates());
  Pressed result;
  for (int frame = 1; frame <= 16; ++frame) {
    const Pose pose = lowered(scene, std::min(0.5 * frame, 6.0));
    result.last = method->advance(pose, usual_time_step);
    result.end = frame_of(*method, pose, frame);
    result.depth = std::max(result.depth, deepest(scene, result.end));
  }
  return result;
}

}  // namespace

TEST(VirtualEdgesInScenes, muscles_pressed_on_each_other_no_longer_sink_in) {
  const Pressed without = pressed(two_balls_in_a_press("none"));
  EXPECT_GT(without.depth, 0.003) << "they were never pressed on each other";
  EXPECT_EQ(metric(without.last.muscles[0].metrics, "virtual_edges"), 0);
  const Pressed with = pressed(two_balls_in_a_press("virtual-edges"));
  EXPECT_EQ(with.depth, 0);
  for (const MuscleReport& report : with.last.muscles) {
    EXPECT_GT(metric(report.metrics, "virtual_edges"), 100);
    EXPECT_GT(metric(report.metrics, "virtual_pushes"), 0);
    EXPECT_LT(metric(report.metrics, "virtual_pushes"), metric(report.metrics, "virtual_edges"));
  }
}

TEST(VirtualEdgesInScenes, every_variant_of_them_keeps_muscles_apart) {
  // But for unit_sum, where the way back weighs as much as the push however short it is.
  std::vector<Scene> variants(6, two_balls_in_a_press("virtual-edges"));
  variants[1].method.contact["resolution"] = "push";
  variants[2].method.contact["reset_edges"] = true;
  variants[3].method.contact["coinciding_edges"] = "drop";
  variants[4].method.contact["coinciding_edges"] = "reseed";
  variants[5].method.contact["adaptive_distance"] = true;
  variants[5].method.contact["contact_distance"] = 0.001;
  std::set<std::uint64_t> shapes;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const Pressed with = pressed(variants[i]);
    EXPECT_EQ(with.depth, 0) << "variant " << i;
    shapes.insert(hash_of_shapes(with.end));
  }
  EXPECT_EQ(shapes.size(), 6u) << "no two variants are the same";
}

TEST(VirtualEdgesInScenes, muscles_have_the_same_bits_for_any_number_of_threads_and_after_a_reset) {
  Scene scene = two_balls_in_a_press("virtual-edges");
  scene.method.contact["coinciding_edges"] = "reseed";
  std::set<std::uint64_t> shapes;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    const auto method = make_xpbd_method(scene, plates());
    for (int again = 0; again < 2; ++again) {
      method->reset();
      for (int frame = 1; frame <= 8; ++frame) method->advance(lowered(scene, 0.5 * frame), usual_time_step);
      shapes.insert(hash_of_shapes(frame_of(*method, lowered(scene, 4), 8)));
    }
  }
  EXPECT_EQ(shapes.size(), 1u);
}

TEST(VirtualEdgesInScenes, a_frame_that_fails_leaves_the_edges_as_they_were) {
  const Scene scene = two_balls_in_a_press("virtual-edges");
  const auto failing = make_xpbd_method(scene, plates()), sound = make_xpbd_method(scene, plates());
  Pose lost = lowered(scene, 2);
  lost.bodies[1].translation().z() = std::numeric_limits<Real>::quiet_NaN();
  for (int frame = 1; frame <= 8; ++frame) {
    const Pose pose = lowered(scene, 0.5 * frame);
    if (frame == 4) {
      EXPECT_THROW(failing->advance(lost, usual_time_step), QualityError);
    }
    failing->advance(pose, usual_time_step);
    sound->advance(pose, usual_time_step);
  }
  const Pose end = lowered(scene, 4);
  EXPECT_EQ(hash_of_shapes(frame_of(*failing, end, 8)), hash_of_shapes(frame_of(*sound, end, 8)));
}

}  // namespace gracilis
