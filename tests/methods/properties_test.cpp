#include <gracilis/anatomy/joints/blended_bodies.hpp>
#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/simulate/run.hpp>

#include <scenes_for_tests.hpp>

#include "method_variants.hpp"
#include "shape_hash.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>
#include <set>

/// What methods promise (methods/method.hpp), asked of each variant that claims it.
namespace gracilis {
namespace {

Scene scene_of(const Variant& variant) {
  Scene scene = variant.scene();
  scene.method.name = variant.method;
  scene.method.settings = variant.settings;
  return scene;
}

std::size_t number_of(const std::string& variant) {
  const std::vector<Variant> variants = all_variants();
  return static_cast<std::size_t>(
      std::find_if(variants.begin(), variants.end(), [&](const Variant& each) { return each.name == variant; }) -
      variants.begin());
}

class Method : public ::testing::TestWithParam<Variant> {
 protected:
  const Scene scene = scene_of(GetParam());
  std::unique_ptr<DeformationMethod> method = make();

  std::unique_ptr<DeformationMethod> make() const { return make(scene); }
  static std::unique_ptr<DeformationMethod> make(const Scene& scene) {
    return make_method(scene, [&scene](const DistanceFieldSettings& settings) {
      const bool are_built = settings.cell_size == scene.distance_fields.cell_size;
      std::vector<DistanceField> fields;
      for (std::size_t b = 0; b < scene.bones.size(); ++b)  // all scenes have these bones, some twice
        fields.push_back(are_built ? tube_fields()[b % tube_fields().size()]
                                   : build_bone_field(scene.bones[b], settings));
      return fields;
    });
  }
  bool claims(Property property) const { return GetParam().claims.contains(property); }
  void go(DeformationMethod& which, const Pose& pose) const { which.advance(pose, usual_time_step); }
  Pose at(Real angle) const {
    std::vector<Real> coordinates = capture_coordinates(scene);
    coordinates[0] = angle;
    return pose_at(scene, coordinates);
  }
  Frame shape() const { return frame_of(*method, {}, 0); }
  Frame input() const { return capture_frame(scene, at(0)); }
};

Pose moved(const RigidTransform& by, Pose pose) {
  for (RigidTransform& body : pose.bodies) body = by * body;
  return pose;
}

bool is_finite(const Frame& frame) {
  return std::all_of(frame.muscles.begin(), frame.muscles.end(),
                     [](const MuscleShape& muscle) { return muscle.points.allFinite(); });
}

#define SKIP_UNLESS_CLAIMED(property) \
  if (!claims(property)) GTEST_SKIP() << GetParam().name << " does not claim this"

TEST(Methods, every_registered_one_is_asked) {
  std::set<std::string_view> asked, registered;
  const std::vector<Variant> variants = all_variants();
  for (const Variant& variant : variants) asked.insert(variant.method);
  for (const MethodEntry& entry : methods()) registered.insert(entry.name);
  EXPECT_EQ(asked, registered);
}

TEST_P(Method, takes_the_scene_that_it_is_asked_with) { EXPECT_THAT(validate_method(scene), testing::IsEmpty()); }

TEST_P(Method, frame_0_is_the_input) { EXPECT_LT(farthest(shape(), input()), 1e-8); }

TEST_P(Method, at_rest_stays_at_rest) {
  SKIP_UNLESS_CLAIMED(Property::rest_stays);
  for (int i = 0; i < 20; ++i) go(*method, at(0));
  EXPECT_LT(farthest(shape(), input()), 1e-6);
}

TEST_P(Method, rigid_motion_of_all_bodies_moves_the_result_rigidly) {
  SKIP_UNLESS_CLAIMED(Property::rigid_motion);
  const RigidTransform by =
      Eigen::Translation3d(0.1, -0.05, 0.08) * Eigen::AngleAxisd(0.9, Vec3(1, 2, -1).normalized());
  const auto other = make();
  go(*other, moved(by, at(0)));
  go(*method, at(0));
  // Further on the symmetric tube buckles, and rounding decides to which side.
  for (int degree = 1; degree <= 25; ++degree) {
    go(*method, at(radians(degree)));
    go(*other, moved(by, at(radians(degree))));
  }
  Frame expected = shape();
  EXPECT_GT(farthest(expected, input()), 0.01) << "nothing moved";
  for (MuscleShape& muscle : expected.muscles)
    muscle.points = ((by.linear() * muscle.points).colwise() + by.translation()).eval();
  EXPECT_LT(farthest(frame_of(*other, {}, 0), expected), 1e-5);
}

TEST_P(Method, gives_the_same_bits_for_any_number_of_threads) {
  std::vector<std::uint64_t> hashes;
  for (int threads : {1, 2, 64}) {
    const ThreadLimit limit(threads);
    const auto fresh = make();
    for (int degree = 5; degree <= 45; degree += 5) go(*fresh, at(radians(degree)));
    hashes.push_back(hash_of_shapes(frame_of(*fresh, {}, 0)));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST_P(Method, any_jump_gives_finite_shapes_or_an_error) {
  // Each variant has jumps of its own: together they are asked more of than if all had the same.
  std::mt19937 generator(static_cast<unsigned>(17 + number_of(GetParam().name)));
  std::uniform_real_distribution<Real> uniform(-1, 1);
  const auto random_body = [&] {
    const Vec3 axis(uniform(generator), uniform(generator), uniform(generator));
    const Vec3 shift(uniform(generator), uniform(generator), uniform(generator));
    return RigidTransform(Eigen::Translation3d(0.1 * shift) *
                          Eigen::AngleAxisd(pi * uniform(generator), axis.normalized()));
  };
  std::vector<Pose> poses = {at(pi), at(-pi / 2)};
  for (int i = 0; i < 2; ++i) {
    poses.push_back(at(0));
    poses.back().bodies[0] = random_body();
    poses.back().bodies[1] = random_body();
    place_by_bodies(scene, poses.back());
  }
  std::size_t survived = 0;
  for (const Pose& pose : poses) {
    try {
      go(*method, pose);
      ++survived;
    } catch (const QualityError&) {
      EXPECT_FALSE(claims(Property::any_jump)) << "an error, though shapes are claimed";
    }
    EXPECT_TRUE(is_finite(shape()));
  }
  EXPECT_EQ(survived, poses.size());
  EXPECT_NO_THROW(go(*method, at(0)));
}

TEST_P(Method, holds_a_muscle_by_two_vertices_at_each_end) {
  Scene held = scene;
  for (Muscle& muscle : held.muscles)
    for (Attachment& attachment : muscle.attachments)
      attachment.vertices.resize(std::min<std::size_t>(attachment.vertices.size(), 2));
  ASSERT_THAT(validate_method(held), testing::IsEmpty());
  const auto by_points = make(held);
  try {
    go(*by_points, at(radians(10)));
  } catch (const QualityError&) {
  }
  EXPECT_TRUE(is_finite(frame_of(*by_points, {}, 0)));
}

TEST_P(Method, keeps_its_volume) {
  SKIP_UNLESS_CLAIMED(Property::volume);
  const Eigen::Matrix3Xi& faces = scene.muscles[0].surface.faces;
  const Real before = enclosed_volume(scene.muscles[0].surface.vertices, faces);
  for (int degree = 1; degree <= 45; ++degree) {
    go(*method, at(radians(degree)));
    EXPECT_NEAR(enclosed_volume(shape().muscles[0].points, faces) / before, 1, 0.01) << degree;
  }
}

TEST_P(Method, comes_back_to_the_capture_pose) {
  SKIP_UNLESS_CLAIMED(Property::capture_pose);
  for (int degree = 1; degree <= 45; ++degree) go(*method, at(radians(degree)));
  EXPECT_GT(farthest(shape(), input()), 0.01) << "nothing moved";
  for (int degree = 44; degree >= 0; --degree) go(*method, at(radians(degree)));
  EXPECT_LT(farthest(shape(), input()), 0.001);
}

TEST_P(Method, a_bone_that_is_given_twice_changes_little) {
  SKIP_UNLESS_CLAIMED(Property::pieces);
  Scene twice = scene;
  for (const Bone& bone : scene.bones) twice.bones.push_back({bone.name + "_again", bone.body, bone.surface});
  const std::unique_ptr<DeformationMethod> other = make(twice);
  for (int degree = 3; degree <= 45; degree += 3)
    for (DeformationMethod* each : {method.get(), other.get()}) go(*each, at(radians(degree)));
  EXPECT_LT(farthest(frame_of(*other, {}, 0), shape()), 0.0005);
}

TEST_P(Method, reset_returns_to_the_capture_and_forgets_all) {
  const auto run = [&] {
    for (int degree = 6; degree <= 30; degree += 6) go(*method, at(radians(degree)));
    return hash_of_shapes(shape());
  };
  const std::uint64_t first = run();
  method->reset();
  EXPECT_LT(farthest(shape(), input()), 1e-8);
  EXPECT_EQ(run(), first);
}

TEST_P(Method, restored_goes_on_as_if_never_interrupted) {
  Frame before, last;
  std::vector<Pose> poses = {at(0)};
  const int frames = 4 * resume_period(scene);
  for (int frame = 1; frame <= frames; ++frame) {
    poses.push_back(at(radians(frame)));
    poses.back().time = frame * usual_time_step;
    go(*method, poses.back());
    before = last;
    last = frame_of(*method, poses.back(), frame);
  }
  const auto resumed = make();
  resumed->restore(poses, before, last);
  for (int frame = frames + 1; frame <= frames + 4; ++frame) {
    go(*method, at(radians(frame)));
    go(*resumed, at(radians(frame)));
  }
  const Frame expected = shape(), found = frame_of(*resumed, {}, 0);
  EXPECT_GT(farthest(expected, last), 0.003) << "nothing moved";
  EXPECT_EQ(hash_of_shapes(found), hash_of_shapes(expected));
}

TEST_P(Method, a_coordinate_that_is_not_finite_is_an_error_that_names_the_muscle_and_changes_nothing) {
  go(*method, at(0.1));
  const std::uint64_t good = hash_of_shapes(shape());
  Pose broken = at(0.2);
  broken.bodies[1].translation().x() = std::numeric_limits<Real>::quiet_NaN();
  try {
    go(*method, broken);
    FAIL() << "no error";
  } catch (const QualityError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("muscle " + scene.muscles[0].name));
    EXPECT_EQ(error.code(), ExitCode::quality);
  }
  EXPECT_EQ(hash_of_shapes(shape()), good);
  EXPECT_NO_THROW(go(*method, at(0.2)));
}

TEST_P(Method, reports_every_muscle_by_the_names_of_its_entry) {
  const StepReport report = method->advance(at(0.02), usual_time_step);
  ASSERT_EQ(report.muscles.size(), scene.muscles.size());
  EXPECT_GT(report.muscles[0].milliseconds, 0);
  std::vector<std::string_view> told, listed;
  for (const Metric& each : report.muscles[0].metrics) told.push_back(each.name);
  for (const MetricInfo& each : method_of(scene).metrics) listed.push_back(each.name);
  EXPECT_EQ(told, listed);
}

INSTANTIATE_TEST_SUITE_P(Methods, Method, ::testing::ValuesIn(all_variants()),
                         [](const auto& variant) { return variant.param.name; });

}  // namespace
}  // namespace gracilis
