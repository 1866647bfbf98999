#include <gracilis/methods/registry.hpp>

#include <moved_scenes.hpp>
#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

/// Methods that ask distance fields in single precision, on a scene that stands kilometres from the origin.
namespace gracilis {
namespace {

class FarMethod : public ::testing::TestWithParam<const char*> {};

Points flexed_shape(const Scene& scene, const std::vector<DistanceField>& fields) {
  const auto method = make_method(scene, [&](const DistanceFieldSettings&) { return fields; });
  for (int degree = 5; degree <= 20; degree += 2) method->advance(flexed(scene, radians(degree)), usual_time_step);
  return frame_of(*method, flexed(scene, radians(20)), 1).muscles[0].points;
}

/// Fibers that lie nowhere symmetrically in the tube.
Polylines uneven_fibers() {
  std::vector<Points> lines;
  for (int i = 0; i < 40; ++i) {
    const Real angle = 2.4 * i, radius = 0.008 * std::sqrt((i + 0.5) / 40);
    const Vec3 across(0.0255 + radius * std::cos(angle), radius * std::sin(angle), 0);
    Points line(3, 2);
    line << across - 0.078 * Vec3::UnitZ(), across + 0.078 * Vec3::UnitZ();
    lines.push_back(line);
  }
  return join(lines);
}

TEST_P(FarMethod, deforms_as_at_the_origin) {
  Scene near = tube_scene();
  near.method.name = GetParam();
  // Which of the symmetric tube's fibers is nearest is decided by rounding.
  if (near.method.name == "pbd") near.method.settings["fiber_anisotropy"] = false;
  if (near.method.name == "mass-spring") near.muscles[0].given_fibers = uneven_fibers();
  const RigidTransform by = Eigen::Translation3d(8000, -16000, 800) * RigidTransform::Identity();
  const Scene far = moved(by, near);
  std::vector<DistanceField> far_fields = tube_fields();
  for (DistanceField& field : far_fields) field.origin += by.translation();
  const Points expected = flexed_shape(near, tube_fields()), found = flexed_shape(far, far_fields);
  EXPECT_GT((expected - near.muscles[0].surface.vertices).norm(), 0.1) << "nothing moved";
  // Doubles tell 4e-12 m there, floats 1 mm. Farther on the symmetric tube buckles, and rounding decides how.
  EXPECT_LT(((found.colwise() - by.translation()) - expected).colwise().norm().maxCoeff(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Methods, FarMethod, ::testing::Values("pbd", "arap", "rbf", "mass-spring"),
                         [](const auto& method) {
                           std::string name = method.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace gracilis
