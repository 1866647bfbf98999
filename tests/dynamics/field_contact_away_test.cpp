#include <gracilis/dynamics/contact/field/field_contact_away.hpp>
#include <gracilis/dynamics/solver/bone_contact.hpp>

#include "systems_for_tests.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {
namespace {

FieldPlacement placed(float angle, const Eigen::Vector3f& translation) {
  FieldPlacement placement;
  placement.rotation = Eigen::AngleAxisf(angle, Eigen::Vector3f(1, 2, -1).normalized()).toRotationMatrix();
  placement.translation = translation;
  return placement;
}

TEST(FarSurfaces, no_point_of_a_box_is_carried_farther_than_told) {
  const Eigen::AlignedBox3f box(Eigen::Vector3f(-0.1f, 0, 0.05f), Eigen::Vector3f(0.2f, 0.1f, 0.3f));
  const FieldPlacement from = placed(0.1f, {0, 0.01f, 0}), to = placed(0.4f, {0.02f, 0, 0.01f});
  const float most = carried(from, to, box);
  float farthest = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto at = [&](float number) { return 0.5f + 0.5f * std::sin(number * static_cast<float>(i)); };
    const Eigen::Vector3f x = box.min() + box.sizes().cwiseProduct(Eigen::Vector3f(at(37), at(91), at(53)));
    farthest = std::max(farthest, (to.to_obstacle(x) - from.to_obstacle(x)).norm());
  }
  EXPECT_LE(farthest, most);
  EXPECT_GT(farthest, 0.5f * most);
}

TEST(FarSurfaces, a_box_is_carried_as_far_as_the_corner_that_goes_farthest) {
  const Eigen::AlignedBox3f box(Eigen::Vector3f(-0.1f, 0, 0.05f), Eigen::Vector3f(0.2f, 0.1f, 0.3f));
  for (int way = 0; way < 24; ++way) {
    // Turns about all corners and diagonals, so that each corner is the farthest once.
    const Eigen::Vector3f still = box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(way % 8));
    FieldPlacement to;
    to.rotation = Eigen::AngleAxisf(0.3f, Eigen::Vector3f::Unit(way / 8)).toRotationMatrix();
    to.translation = still - to.rotation * still;
    float farthest = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3f x = box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner));
      farthest = std::max(farthest, (to.to_obstacle(x) - x).norm());
    }
    EXPECT_NEAR(carried(FieldPlacement(), to, box), farthest, 1e-6f);
  }
  EXPECT_EQ(carried(FieldPlacement(), FieldPlacement(), box), 0);
}

TEST(FarSurfaces, know_how_far_they_went_and_how_far_they_are_at_least) {
  const Particles from = make_particles((Points(3, 2) << 0, 1, 0, 0, 0, 0).finished(), Eigen::Vector2d::Ones());
  Particles to = from;
  to.position(1) += Eigen::Vector3f(0, 0.3f, 0.4f);
  const SurfaceMotion motion = surface_motion(from, to);
  EXPECT_NEAR(motion.farthest, 0.5f, 1e-6f);
  EXPECT_EQ(motion.box.min(), Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(motion.box.max(), Eigen::Vector3f(1, 0.3f, 0.4f));
  EXPECT_EQ(surface_motion(Particles(), to).farthest, std::numeric_limits<float>::infinity()) << "nobody knows";
  FieldPlacement shifted;
  shifted.translation = Eigen::Vector3f(0, 0, 0.25f);
  Away away;
  away.distance = 2;
  // Fields may fall by a tenth more than the way.
  EXPECT_NEAR(away_after(motion, shifted, away), 2 - 1.1f * (0.5f + 0.25f), 1e-6f);
}

/// A ball of particles and one as obstacle, whose field ends 2 cm from it.
struct TwoBalls {
  DistanceField field = field_of_ball(0.03, 101);
  SurfaceSystem system = system_of(shapes::sphere(Vec3::Zero(), 0.02, 2));
  SurfaceState state;

  TwoBalls() {
    const auto count = static_cast<std::size_t>(system.rest.count());
    FieldContactSet contact;
    contact.field = bounded(field);
    contact.captured.particle.assign(count, 0.0005f);
    contact.captured.edge_sag.assign(system.distances.rest_length.size(), 0);
    contact.released = contact.captured;
    system.contacts.push_back(contact);
    state = make_state(system);
  }
  std::vector<Index> listed_at(float away) {
    refresh_contacts(system, {placed(0, {away, 0, 0})}, state);
    return state.near[0].particles;
  }
};

TEST(FarSurfaces, that_come_near_are_listed_as_if_they_had_been_looked_at_all_the_time) {
  TwoBalls seldom;
  for (const float away : {0.5f, 0.45f, 0.3f, 0.2f, 0.12f, 0.07f, 0.056f, 0.052f, 0.2f, 0.4f, 0.053f}) {
    TwoBalls anew;
    EXPECT_EQ(seldom.listed_at(away), anew.listed_at(away)) << away;
    EXPECT_EQ(seldom.state.near[0].edges.a, anew.state.near[0].edges.a) << away;
  }
  EXPECT_FALSE(seldom.state.near[0].particles.empty());
}

}  // namespace
}  // namespace gracilis
