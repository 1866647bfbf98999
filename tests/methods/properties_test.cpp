#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/scene/presets.hpp>
#include <gracilis/simulate/run.hpp>

#include <scenes_for_tests.hpp>
#include <gracilis/core/state_hash.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>

/// What every method promises (methods/method.hpp), asked of each under several settings. A new method is one line in
/// `all_variants`.
namespace gracilis {
namespace {

struct Variant {
  std::string name;
  std::function<std::unique_ptr<DeformationMethod>(const Scene&)> make;
  XpbdSettings xpbd;
  bool carries_free_vertices = true;  ///< or they follow only through constraints, as published
};

std::vector<Variant> all_variants() {
  std::vector<Variant> variants;
  variants.push_back({"xpbd_physical", xpbd_on_tube, {}});
  variants.push_back({"xpbd_substeps", xpbd_on_tube, {}});
  variants.back().xpbd.substeps = 3;
  variants.back().xpbd.iterations = 12;
  variants.push_back({"xpbd_dynamic", xpbd_on_tube, {}});
  variants.back().xpbd.time_mode = TimeMode::dynamic;
  variants.push_back({"xpbd_dynamic_substeps", xpbd_on_tube, {}});
  variants.back().xpbd.time_mode = TimeMode::dynamic;
  variants.back().xpbd.substeps = 2;
  variants.back().xpbd.iterations = 15;
  variants.push_back({"xpbd_coarser_copy", xpbd_on_tube, {}});
  variants.back().xpbd.simulated_edge = 0.006;
  variants.back().xpbd.full_iterations = 1;
  variants.push_back({"xpbd_coarser_copy_dynamic", xpbd_on_tube, {}});
  variants.back().xpbd.simulated_edge = 0.006;
  variants.back().xpbd.time_mode = TimeMode::dynamic;
  variants.push_back({"xpbd_dissipative", xpbd_on_tube, {}});
  variants.back().xpbd.rayleigh_beta = 0.01;
  variants.push_back({"xpbd_thesis_2024", xpbd_on_tube, find_preset("thesis-2024")->xpbd});
  variants.back().carries_free_vertices = false;
  return variants;
}

void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.name; }

class Method : public ::testing::TestWithParam<Variant> {
 protected:
  const Scene scene = tube_scene(GetParam().xpbd);
  std::unique_ptr<DeformationMethod> method = GetParam().make(scene);

  Pose at(Real angle) const { return flexed(scene, angle); }
  Frame shape(const Pose& pose = {}) const { return frame_of(*method, pose, 0); }
};

std::uint64_t hash_of_shapes(const Frame& frame) {
  std::uint64_t hash = hash_seed;
  for (const MuscleShape& muscle : frame.muscles) hash = hash_of(muscle.points, hash);
  return hash;
}

Pose moved(const RigidTransform& by, Pose pose) {
  for (RigidTransform& body : pose.bodies) body = by * body;
  return pose;
}

bool is_finite(const Frame& frame) {
  return std::all_of(frame.muscles.begin(), frame.muscles.end(),
                     [](const MuscleShape& muscle) { return muscle.points.allFinite(); });
}

}  // namespace

TEST_P(Method, begins_at_the_capture_pose) { EXPECT_LT(farthest(shape(), capture_frame(scene, at(0))), 1e-8); }

TEST_P(Method, at_rest_stays_at_rest) {
  // The published margin pushes muscles away from bones already in the capture pose; that is not rest.
  Scene at_ease = scene;
  if (!at_ease.muscles[0].xpbd.bone_rest_gap) at_ease.muscles[0].xpbd.bone_margin = 0;
  method = GetParam().make(at_ease);
  for (int i = 0; i < 20; ++i) method->advance(at(0));
  EXPECT_LT(farthest(shape(), capture_frame(scene, at(0))), 1e-6);
}

TEST_P(Method, rigid_motion_of_all_bodies_moves_the_result_rigidly) {
  if (!GetParam().carries_free_vertices) GTEST_SKIP() << "the published method leaves free vertices behind";
  const RigidTransform by =
      Eigen::Translation3d(0.1, -0.05, 0.08) * Eigen::AngleAxisd(0.9, Vec3(1, 2, -1).normalized());
  const auto other = GetParam().make(scene);
  other->advance(moved(by, at(0)));
  method->advance(at(0));
  // Further on the symmetric tube buckles, and rounding decides to which side.
  for (int degree = 1; degree <= 25; ++degree) {
    method->advance(at(radians(degree)));
    other->advance(moved(by, at(radians(degree))));
  }
  Frame expected = shape();
  EXPECT_GT(farthest(expected, capture_frame(scene, at(0))), 0.01) << "nothing moved";
  Points& points = expected.muscles[0].points;
  points = ((by.linear() * points).colwise() + by.translation()).eval();
  EXPECT_LT(farthest(frame_of(*other, {}, 0), expected), 1e-5);
}

TEST_P(Method, gives_the_same_bits_for_any_number_of_threads) {
  std::vector<std::uint64_t> hashes;
  for (int threads : {1, 2, 64}) {
    const ThreadLimit limit(threads);
    const auto fresh = GetParam().make(scene);
    for (int degree = 5; degree <= 45; degree += 5) fresh->advance(at(radians(degree)));
    hashes.push_back(hash_of_shapes(frame_of(*fresh, {}, 0)));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST_P(Method, stays_finite_through_any_jump_or_says_that_it_does_not) {
  std::mt19937 generator(17);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  const auto random_body = [&] {
    const Vec3 axis(uniform(generator), uniform(generator), uniform(generator));
    const Vec3 shift(uniform(generator), uniform(generator), uniform(generator));
    return RigidTransform(Eigen::Translation3d(0.1 * shift) *
                          Eigen::AngleAxisd(pi * uniform(generator), axis.normalized()));
  };
  std::vector<Pose> poses = {at(pi), at(0), at(-pi), at(pi), at(-pi / 2)};
  for (int i = 0; i < 10; ++i) {
    poses.push_back(at(0));
    poses.back().bodies = {random_body(), random_body()};
  }
  for (const Pose& pose : poses) {
    try {
      method->advance(pose);
    } catch (const QualityError&) {
      EXPECT_FALSE(GetParam().carries_free_vertices) << "only the published setting may break";
    }
    EXPECT_TRUE(is_finite(shape()));
  }
}

TEST_P(Method, reset_returns_to_the_capture_and_forgets_all) {
  const auto run = [&] {
    for (int degree = 6; degree <= 30; degree += 6) method->advance(at(radians(degree)));
    return hash_of_shapes(shape());
  };
  const std::uint64_t first = run();
  method->reset();
  EXPECT_LT(farthest(shape(), capture_frame(scene, at(0))), 1e-8);
  EXPECT_EQ(run(), first);
}

TEST_P(Method, restored_goes_on_as_if_never_interrupted) {
  Frame before, last;
  std::vector<Pose> poses = {at(0)};
  for (int degree = 1; degree <= 20; ++degree) {
    poses.push_back(at(radians(degree)));
    method->advance(poses.back());
    before = last;
    last = frame_of(*method, at(radians(degree)), degree);
  }
  const auto resumed = GetParam().make(scene);
  resumed->restore(poses, before, last);
  for (int degree = 21; degree <= 24; ++degree) {
    method->advance(at(radians(degree)));
    resumed->advance(at(radians(degree)));
  }
  const Frame expected = shape(), found = frame_of(*resumed, {}, 0);
  EXPECT_GT(farthest(expected, last), 0.003) << "nothing moved";
  EXPECT_EQ(hash_of_shapes(found), hash_of_shapes(expected));
}

TEST_P(Method, a_coordinate_that_is_not_finite_is_an_error_that_names_the_muscle_and_changes_nothing) {
  method->advance(at(0.1));
  const std::uint64_t good = hash_of_shapes(shape());
  Pose broken = at(0.2);
  broken.bodies[1].translation().x() = std::numeric_limits<Real>::quiet_NaN();
  try {
    method->advance(broken);
    FAIL() << "no error";
  } catch (const QualityError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("muscle tube"));
    EXPECT_EQ(error.code(), ExitCode::quality);
  }
  EXPECT_EQ(hash_of_shapes(shape()), good);
  EXPECT_NO_THROW(method->advance(at(0.2)));
}

TEST_P(Method, reports_every_muscle) {
  const StepReport report = method->advance(at(0.02));
  ASSERT_EQ(report.muscles.size(), scene.muscles.size());
  EXPECT_EQ(report.muscles[0].iterations, GetParam().xpbd.iterations * GetParam().xpbd.substeps);
  EXPECT_GT(report.muscles[0].milliseconds, 0);
  EXPECT_GT(report.muscles[0].largest_correction, 0);
}

INSTANTIATE_TEST_SUITE_P(Methods, Method, ::testing::ValuesIn(all_variants()),
                         [](const auto& variant) { return variant.param.name; });

}  // namespace gracilis
