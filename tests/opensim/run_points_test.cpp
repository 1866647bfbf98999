#include "opensim/model_texts.hpp"

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/opensim/export/run_points.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis::opensim {

/// A pendulum swung through an angle, and fibers of five points from the ground to the rod that bow out while it turns.
struct SwungFibers {
  Model model = model_from(pendulum());
  std::vector<Real> angles;
  std::vector<Points> fibers;
  std::vector<std::vector<RigidTransform>> poses;

  SwungFibers() {
    Skeleton skeleton(model);
    for (int f = 0; f <= 28; ++f) {
      angles.push_back(-0.7 + 0.05 * f);
      skeleton.place(Eigen::VectorXd::Constant(1, angles.back()));
      poses.push_back(skeleton.poses());
      const Vec3 from(0.2, 0.1, 0), to = poses.back()[1] * Vec3(0.05, -0.3, 0);
      Points fiber(3, 5);
      for (int p = 0; p < 5; ++p)
        fiber.col(p) = from + p / 4.0 * (to - from) + 0.05 * angles.back() * std::sin(pi * p / 4) * Vec3::UnitZ();
      fibers.push_back(fiber);
    }
  }

  Real largest_error(const Path& path) const {
    Skeleton skeleton(model);
    Real largest = 0;
    for (std::size_t f = 0; f < fibers.size(); ++f) {
      const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, angles[f]);
      skeleton.place(q);
      largest = std::max(largest, std::abs(measure_path(skeleton, path, q).length - polyline_length(fibers[f])));
    }
    return largest;
  }
};

TEST(RunPoints, ends_stay_with_the_bodies_that_they_move_with) {
  const SwungFibers run;
  const std::vector<FiberPoint> points = fit_points(run.fibers, run.poses, {});
  EXPECT_EQ(points.front().body, 0);
  EXPECT_EQ(points.back().body, 1);
  EXPECT_TRUE(points.back().location.isApprox(Vec3(0.05, -0.3, 0), 1e-12));
  EXPECT_LT(points.back().moves, 1e-12);
  EXPECT_GT(points[2].moves, 0.005);
}

TEST(RunPoints, points_that_move_with_the_only_coordinate_give_the_runs_lengths) {
  const SwungFibers run;
  const Path still = path_of(fit_points(run.fibers, run.poses, {}), -1);
  const Path moving = path_of(fit_points(run.fibers, run.poses, run.angles), 0);
  EXPECT_FALSE(still.points[2].moving);
  EXPECT_TRUE(moving.points[2].moving);
  EXPECT_FALSE(moving.points[4].moving);
  EXPECT_LT(run.largest_error(moving), 1e-4);  // 15 knots for 29 frames
  EXPECT_GT(run.largest_error(still), 1e-3);
}

TEST(RunPoints, what_is_written_is_read_back_with_the_same_lengths_and_parameters) {
  const SwungFibers run;
  Muscle muscle;
  muscle.name = "m";
  muscle.type = "Millard2012EquilibriumMuscle";
  muscle.max_isometric_force = 321;
  muscle.path = path_of(fit_points(run.fibers, run.poses, run.angles), 0);
  const Model read = model_from(pendulum(muscle_text(run.model, muscle)));
  ASSERT_EQ(read.muscles.size(), 1u);
  EXPECT_EQ(read.muscles[0].max_isometric_force, 321);
  EXPECT_EQ(read.muscles[0].type, muscle.type);
  EXPECT_TRUE(read.unsupported.empty());
  EXPECT_NEAR(run.largest_error(read.muscles[0].path), run.largest_error(muscle.path), 1e-9);
}

}  // namespace gracilis::opensim
