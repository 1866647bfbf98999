#include <gracilis/dynamics/constraints/slivers.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace gracilis {

/// A flat strip: two long triangles below and above the x axis; between them a sliver whose tip is particle 4, `height`
/// above the middle of the side from 0 to 1.
struct Strip {
  Eigen::Matrix3Xi faces{3, 4};
  Particles rest;

  explicit Strip(Real height) {
    faces << 0, 0, 4, 0,  //
        2, 1, 1, 4,       //
        1, 4, 3, 3;
    Points points(3, 5);
    points.col(0) = Vec3(0, 0, 0), points.col(1) = Vec3(0.01, 0, 0), points.col(2) = Vec3(0.005, -0.01, 0);
    points.col(3) = Vec3(0.005, 0.01, 0), points.col(4) = Vec3(0.005, height, 0);
    rest = make_particles(points, Eigen::VectorXd::Ones(5));
  }
};

/// Tips come back by and by: as often as it takes from twice their height.
void settle_slivers(const SliverSet& set, Particles& particles) {
  for (int time = 0; time < 20; ++time) project_slivers(set, particles);
}

TEST(Slivers, are_triangles_flatter_than_asked_for) {
  EXPECT_EQ(build_sliver_set(Strip(0.0005).faces, Strip(0.0005).rest, 0.1f).tips.size(), 1u);
  EXPECT_TRUE(build_sliver_set(Strip(0.004).faces, Strip(0.004).rest, 0.1f).tips.empty());
}

TEST(Slivers, know_their_tip_by_the_opposite_longest_side) {
  const Strip strip(0.0005);
  const SliverTip tip = build_sliver_set(strip.faces, strip.rest, 0.1f).tips.at(0);
  EXPECT_EQ(tip.particle, 4);
  EXPECT_EQ(tip.a + tip.b, 1);
  EXPECT_NEAR(tip.share, 0.5, 1e-6);
  EXPECT_NEAR(tip.offset.norm(), 0.0005, 1e-8);
}

TEST(Slivers, know_where_their_tip_is_beside_its_side_wherever_the_surface_lies) {
  Strip strip(0.0005);
  strip.rest.position(4).x() = 0.0025f;
  for (Index p = 0; p < strip.rest.count(); ++p) strip.rest.position(p) += Eigen::Vector3f(0.1f, -0.2f, 0.3f);
  const SliverTip tip = build_sliver_set(strip.faces, strip.rest, 0.1f).tips.at(0);
  // Places of 0.3 m are known to 3e-8 m, a side of 0.01 m hence to 3e-6 of its length.
  EXPECT_NEAR(tip.a == 0 ? tip.share : 1 - tip.share, 0.25, 1e-5);
  EXPECT_NEAR(tip.offset.norm(), 0.0005, 1e-7);
}

TEST(Slivers, at_rest_nothing_moves) {
  const Strip strip(0.0005);
  Particles particles = strip.rest;
  project_slivers(build_sliver_set(strip.faces, strip.rest, 0.1f), particles);
  EXPECT_EQ(largest_motion(strip.rest, particles), 0);
}

TEST(Slivers, a_tip_that_turned_over_its_side_comes_back_and_the_side_stays) {
  const Strip strip(0.0005);
  const SliverSet set = build_sliver_set(strip.faces, strip.rest, 0.1f);
  for (const Vec3& over : {Vec3(0, -0.001, 0), Vec3(0, -0.0005, 0.002), Vec3(0.001, -0.0008, -0.001)}) {
    Particles particles = strip.rest;
    particles.position(4) += over.cast<float>();
    settle_slivers(set, particles);
    for (Index p = 0; p < 4; ++p) EXPECT_EQ(particles.position(p), strip.rest.position(p));
    EXPECT_GT(particles.position(4).y(), 0) << over.transpose();
  }
}

TEST(Slivers, turn_with_the_surface) {
  const Strip strip(0.0005);
  const SliverSet set = build_sliver_set(strip.faces, strip.rest, 0.1f);
  const Eigen::Matrix3f turn = Eigen::AngleAxisf(2, Eigen::Vector3f(1, 2, 3).normalized()).toRotationMatrix();
  Particles turned = strip.rest;
  for (Index p = 0; p < turned.count(); ++p) turned.position(p) = turn * strip.rest.position(p);
  const Particles before = turned;
  project_slivers(set, turned);
  EXPECT_LT(largest_motion(before, turned), 1e-7);
}

TEST(Slivers, a_fixed_side_stays_and_a_sliver_of_fixed_particles_is_left_out) {
  Strip strip(0.0005);
  for (const Index end : {0, 1}) strip.rest.at(end)[3] = 0;
  Particles particles = strip.rest;
  particles.position(4).y() = -0.001f;
  settle_slivers(build_sliver_set(strip.faces, strip.rest, 0.1f), particles);
  EXPECT_EQ(particles.position(0), strip.rest.position(0));
  EXPECT_EQ(particles.position(1), strip.rest.position(1));
  EXPECT_NEAR(particles.position(4).y(), 0.00025, 1e-7);
  strip.rest.at(4)[3] = 0;
  EXPECT_TRUE(build_sliver_set(strip.faces, strip.rest, 0.1f).tips.empty());
}

TEST(Slivers, a_side_comes_to_a_fixed_tip) {
  Strip strip(0.0005);
  strip.rest.at(4)[3] = 0;
  Particles particles = strip.rest;
  for (const Index end : {0, 1}) particles.position(end).y() = 0.001f;
  settle_slivers(build_sliver_set(strip.faces, strip.rest, 0.1f), particles);
  EXPECT_EQ(particles.position(4), strip.rest.position(4));
  for (const Index end : {0, 1}) EXPECT_NEAR(particles.position(end).y(), 0.00025, 1e-7);
}

TEST(Slivers, the_ends_of_a_side_share_the_way_to_a_fixed_tip_by_their_shares_and_inverse_masses) {
  Strip strip(0.0005);
  strip.rest.position(4).x() = 0.004f;
  strip.rest.at(4)[3] = 0;
  strip.rest.at(0)[3] = 2, strip.rest.at(1)[3] = 5;
  const SliverSet set = build_sliver_set(strip.faces, strip.rest, 0.1f);
  Particles particles = strip.rest;
  // The whole strip is raised by 0.6 mm: the tip lies 0.1 mm on the wrong side, and 0.35 mm are missing, of which a
  // fiftieth of the side comes at once.
  for (const Index p : {0, 1, 2, 3}) particles.position(p).y() += 0.0006f;
  project_slivers(set, particles);
  const float first = 0.0006f - particles.position(0).y(), second = 0.0006f - particles.position(1).y();
  EXPECT_NEAR(second / first, 0.4 * 5 / (0.6 * 2), 1e-3);
  EXPECT_NEAR(0.6f * first + 0.4f * second, 0.0002f, 1e-7f) << "where the tip belongs";
}

TEST(Slivers, neither_end_is_thrown_where_the_other_is_fixed) {
  for (const Index near : {0, 1}) {
    Strip strip(0.0005);
    strip.rest.position(4).x() = near == 1 ? 0.0097f : 0.0003f;
    strip.rest.at(4)[3] = strip.rest.at(near)[3] = 0;
    strip.rest.at(1 - near)[3] = 3;
    Particles particles = strip.rest;
    for (const Index p : {0, 1, 2, 3}) particles.position(p).y() += 0.001f;
    const Eigen::Vector3f before = particles.position(1 - near);
    project_slivers(build_sliver_set(strip.faces, strip.rest, 0.1f), particles);
    EXPECT_NEAR((particles.position(1 - near) - before).norm(), 2 * 0.0002, 2e-6) << "twice the longest push";
  }
}

TEST(Slivers, are_flat_against_their_own_side_or_against_the_surfaces_mean_one) {
  // A triangle with its tip, particle 2, so high over a side along x, and another one below that side.
  const auto is_sliver = [](Real side, Real height, Real below) {
    Points points(3, 4);
    points << 0, side, side / 2, side / 2, 0, 0, height, -below, 0, 0, 0, 0;
    const Eigen::Matrix3Xi faces = (Eigen::Matrix3Xi(3, 2) << 0, 1, 1, 0, 2, 3).finished();
    const SliverSet set = build_sliver_set(faces, make_particles(points, Eigen::VectorXd::Ones(4)), 0.1f);
    return std::any_of(set.tips.begin(), set.tips.end(), [](const SliverTip& tip) { return tip.particle == 2; });
  };
  EXPECT_TRUE(is_sliver(3, 2.5, 100)) << "the mean side is 35 long";
  EXPECT_FALSE(is_sliver(3, 2.5, 20));
  EXPECT_TRUE(is_sliver(400, 35, 300)) << "a tenth of its side is 40, of the mean one 32";
  EXPECT_FALSE(is_sliver(400, 45, 300));
}

TEST(Slivers, where_tip_and_near_end_are_fixed_the_far_end_is_not_thrown_away) {
  Strip strip(0.0005);
  strip.rest.position(4).x() = 0.0097f;  // 3 % of the side from particle 1
  strip.rest.at(4)[3] = strip.rest.at(1)[3] = 0;
  Particles particles = strip.rest;
  const Eigen::Vector3f lifted(0, 0.001f, 0);
  particles.position(0) += lifted, particles.position(1) += lifted;
  const Eigen::Vector3f before = particles.position(0);
  project_slivers(build_sliver_set(strip.faces, strip.rest, 0.1f), particles);
  const float moved = (particles.position(0) - before).norm();
  EXPECT_GT(moved, 0.0001f);
  EXPECT_LT(moved, 0.00041f) << "twice the longest push; 33 times would serve the tip at once";
}

TEST(Slivers, a_tip_that_was_torn_away_comes_back_by_a_fiftieth_of_its_side_at_once) {
  const Strip strip(0.0005);
  const SliverSet set = build_sliver_set(strip.faces, strip.rest, 0.1f);
  Particles particles = strip.rest;
  particles.position(4).y() = -0.02f;
  project_slivers(set, particles);
  EXPECT_NEAR(particles.position(4).y(), -0.0198f, 1e-7);
  for (int time = 0; time < 150; ++time) project_slivers(set, particles);
  EXPECT_GT(particles.position(4).y(), 0);
}

/// A net of flat triangles, crumpled as far as asked for: many slivers beside each other.
Particles crumpled_net(Index columns, Index rows, float by, Eigen::Matrix3Xi& faces) {
  faces.resize(3, 2 * (columns - 1) * (rows - 1));
  Points points(3, columns * rows);
  for (Index row = 0; row < rows; ++row)
    for (Index column = 0; column < columns; ++column) {
      const Index p = row * columns + column;
      points.col(p) = Vec3(0.002 * static_cast<Real>(column) + 0.0009 * static_cast<Real>(row % 2),
                           0.00012 * static_cast<Real>(row), 0);
      if (row + 1 == rows || column + 1 == columns) continue;
      const Index face = 2 * (row * (columns - 1) + column);
      faces.col(face) << p, p + 1, p + columns;
      faces.col(face + 1) << p + 1, p + columns + 1, p + columns;
    }
  Eigen::VectorXd inverse_masses = Eigen::VectorXd::Ones(points.cols());
  for (Index p = 0; p < points.cols(); p += 7) inverse_masses[p] = 0;
  Particles particles = make_particles(points, inverse_masses);
  for (Index p = 0; p < particles.count(); ++p)
    particles.position(p) +=
        by * Eigen::Vector3f(std::sin(37.0f * static_cast<float>(p)), std::sin(91.0f * static_cast<float>(p)),
                             std::sin(53.0f * static_cast<float>(p)));
  return particles;
}

TEST(Slivers, in_groups_give_bit_by_bit_what_they_give_one_after_the_other) {
  Eigen::Matrix3Xi faces;
  const Particles rest = crumpled_net(30, 30, 0, faces);
  const SliverSet set = build_sliver_set(faces, rest, 0.1f);
  EXPECT_GT(set.tips.size(), 1000u);
  EXPECT_LT(set.groups.size(), set.tips.size() / 4);
  for (const float by : {1e-6f, 1e-5f, 1e-4f, 1e-3f}) {
    Particles grouped = crumpled_net(30, 30, by, faces), alone = grouped;
    for (int time = 0; time < 10; ++time) {
      project_slivers(set, grouped);
      for (const SliverTip& tip : set.tips) project_sliver(set, tip, alone);
    }
    EXPECT_EQ(grouped.xyzw, alone.xyzw) << by;
  }
}

TEST(Slivers, of_no_length_at_all_are_survived) {
  Strip strip(0);
  strip.rest.position(1) = strip.rest.position(0);
  strip.rest.position(4) = strip.rest.position(0);
  Particles particles = strip.rest;
  project_slivers(build_sliver_set(strip.faces, strip.rest, 0.1f), particles);
  for (Index p = 0; p < particles.count(); ++p) EXPECT_TRUE(particles.position(p).allFinite());
}

}  // namespace gracilis
