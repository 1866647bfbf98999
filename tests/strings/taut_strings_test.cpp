#include "string_scenes.hpp"

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/strings/cross_sections.hpp>
#include <gracilis/strings/string_skin.hpp>

#include <gtest/gtest.h>

namespace gracilis::strings {
namespace {

const Strung& arm() {
  static const Strung strung(arm_scene());
  return strung;
}

Points skinned(const Strung& strung, const StringState& state) {
  const TriangleMesh& surface = strung.scene.muscles[0].surface;
  const StringSkin skin = bind_skin(strung.muscle, surface, attached_bodies(strung.scene.muscles[0]));
  return skinned_by_strings(strung.muscle, skin, surface.vertices, surface.faces, state).vertices;
}

StringState at(const Strung& strung, Real angle, Real step = radians(5)) {
  StringState state = capture_state(strung.muscle, strung.scene.bodies.size());
  for (Real reached = step; reached < angle; reached += step)
    follow(strung.muscle, strung.bones, flexed(strung.scene, reached), state);
  follow(strung.muscle, strung.bones, flexed(strung.scene, angle), state);
  return state;
}

Real largest_difference(const Points& a, const Points& b) { return (a - b).colwise().norm().maxCoeff(); }

TEST(StringSkin, a_vertex_in_which_all_fibers_end_follows_them) {
  const TriangleMesh& surface = arm().scene.muscles[0].surface;
  const Index vertex = arm().scene.muscles[0].attachments[1].vertices[0];
  MuscleStrings muscle = arm().muscle;
  for (Index s = 0; s < muscle.strings; ++s)
    muscle.fibers.col(muscle.node(s, muscle.nodes - 1)) = surface.vertices.col(vertex);
  const StringSkin skin = bind_skin(muscle, surface, attached_bodies(arm().scene.muscles[0]));
  for (std::size_t v = 0; v + 1 < skin.begin.size(); ++v) {
    float sum = 0;
    for (Index k = skin.begin[v]; k < skin.begin[v + 1]; ++k) sum += skin.weights[static_cast<std::size_t>(k)];
    EXPECT_NEAR(sum, 1, 1e-5) << v;
  }
}

TEST(TautStrings, a_muscle_without_two_ends_has_none) {
  Scene scene = arm_scene();
  scene.muscles[0].attachments.pop_back();
  const Strung& strung = arm();
  EXPECT_FALSE(muscle_strings(scene, scene.muscles[0], strung.bones, {}));
}

TEST(TautStrings, a_straight_fiber_is_its_own_string) {
  EXPECT_LT(largest_difference(arm().muscle.taut, arm().muscle.fibers), 0.003);
  for (Index s = 0; s < arm().muscle.strings; ++s) {
    EXPECT_EQ(arm().muscle.taut.col(arm().muscle.node(s, 0)), arm().muscle.fibers.col(arm().muscle.node(s, 0)));
    EXPECT_EQ(arm().muscle.origin_bodies[static_cast<std::size_t>(s)], 0);
    EXPECT_EQ(arm().muscle.insertion_bodies[static_cast<std::size_t>(s)], 1);
  }
}

/// The arm's muscle in a bow over what holds it up to 90 mm off its bone.
Scene bowed_scene() {
  Scene scene = arm_scene();
  for (auto vertex : scene.muscles[0].surface.vertices.colwise()) {
    const Real along = (vertex.z() + 0.05) / 0.16;  // -1 to 1
    vertex.x() -= 0.08 * (1 - along * along);
  }
  return scene;
}

TEST(TautStrings, over_a_bone_that_is_far_off_strings_do_not_slide) {
  const Strung strung(bowed_scene());
  const Real reach = strung.muscle.settings.support_reach;
  Index near = 0, far = 0;
  for (Index p = 0; p < static_cast<Index>(strung.muscle.supports.size()); ++p)
    for (const Slide& slide : strung.muscle.supports[static_cast<std::size_t>(p)].slides) {
      EXPECT_LT(slide.distance, reach);
      EXPECT_LE(slide.share, 1 - slide.distance / reach + 1e-9);
      ++near;
    }
  for (Index p = 0; p < static_cast<Index>(strung.muscle.bone_distances.cols()); ++p)
    far += strung.muscle.bone_distances.col(p).minCoeff() > reach;
  EXPECT_GT(near, 0);
  EXPECT_GT(far, 0) << "none is far";
}

TEST(TautStrings, strings_that_a_vector_unit_takes_together_lie_together) {
  const MuscleStrings& muscle = arm().muscle;
  const auto middle = [&](Index s) { return Vec3(muscle.fibers.col(muscle.node(s, muscle.nodes / 2))); };
  // Four of 48 fill a twelfth of a round section, so they lie within a square whose diagonal is 0.72 of its radius, or
  // in a strip some longer; spread over the section they are a diameter apart.
  for (Index first = 0; first < muscle.strings; first += 4)
    for (Index s = first; s < first + 4; ++s) EXPECT_LT((middle(s) - middle(first)).norm(), 0.012) << s;
}

TEST(TautStrings, shares_of_bodies_sum_to_one) {
  EXPECT_LT((arm().muscle.shares.colwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
}

TEST(TautStrings, in_the_capture_pose_the_surface_is_the_input) {
  const StringState state = capture_state(arm().muscle, 2);
  EXPECT_LT(largest_difference(skinned(arm(), state), arm().scene.muscles[0].surface.vertices), 1e-9);
}

TEST(TautStrings, a_rigid_motion_of_all_bodies_moves_the_surface_rigidly) {
  const RigidTransform motion = Eigen::Translation3d(0.3, -0.2, 0.1) *
                                Eigen::AngleAxisd(radians(40), Vec3(1, 2, 3).normalized()) * RigidTransform::Identity();
  Pose pose = capture_pose(2);
  pose.bodies = {motion, motion};
  StringState state = capture_state(arm().muscle, 2);
  follow(arm().muscle, arm().bones, pose, state);
  const Points expected = motion * arm().scene.muscles[0].surface.vertices.colwise().homogeneous();
  EXPECT_LT(largest_difference(skinned(arm(), state), expected), 2e-5);
}

TEST(TautStrings, a_belly_stays_with_the_bone_it_lies_along) {
  const Points rest = arm().scene.muscles[0].surface.vertices, bent = skinned(arm(), at(arm(), radians(90)));
  const Real top = rest.row(2).maxCoeff(), bottom = rest.row(2).minCoeff();
  Vec3 moved = Vec3::Zero();
  int count = 0;
  for (Index v = 0; v < rest.cols(); ++v) {
    const Real share = (top - rest(2, v)) / (top - bottom);
    if (share < 1.0 / 3 || share > 2.0 / 3) continue;
    moved += bent.col(v) - rest.col(v);
    ++count;
  }
  moved /= count;
  EXPECT_LT(std::abs(moved.x()), 0.003) << "across the bone, in the plane of the joint";
  EXPECT_LT(std::abs(moved.y()), 0.001) << "sideways";
}

TEST(TautStrings, no_string_runs_through_a_bone) {
  const StringState state = at(arm(), radians(90));
  for (std::size_t b = 0; b < arm().bones.fields.size(); ++b) {
    const RigidTransform to_bone = state.bodies[static_cast<std::size_t>(arm().bones.bodies[b])].inverse();
    for (Index s = 0; s < arm().muscle.strings; ++s)
      for (Index i = 1; i + 1 < arm().muscle.nodes; ++i) {
        const Vec3 place = to_bone * Vec3(state.places.col(arm().muscle.node(s, i)));
        EXPECT_GT(sample_bounded(arm().bones.fields[b], place.cast<float>()).distance, -0.0005f);
      }
  }
}

TEST(TautStrings, the_surface_keeps_its_volume) {
  const TriangleMesh& surface = arm().scene.muscles[0].surface;
  const Real volume = enclosed_volume(skinned(arm(), at(arm(), radians(90))), surface.faces);
  EXPECT_NEAR(volume / enclosed_volume(surface.vertices, surface.faces), 1, 1e-3);
}

TEST(TautStrings, there_and_back_is_where_it_began) {
  StringState state = at(arm(), radians(60));
  for (const Real angle : {45.0, 30.0, 15.0, 0.0})
    follow(arm().muscle, arm().bones, flexed(arm().scene, radians(angle)), state);
  const Points away = state.places - arm().muscle.taut;
  EXPECT_LT(away.colwise().norm().mean(), 5e-5);
  EXPECT_LT(away.colwise().norm().maxCoeff(), 1e-3);
}

TEST(TautStrings, are_within_a_twentieth_of_a_millimetre_of_rest_after_a_step_on_average) {
  StringState state = capture_state(arm().muscle, 2);
  Real sum = 0;
  int poses = 0;
  for (int degrees = 3; degrees <= 90; degrees += 3) {
    follow(arm().muscle, arm().bones, flexed(arm().scene, radians(degrees)), state);
    StringState rested = state;
    settle(arm().muscle, arm().bones, rested);
    const Real away = (state.places - rested.places).colwise().norm().mean();
    EXPECT_LT(away, 1e-4) << degrees;
    sum += away, ++poses;
  }
  EXPECT_LT(sum / poses, 5e-5);
}

TEST(TautStrings, large_steps_are_divided) {
  const Points small = at(arm(), radians(60), radians(2)).places, large = at(arm(), radians(60), radians(60)).places;
  EXPECT_LT((small - large).colwise().norm().mean(), 2e-4);
}

TEST(TautStrings, the_number_of_threads_changes_no_bit) {
  Points first;
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    const Strung strung(arm_scene());
    const Points surface = skinned(strung, at(strung, radians(30)));
    if (threads == 1)
      first = surface;
    else
      EXPECT_EQ(surface, first);
  }
}

TEST(TautStrings, cross_sections_turn_with_what_turns_them) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, -1, 2).normalized()).toRotationMatrix();
  for (const Eigen::Matrix3d& found : section_turns(arm().muscle, turn * arm().muscle.taut))
    EXPECT_LT((found - turn).norm(), 1e-9);
}

TEST(TautStrings, a_part_that_runs_away_from_the_other_end_goes_with_its_bone) {
  Scene scene = arm_scene();
  Muscle& muscle = scene.muscles[0];
  const Real top = muscle.surface.vertices.row(2).maxCoeff();
  // A fiber that leaves its origin upwards, against its way down.
  Points line(3, 5);
  line.col(0) = Vec3(-0.018, 0, top - 0.045), line.col(1) = Vec3(-0.019, 0, top - 0.01);
  line.col(2) = Vec3(-0.026, 0, top - 0.01), line.col(3) = Vec3(-0.026, 0, 0.1);
  line.col(4) = Vec3(-0.026, 0, muscle.surface.vertices.row(2).minCoeff() + 0.005);
  muscle.given_fibers.append(line);
  const Strung strung(scene);
  EXPECT_GT(strung.muscle.first_held[0], 0);
  EXPECT_EQ(strung.muscle.last_held[0], strung.muscle.nodes - 1);
  const StringState state = at(strung, radians(30));
  for (Index i = 0; i <= strung.muscle.first_held[0]; ++i)
    EXPECT_LT((state.places.col(i) - strung.muscle.taut.col(i)).norm(), 1e-6);
}

}  // namespace
}  // namespace gracilis::strings
