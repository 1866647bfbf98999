#include <gracilis/anatomy/joints/blended_bodies.hpp>
#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/simulate/run.hpp>

#include <scenes_for_tests.hpp>

#include "line_scene.hpp"
#include "shape_hash.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <map>
#include <random>
#include <set>

/// What methods promise (methods/method.hpp), asked of each under several settings. A new method is one line in
/// `all_variants`, which says what it claims.
namespace gracilis {
namespace {

/// What a method may claim. Frame 0, the error for a pose that is not finite, the same bits for any number of threads
/// and after a resume are asked of all.
enum class Property {
  rest_stays,    ///< at the capture pose nothing moves
  rigid_motion,  ///< of all bodies moves the result rigidly
  any_jump,      ///< gives finite shapes; without this claim it may also be an error
  volume,        ///< stays within 1 % through 45 degrees
  capture_pose   ///< is come back to within 1 mm
};
using Claims = std::set<Property>;
const Claims everything = {Property::rest_stays, Property::rigid_motion, Property::any_jump, Property::volume,
                           Property::capture_pose};

Claims all_but(std::initializer_list<Property> missing) {
  Claims claims = everything;
  for (const Property each : missing) claims.erase(each);
  return claims;
}

struct Variant {
  std::string name, method;
  Claims claims;
  SettingValues settings = {};
  std::function<Scene()> scene = [] { return tube_scene(); };  ///< with two bodies and a hinge between them
};

std::vector<Variant> all_variants() {
  const Preset thesis = *find_preset("thesis-2024"), pbd_2020 = *find_preset("pbd-2020");
  return {
      {"skinning", "skinning", all_but({Property::volume, Property::any_jump})},
      // Frame 0 is the input; then the fibers come under tension, which moves it a little.
      {"tissue", "tissue", all_but({Property::rest_stays, Property::capture_pose})},
      // Two muscles together are not at rest after a frame's iterations, and rounding decides where they are then (0.06
      // mm).
      {"tissue_end_on_muscle",
       "tissue",
       all_but({Property::rest_stays, Property::capture_pose, Property::rigid_motion}),
       {},
       [] { return end_on_muscle_scene(); }},
      {"cylinder", "cylinder", all_but({Property::volume}), {}, [] { return line_scene(0.05); }},
      // A blend of the bones' motions carries the line through its middle.
      {"cylinder_surface", "cylinder", all_but({Property::volume, Property::any_jump})},
      {"xpbd_physical", "xpbd", everything},
      {"xpbd_substeps", "xpbd", everything, {{"substeps", 3}, {"iterations", 12}}},
      {"xpbd_dynamic", "xpbd", everything, {{"time_mode", "dynamic"}}},
      {"xpbd_dynamic_substeps", "xpbd", everything, {{"time_mode", "dynamic"}, {"substeps", 2}, {"iterations", 15}}},
      {"xpbd_dynamic_frames", "xpbd", everything, {{"time_mode", "dynamic"}, {"time_step", 0.0}}},
      {"xpbd_coarser_copy", "xpbd", everything, {{"simulated_edge", 0.006}, {"full_iterations", 1}}},
      {"xpbd_coarser_copy_dynamic", "xpbd", everything, {{"simulated_edge", 0.006}, {"time_mode", "dynamic"}}},
      // Edges are drawn through bones, and of the points of such an edge rounding decides which one is brought out.
      {"xpbd_arap", "xpbd", all_but({Property::rigid_motion}), {{"predictor", "arap"}}},
      {"xpbd_arap_vertices", "xpbd", everything, {{"predictor", "arap"}, {"edge_contact", false}}},
      {"xpbd_dissipative", "xpbd", everything, {{"rayleigh_beta", 0.01}}},
      {"xpbd_end_on_muscle", "xpbd", everything, {}, [] { return end_on_muscle_scene(); }},
      {"xpbd_end_on_muscle_copy",
       "xpbd",
       everything,
       {{"simulated_edge", 0.006}, {"full_iterations", 1}},
       [] { return end_on_muscle_scene(); }},
      // As published: free vertices follow only through constraints, and the margin pushes muscles off bones at rest.
      {"xpbd_thesis_2024", "xpbd", {}, thesis.method.settings},
      {"arap", "arap", everything},
      {"arap_end_on_muscle", "arap", everything, {}, [] { return end_on_muscle_scene(); }},
      {"strings", "strings", everything},
      {"strings_end_on_muscle", "strings", everything, {}, [] { return end_on_muscle_scene(); }},
      {"rbf", "rbf", everything},
      // As published neither volume nor contact are asked for, and centers are drawn to where they were in space.
      {"rbf_2024", "rbf", all_but({Property::rigid_motion, Property::volume}),
       find_preset("rbf-2024")->method.settings},
      {"mass_spring", "mass-spring", all_but({Property::volume})},
      {"mass_spring_last", "mass-spring", all_but({Property::volume}), {{"start_from", "last"}}},
      {"mass_spring_spheres", "mass-spring", all_but({Property::volume}), {{"bone_collision", "spheres"}}},
      // As published spheres that overlap at rest are pushed apart.
      {"janak_2012",
       "mass-spring",
       {Property::rigid_motion, Property::any_jump},
       find_preset("janak-2012")->method.settings},
      {"pbd", "pbd", all_but({Property::capture_pose})},
      {"pbd_voxels", "pbd", all_but({Property::capture_pose}), {{"collision", "voxels"}}},
      {"pbd_arap", "pbd", all_but({Property::capture_pose}), {{"predictor", "arap"}}},
      // As published free vertices follow only through constraints, and so remember by which way they came.
      {"pbd_2020", "pbd", all_but({Property::rigid_motion, Property::capture_pose}), pbd_2020.method.settings},
  };
}

void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.name; }

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
      if (settings.cell_size == scene.distance_fields.cell_size) return tube_fields();  // both scenes have these bones
      std::vector<DistanceField> fields;
      for (const Bone& bone : scene.bones) fields.push_back(build_bone_field(bone, settings));
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
