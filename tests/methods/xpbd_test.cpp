#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/xpbd/motion.hpp>
#include <gracilis/methods/xpbd/preparation.hpp>
#include <gracilis/simulate/measures.hpp>

#include <scenes_for_tests.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {
namespace {

/// Flexes the tube to a right angle, degree by degree, and holds it there.
struct Held {
  Scene scene;
  std::vector<MuscleMeasures> measures;  ///< of every frame
  Index contacts = 0;                    ///< summed over all frames
};

Held held_at_a_right_angle(const XpbdSettings& settings) {
  Held held{tube_scene(settings), {}, 0};
  Measurer measurer(held.scene);
  const auto method = xpbd_on_tube(held.scene);
  for (int frame = 1; frame <= 120; ++frame) {
    const Pose pose = flexed(held.scene, radians(std::min(frame, 90)));
    held.contacts += static_cast<Index>(metric(method->advance(pose, usual_time_step).muscles[0].metrics, "contacts"));
    held.measures.push_back(measurer.measure(frame_of(*method, pose, frame)).at(0));
  }
  return held;
}

}  // namespace

TEST(Xpbd, a_muscle_held_at_a_right_angle_keeps_its_volume_and_stays_out_of_the_bones) {
  // Without slack uptake the tube is pulled tight over the bones; with it, it keeps to its arc around them.
  for (const bool slack_uptake : {false, true}) {
    SCOPED_TRACE(slack_uptake ? "with slack uptake" : "without slack uptake");
    XpbdSettings settings;
    settings.slack_uptake = slack_uptake;
    const Held held = held_at_a_right_angle(settings);
    for (std::size_t frame = 0; frame < held.measures.size(); ++frame) {
      EXPECT_NEAR(held.measures[frame].volume_ratio, 1, 0.005) << "frame " << frame + 1;
      EXPECT_LE(held.measures[frame].vertex_depth, 1e-4) << "frame " << frame + 1;
      EXPECT_LE(held.measures[frame].midpoint_depth_beyond_rest, 5e-4) << "frame " << frame + 1;
      EXPECT_TRUE(held.measures[frame].finite);
    }
    EXPECT_GT(held.measures.back().edge_ratio_mean, 1.05) << "the muscle was never stretched";
    if (!slack_uptake) {
      EXPECT_GT(held.contacts, 0) << "the muscle never met a bone";
    }
  }
}

TEST(Xpbd, returns_to_its_lengths_when_the_joint_returns) {
  const Scene scene = tube_scene();
  Measurer measurer(scene);
  const auto method = xpbd_on_tube(scene);
  for (int degree = 1; degree <= 90; ++degree) method->advance(flexed(scene, radians(degree)), usual_time_step);
  for (int degree = 89; degree >= 0; --degree) method->advance(flexed(scene, radians(degree)), usual_time_step);
  const MuscleMeasures end = measurer.measure(frame_of(*method, flexed(scene, 0), 0)).at(0);
  EXPECT_NEAR(end.edge_ratio_mean, 1, 0.005);
}

TEST(Xpbd, stops_a_frame_early_when_nothing_moves) {
  XpbdSettings settings;
  settings.stop_displacement = 1e-5;
  const Scene scene = tube_scene(settings);
  const auto method = xpbd_on_tube(scene);
  EXPECT_LT(metric(method->advance(flexed(scene, 0), usual_time_step).muscles[0].metrics, "iterations"), 3);
}

TEST(Xpbd, in_dynamic_mode_gravity_pulls_and_attachments_hold) {
  XpbdSettings settings;
  settings.time_mode = TimeMode::dynamic;
  settings.gravity = Vec3(9.81, 0, 0);
  const Scene scene = tube_scene(settings);
  const auto method = xpbd_on_tube(scene);
  for (int i = 0; i < 60; ++i) method->advance(flexed(scene, 0), usual_time_step);
  const Frame frame = frame_of(*method, flexed(scene, 0), 0);
  const Points& rest = scene.muscles[0].surface.vertices;
  Real sag = 0;
  for (Index v = 0; v < rest.cols(); ++v)
    if (std::abs(rest(2, v)) < 0.01) sag = std::max(sag, frame.muscles[0].points(0, v) - rest(0, v));
  EXPECT_GT(sag, 1e-4);
  for (Index v : scene.muscles[0].attachments[0].vertices)
    EXPECT_LT((frame.muscles[0].points.col(v) - rest.col(v)).norm(), 1e-8);
}

TEST(XpbdPreparation, masses_sum_to_density_times_volume_and_attached_ones_cannot_move) {
  Scene scene = tube_scene();
  const Muscle& muscle = scene.muscles[0];
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, muscle, tube_fields());
  const Eigen::VectorXd areas = vertex_areas(muscle.surface.vertices, muscle.surface.faces);
  const Real mass = 1060 * enclosed_volume(muscle.surface.vertices, muscle.surface.faces);
  Index fixed = 0;
  for (Index p = 0; p < prepared.system.rest.count(); ++p) {
    const Real w = prepared.system.rest.inverse_mass(p);
    const Index v = prepared.order[static_cast<std::size_t>(p)];
    EXPECT_EQ(w == 0, prepared.fixed_body[static_cast<std::size_t>(p)] >= 0);
    fixed += w == 0;
    if (w > 0) {
      EXPECT_NEAR(1 / w, mass * areas[v] / areas.sum(), 1e-4 * mass / static_cast<Real>(areas.size()));
    }
  }
  EXPECT_EQ(static_cast<std::size_t>(fixed),
            muscle.attachments[0].vertices.size() + muscle.attachments[1].vertices.size());
}

TEST(XpbdPreparation, carrier_shares_sum_to_one_and_are_whole_at_attachments) {
  const Scene scene = tube_scene();
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  ASSERT_EQ(prepared.carriers, (std::vector<Index>{0, 1}));
  for (Index p = 0; p < prepared.rest.cols(); ++p) {
    EXPECT_NEAR(prepared.carrier_shares.col(p).sum(), 1, 1e-5);
    EXPECT_GE(prepared.carrier_shares.col(p).minCoeff(), -1e-5);
    const Index body = prepared.fixed_body[static_cast<std::size_t>(p)];
    if (body >= 0) {
      EXPECT_NEAR(prepared.carrier_shares(body, p), 1, 1e-6);
    }
  }
}

TEST(XpbdPreparation, fibers_run_from_origin_to_insertion) {
  const Scene scene = tube_scene();
  const Muscle& muscle = scene.muscles[0];
  const MeshTopology topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  const Points directions =
      xpbd::fiber_directions(muscle.surface.vertices, muscle.surface.faces, topology, muscle.attachments);
  Index free = 0;
  for (Index f = 0; f < directions.cols(); ++f) {
    Vec3 middle = Vec3::Zero();
    for (int k = 0; k < 3; ++k) middle += muscle.surface.vertices.col(muscle.surface.faces(k, f)) / 3;
    if (std::abs(middle.z()) > 0.065) continue;
    ++free;
    EXPECT_GT(directions.col(f).dot(-Vec3::UnitZ()), 0.99);
  }
  EXPECT_GT(free, 500);
}

namespace {

/// What an edge aims at over its length at rest, with the middle between its ends at rest.
struct Aim {
  Vec3 middle, along;  ///< m; unit
  Real ratio;
};

/// Its carriers' shares are linear along it.
Scene tube_without_tendons() {
  XpbdSettings settings;
  settings.tendon_length = 0;
  return tube_scene(settings);
}

std::vector<Aim> aims(const xpbd::PreparedMuscle& prepared, const Pose& pose) {
  const DistanceSet& edges = prepared.system.distances;
  xpbd::MuscleState state = xpbd::make_muscle_state(prepared, pose.bodies.size());
  xpbd::set_target_lengths(prepared, pose, state);
  const AlignedVector<float>& target = state.target_length;
  std::vector<Aim> all;
  for (std::size_t slot = 0; slot < target.size(); ++slot) {
    if (edges.a[slot] >= prepared.rest.cols()) continue;
    const Vec3 a = prepared.rest.col(edges.a[slot]), b = prepared.rest.col(edges.b[slot]);
    all.push_back({(a + b) / 2, (b - a).normalized(), static_cast<Real>(target[slot] / edges.rest_length[slot])});
  }
  return all;
}

}  // namespace

TEST(XpbdMotion, a_muscle_bent_about_its_middle_aims_at_a_shorter_front_and_a_longer_back) {
  Scene scene = tube_without_tendons();
  const Real axis = 0.0255, free_length = 0.144;  // of the tube; between the rings that are attached
  scene.joints[0].frame = Eigen::Translation3d(axis, 0, 0) * RigidTransform::Identity();
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  const Real angle = radians(60);
  // Half way the blend of two rotations turns by 4 tan(φ/4) per share, and the shares are linear along a tube.
  const Real turn = 4 * std::tan(angle / 4) / free_length;
  Index along = 0;
  Real shortest = 1, longest = 1;
  for (const Aim& aim : aims(prepared, flexed(scene, angle))) {
    if (std::abs(aim.middle.z()) > 0.003 || std::abs(aim.along.z()) < 0.9999) continue;
    const Real x = aim.middle.x() - axis;
    EXPECT_NEAR(aim.ratio, std::hypot(1 + turn * x, turn * aim.middle.z()), 5e-4) << "at " << x;
    shortest = std::min(shortest, aim.ratio), longest = std::max(longest, aim.ratio);
    ++along;
  }
  EXPECT_GE(along, 20);
  EXPECT_LT(shortest, 0.93);
  EXPECT_GT(longest, 1.07);
}

TEST(XpbdMotion, a_muscle_whose_ends_approach_aims_at_shorter_fibers_down_to_a_limit) {
  const Scene scene = tube_without_tendons();
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  for (const Real share : {0.8, 0.5, 0.2}) {
    Pose closer = flexed(scene, 0);
    closer.bodies[1].translation().z() += (1 - share) * 0.144;
    Index along = 0, across = 0;
    for (const Aim& aim : aims(prepared, closer)) {
      if (std::abs(aim.middle.z()) > 0.07) continue;
      if (std::abs(aim.along.z()) > 0.9999) {
        EXPECT_NEAR(aim.ratio, std::max(share, 0.4), 1e-3);
        ++along;
      }
      if (std::abs(aim.along.z()) < 1e-6) {
        EXPECT_NEAR(aim.ratio, 1, 1e-3);
        ++across;
      }
    }
    EXPECT_GT(along, 300);
    EXPECT_GT(across, 300);
  }
}

TEST(XpbdMotion, a_stretched_muscle_aims_at_a_longer_and_thinner_shape_of_its_own_volume) {
  const Scene scene = tube_without_tendons();
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  Pose farther = flexed(scene, 0);
  farther.bodies[1].translation().z() -= 0.5 * 0.144;
  const Points& rest = prepared.rest;
  const Real volume = enclosed_volume(xpbd::carried_rest(prepared, farther, {}), prepared.faces) /
                      enclosed_volume(rest, prepared.faces);
  EXPECT_NEAR(volume, 1 + 0.5 * 0.144 / 0.16, 1e-6);
  Index along = 0, across = 0;
  for (const Aim& aim : aims(prepared, farther)) {
    if (std::abs(aim.middle.z()) > 0.07) continue;
    if (std::abs(aim.along.z()) > 0.9999) {
      EXPECT_NEAR(aim.ratio, 1.5 / std::cbrt(volume), 1e-3);
      ++along;
    }
    if (std::abs(aim.along.z()) < 1e-6) {
      EXPECT_NEAR(aim.ratio, 1 / std::cbrt(volume), 1e-3);
      ++across;
    }
  }
  EXPECT_GT(along, 300);
  EXPECT_GT(across, 300);
}

TEST(XpbdMotion,
     carried_back_to_the_capture_pose_a_relaxed_muscle_gives_up_its_displacement_by_the_square_of_the_turn) {
  const Scene scene = tube_without_tendons();
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  const Real kept = 1 - prepared.settings.shape_recovery, displacement = 0.004;
  const auto left = [&](Real from, Real to, bool active) {
    const auto carried = [&](Real angle) -> Points {
      return xpbd::carried_rest(prepared, flexed(scene, radians(angle)), {});
    };
    xpbd::MuscleState state = xpbd::make_muscle_state(prepared, scene.bodies.size());
    Particles& particles = state.particles;
    const Points before = carried(from), after = carried(to);
    for (Index p = 0; p < particles.count(); ++p)
      if (prepared.fixed_body[static_cast<std::size_t>(p)] < 0)
        particles.position(p) = (before.col(p) + Vec3(displacement, 0, 0)).cast<float>();
    xpbd::carry_free(prepared, flexed(scene, radians(from)), flexed(scene, radians(to)), active, state);
    Real largest = 0;
    for (Index p = 0; p < particles.count(); ++p)
      if (prepared.fixed_body[static_cast<std::size_t>(p)] < 0)
        largest = std::max(largest, (particles.position(p).cast<Real>() - after.col(p)).norm());
    return largest / displacement;
  };
  EXPECT_NEAR(left(30, 31, false), kept, 1e-4) << "away from the capture pose";
  EXPECT_NEAR(left(30, 24, false), 0.64 * kept, 1e-4) << "towards it";
  EXPECT_NEAR(left(30, 0, false), 0.25 * kept, 1e-4) << "down to 15 degrees";
  EXPECT_NEAR(left(10, 4, false), kept, 1e-4) << "and no more near it, so that the way through it is smooth";
  EXPECT_NEAR(left(30, 24, true), kept, 1e-4) << "an active one pulls by itself";
}

TEST(XpbdMotion, no_edge_aims_beyond_the_stretch_limit) {
  XpbdSettings settings;
  settings.stretch_limit = 1.25;
  const Scene scene = tube_scene(settings);
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  Pose farther = flexed(scene, 0);
  farther.bodies[1].translation().z() -= 0.144;
  Real longest = 0;
  for (const Aim& aim : aims(prepared, farther)) longest = std::max(longest, aim.ratio);
  EXPECT_NEAR(longest, 1.25, 1e-5);
}

TEST(XpbdMotion, edges_aim_at_their_lengths_at_rest_in_the_capture_pose_and_when_all_bodies_move_alike) {
  const Scene scene = tube_without_tendons();
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  Pose pose = flexed(scene, 0);
  const RigidTransform moved = Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(2, Vec3(1, 2, 2) / 3);
  for (const RigidTransform& by : {RigidTransform::Identity(), moved}) {
    for (RigidTransform& body : pose.bodies) body = by;
    for (const Aim& aim : aims(prepared, pose)) EXPECT_NEAR(aim.ratio, 1, 3e-7);
  }
}

TEST(XpbdMotion, without_slack_uptake_edges_aim_at_their_lengths_at_rest) {
  XpbdSettings settings;
  settings.slack_uptake = false;
  const Scene scene = tube_scene(settings);
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  for (const Aim& aim : aims(prepared, flexed(scene, radians(60)))) EXPECT_EQ(aim.ratio, 1);
}

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

TEST(Xpbd, a_muscle_told_to_slide_on_a_bone_does_not_lift_off) {
  const auto farthest_from_the_bone = [](const XpbdSettings& settings) {
    const Scene scene = tube_scene(settings);
    const auto method = xpbd_on_tube(scene);
    // The lower bone turns forwards and takes the muscle away from the upper.
    for (int degree = 1; degree <= 30; ++degree) method->advance(flexed(scene, radians(degree)), usual_time_step);
    const Frame frame = frame_of(*method, flexed(scene, radians(30)), 30);
    Real farthest = 0;
    for (Index v = 0; v < scene.muscles[0].surface.vertex_count(); ++v) {
      const Eigen::Vector3f rest = scene.muscles[0].surface.vertices.col(v).cast<float>();
      const Eigen::Vector3f now = frame.muscles[0].points.col(v).cast<float>();
      const float before = sample(tube_fields()[0], rest).distance;
      if (before > 0.0015f || rest.z() > 0.07f) continue;
      farthest = std::max(farthest, static_cast<Real>(sample(tube_fields()[0], now).distance - before));
    }
    return farthest;
  };
  XpbdSettings settings;
  EXPECT_GT(farthest_from_the_bone(settings), 1e-3) << "it never lifted off";
  settings.slide_on_bone = "upper";
  settings.slide_reach = 0.0015;
  EXPECT_LT(farthest_from_the_bone(settings), 2e-4);
}

}  // namespace gracilis
