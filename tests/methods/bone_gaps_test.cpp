#include <gracilis/methods/xpbd/motion.hpp>
#include <gracilis/methods/xpbd/preparation.hpp>
#include <gracilis/simulate/measures.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis {
namespace {

/// The tube with a small bone of its own that lies up to 1 mm deep in the muscle, far from both attachments.
Scene overlapping_scene() {
  Scene scene = tube_scene();
  scene.bones.push_back({"spur", 0, shapes::box({-0.01, -0.004, 0.015}, {0.0165, 0.004, 0.03})});
  return scene;
}

std::vector<DistanceField> fields_of(const Scene& scene) {
  std::vector<DistanceField> fields;
  for (const Bone& bone : scene.bones) fields.push_back(build_bone_field(bone, scene.distance_fields));
  return fields;
}

}  // namespace

TEST(BoneGaps, an_overlap_at_rest_stays_in_the_capture_pose_and_ends_when_the_bone_moves) {
  const Scene scene = overlapping_scene();
  const std::vector<DistanceField> fields = fields_of(scene);
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], fields);
  const FieldContactSet& contact = prepared.system.contacts[2];
  Index inside = 0;
  for (Index p = 0; p < prepared.rest.cols(); ++p) {
    const float depth = sample(fields[2], Eigen::Vector3f(prepared.rest.col(p).cast<float>())).distance;
    if (depth >= 0) continue;
    ++inside;
    EXPECT_NEAR(contact.captured.particle[static_cast<std::size_t>(p)], 0.95f * depth, 1e-7);
    EXPECT_EQ(contact.released.particle[static_cast<std::size_t>(p)], 0.0005f);
  }
  EXPECT_GT(inside, 5);
  EXPECT_EQ(xpbd::place_fields(prepared, flexed(scene, 0))[2].release, 0);
  EXPECT_NEAR(xpbd::place_fields(prepared, flexed(scene, radians(0.25)))[2].release, 0.5, 1e-3);
  EXPECT_EQ(xpbd::place_fields(prepared, flexed(scene, radians(20)))[2].release, 1);
}

TEST(BoneGaps, an_overlap_that_reaches_an_attachment_stays) {
  Scene scene = tube_scene();
  scene.muscles[0].surface.vertices.row(0).array() -= 0.001;  // 0.5 mm into both bones, along its whole length
  const std::vector<DistanceField> fields = fields_of(scene);
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], fields);
  Index kept = 0;
  for (std::size_t p = 0; p < prepared.fixed_body.size(); ++p) {
    if (prepared.fixed_body[p] >= 0 || prepared.system.contacts[0].captured.particle[p] >= 0) continue;
    ++kept;
    const float captured = prepared.system.contacts[0].captured.particle[p];
    EXPECT_NEAR(prepared.system.contacts[0].released.particle[p],
                std::min(0.0005, captured + 0.1 * scene.distance_fields.cell_size), 2e-6);
  }
  EXPECT_GT(kept, 5);
}

TEST(BoneGaps, the_middles_of_edges_out_of_an_overlap_that_stays_are_let_no_deeper_than_at_rest) {
  Scene scene = tube_scene();
  scene.muscles[0].surface.vertices.row(0).array() -= 0.004;
  const std::vector<DistanceField> fields = fields_of(scene);
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], fields);
  const FieldContactSet& contact = prepared.system.contacts[0];
  const auto distance = [&](const Vec3& p) { return sample(fields[0], Eigen::Vector3f(p.cast<float>())).distance; };
  EXPECT_GT(contact.middles.size(), 5u);
  for (const EdgeMiddle& middle : contact.middles) {
    const Vec3 a = prepared.rest.col(middle.a), b = prepared.rest.col(middle.b);
    EXPECT_LT(std::min(distance(a), distance(b)), 0);
    const float at_rest = distance((a + b) / 2);
    EXPECT_LE(middle.gap, std::max(at_rest, 0.95f * at_rest) + 1e-7f) << "at rest nothing moves";
    EXPECT_GE(middle.gap, std::min(0.0f, at_rest));
  }
  EXPECT_TRUE(
      xpbd::prepare_muscle(tube_scene(), tube_scene().muscles[0], tube_fields()).system.contacts[0].middles.empty());
}

TEST(BoneGaps, the_middle_of_an_edge_over_a_ridge_beside_an_attachment_comes_no_deeper_though_the_ridge_is) {
  Scene scene = tube_scene();
  scene.distance_fields.cell_size = 0.0003;
  // Edges from z = 72 mm (attached) to 68 mm pass through the ridge at a quarter of their length.
  scene.bones = {{"ridge", 0, shapes::box({0.013, -0.004, 0.0705}, {0.0175, 0.004, 0.0712})}};
  const std::vector<DistanceField> fields = fields_of(scene);
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], fields);
  const FieldContactSet& contact = prepared.system.contacts[0];
  const DistanceSet& edges = prepared.system.distances;
  Index crossing = 0;
  for (std::size_t slot = 0; slot < edges.a.size(); ++slot) {
    const Index a = edges.a[slot], b = edges.b[slot];
    if (std::max(a, b) >= prepared.rest.cols() || contact.released.edge_sag[slot] > -0.00055f) continue;
    const Vec3 middle = (prepared.rest.col(a) + prepared.rest.col(b)) / 2;
    if (prepared.fixed_body[static_cast<std::size_t>(a)] >= 0 && prepared.fixed_body[static_cast<std::size_t>(b)] >= 0)
      continue;
    if (sample(fields[0], Eigen::Vector3f(middle.cast<float>())).distance < 0) continue;
    ++crossing;
    EXPECT_TRUE(std::any_of(contact.middles.begin(), contact.middles.end(),
                            [&](const EdgeMiddle& kept) { return kept.a == a && kept.b == b && kept.gap == 0; }))
        << "edge " << a << " to " << b;
  }
  EXPECT_GT(crossing, 2);
}

TEST(Xpbd, overlaps_far_from_attachments_are_gone_after_the_first_degree) {
  const Scene scene = overlapping_scene();
  Measurer measurer(scene);
  const auto method = make_xpbd_method(scene, fields_of(scene));
  method->advance(flexed(scene, 0), usual_time_step);
  EXPECT_GT(measurer.measure(frame_of(*method, flexed(scene, 0), 1)).at(0).vertex_depth, 5e-4) << "rest stays at rest";
  method->advance(flexed(scene, radians(1)), usual_time_step);
  EXPECT_LT(measurer.measure(frame_of(*method, flexed(scene, radians(1)), 2)).at(0).vertex_depth, 1e-5);
}

}  // namespace gracilis
