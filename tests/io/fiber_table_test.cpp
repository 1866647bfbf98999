#include <gracilis/io/tables/fiber_table.hpp>

#include <gtest/gtest.h>

#include <sstream>

namespace gracilis {

TEST(FiberTable, angles_are_in_degrees_and_translations_in_metres_as_opensim_has_them) {
  Scene scene;
  scene.bodies = {"base", "sled"};
  JointAxis slide{"slide", Vec3::UnitX(), 0, -1, 1};
  slide.translation = true;
  scene.joints = {{"rail", 0, 1, RigidTransform::Identity(), {slide, {"turn", Vec3::UnitZ(), 0, -1, 1}}}};
  Pose pose;
  pose.time = 2;
  pose.coordinates = {0.25, radians(30)};
  std::istringstream row(fiber_lengths_row(scene, pose, {}));
  Real time = 0, length = 0, angle = 0;
  row >> time >> length >> angle;
  EXPECT_EQ(time, 2);
  EXPECT_EQ(length, 0.25);
  EXPECT_NEAR(angle, 30, 1e-12);
}

}  // namespace gracilis
