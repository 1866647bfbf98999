#include <gracilis/core/errors.hpp>
#include <gracilis/io/tables/force_table.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "run_table_read_back.hpp"

namespace gracilis {
namespace {

FrameRecord record_with_forces(const Scene& scene, Real angle) {
  FrameRecord record;
  record.frame.pose = flexed(scene, angle);
  MuscleForces& forces = record.forces.emplace_back();
  forces.is_known = true;
  forces.tension = 120;
  forces.fiber_tensions = {70, 50};
  forces.origin = {{0, {{0, 0, -120}, {1, 2, 3}}}};
  forces.insertion = {{1, {{5, 6, 7}, {0.1, 0.2, 0.3}}}};
  forces.contact = {{0, {}}, {1, {{2, 0, 0}, {0, 0, 0}}}};
  forces.moments = {1.5};
  forces.moments_by_work = {1.4};
  return record;
}

TEST(ForceTable, names_bodies_bones_fibers_and_coordinates) {
  const Scene scene = tube_scene();
  const FrameRecord record = record_with_forces(scene, radians(30));
  const std::optional<RunTable> table = force_table(scene, record, 1);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->name, "forces.sto");
  const Table read = read_back(*table);
  EXPECT_NEAR(value(read, "flexion"), 30, 1e-9);
  EXPECT_EQ(value(read, "tube_tension"), 120);
  EXPECT_EQ(value(read, "tube_f001_tension"), 50);
  EXPECT_EQ(value(read, "tube_origin_on_upper_force_z"), -120);
  EXPECT_EQ(value(read, "tube_origin_on_upper_moment_y"), 2);  // this body has not moved
  const Vec3 origin = record.frame.pose.bodies[1].translation(), force(5, 6, 7);
  const Vec3 moment = Vec3(0.1, 0.2, 0.3) - origin.cross(force);
  EXPECT_NEAR(value(read, "tube_insertion_on_lower_moment_x"), moment.x(), 1e-8);
  EXPECT_EQ(value(read, "tube_contact_on_lower_force_x"), 2);
  EXPECT_EQ(value(read, "tube_moment_flexion"), 1.5);
  EXPECT_EQ(value(read, "tube_moment_by_work_flexion"), 1.4);
}

TEST(ForceTable, what_is_not_finite_is_no_zero) {
  const Scene scene = tube_scene();
  FrameRecord record = record_with_forces(scene, 0);
  record.forces[0].fiber_tensions[1] = std::nan("");
  try {
    force_table(scene, record, 1);
    FAIL() << "took it for a force";
  } catch (const QualityError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("tube_f001_tension is not finite at 0 s"));
  }
}

TEST(ForceTable, there_is_none_where_no_method_knows_forces) {
  const Scene scene = tube_scene();
  FrameRecord record = record_with_forces(scene, 0);
  record.forces[0].is_known = false;
  EXPECT_FALSE(force_table(scene, record, 1));
  record.forces.clear();
  EXPECT_FALSE(force_table(scene, record, 1));
}

}  // namespace
}  // namespace gracilis
