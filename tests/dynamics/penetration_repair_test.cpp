#include <gracilis/dynamics/contact/surface/penetration_repair.hpp>

#include <shapes.hpp>

#include "meeting_surfaces.hpp"
#include "millimeter.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis {
namespace {

using Eigen::Vector3f;

constexpr float ball_radius = 10 * mm;
/// Off the axis, so that no particle of the second ball lies deep in what is drawn out of the first.
const Vector3f second_center(20.2f * mm, 0.6f * mm, 0.3f * mm);

/// The particle of a ball about `center` that is nearest to `place`.
Index nearest_particle(const Particles& particles, const Vector3f& place) {
  Index nearest = 0;
  for (Index p = 0; p < particles.count(); ++p)
    if ((particles.position(p) - place).norm() < (particles.position(nearest) - place).norm()) nearest = p;
  return nearest;
}

/// Two balls of 10 mm beside each other, of the first of which one particle has been drawn so deep (m) into the second.
struct DrawnIn {
  Meeting meeting;
  Index drawn = 0;

  explicit DrawnIn(float depth, float first_inverse_mass = 1, float second_inverse_mass = 1) {
    meeting.add(shapes::sphere(Vec3::Zero(), static_cast<Real>(ball_radius), 4), static_cast<Real>(first_inverse_mass));
    meeting.add(shapes::sphere(second_center.cast<Real>(), static_cast<Real>(ball_radius), 4),
                static_cast<Real>(second_inverse_mass));
    meeting.pair(0, 1, 0.3f * mm);
    meeting.prepare();
    drawn = nearest_particle(meeting.particles[0], {ball_radius, 0, 0});
    meeting.particles[0].position(drawn).x() += 0.2f * mm + depth;
  }
  /// As if the two had lain so deep (m) in each other at rest around one of the first ball's particles.
  void lie_at_rest(float depth, Index particle) {
    std::vector<float>& deepest = meeting.world.pairs[0].first_deepest;
    deepest.assign(static_cast<std::size_t>(meeting.particles[0].count()), 0);
    deepest[static_cast<std::size_t>(particle)] = depth;
  }
  std::vector<char> repair() {
    meeting.find();
    meeting.follow();
    return repair_penetrations(meeting.world, meeting.state, meeting.pointers<Particles*>(meeting.particles));
  }
  float moved(std::size_t surface, Index particle, const std::vector<Particles>& before) const {
    return (meeting.particles[surface].position(particle) - before[surface].position(particle)).norm();
  }
  /// How deep the particle lies in the second ball, m, by its faces.
  float depth() {
    meeting.find();
    meeting.follow();
    for (const VertexFaceCandidate& candidate : meeting.state.candidates[0].near_second)
      if (candidate.particle == drawn) return -candidate.distance;
    return 0;
  }
  /// The largest strain that moving has added to any edge of a surface.
  float added_strain(std::size_t surface, const std::vector<Particles>& before) const {
    float largest = 0;
    for (const ContactSurface::Edge& edge : meeting.world.surfaces[surface].edges) {
      const auto length = [&](const Particles& particles) {
        return (particles.position(edge.ends[1]) - particles.position(edge.ends[0])).norm();
      };
      const float rest =
          (meeting.world.rest[surface].col(edge.ends[1]) - meeting.world.rest[surface].col(edge.ends[0])).norm();
      largest = std::max(largest, (length(meeting.particles[surface]) - length(before[surface])) / rest);
    }
    return largest;
  }
};

}  // namespace

TEST(PenetrationRepair, a_particle_drawn_deep_into_another_surface_comes_out_half_of_the_way_each) {
  DrawnIn balls(2 * mm);
  const float depth = balls.depth();
  const std::vector<Particles> before = balls.meeting.particles;
  EXPECT_EQ(balls.repair(), (std::vector<char>{1, 1}));
  EXPECT_NEAR(balls.moved(0, balls.drawn, before), depth / 2, 0.01f * mm);
  EXPECT_LT(balls.depth(), 0.5f * mm);
}

TEST(PenetrationRepair, what_lies_around_goes_along_so_that_no_edge_is_stretched_far) {
  DrawnIn balls(2 * mm);
  const float depth = balls.depth();
  const std::vector<Particles> before = balls.meeting.particles;
  balls.repair();
  float farthest = 0;
  for (Index p = 0; p < before[1].count(); ++p) farthest = std::max(farthest, balls.moved(1, p, before));
  EXPECT_NEAR(farthest, depth / 2, 0.01f * mm);
  // Ways of d fade out over 4 d, so their slope is a quarter.
  EXPECT_LT(balls.added_strain(1, before), 0.26f);
  const Index far = nearest_particle(before[1], second_center + Vector3f(0, ball_radius, 0));
  EXPECT_EQ(balls.moved(1, far, before), 0);
}

TEST(PenetrationRepair, what_cannot_move_leaves_all_of_the_way_to_the_other) {
  DrawnIn balls(2 * mm, 1, 0);
  const float depth = balls.depth();
  const std::vector<Particles> before = balls.meeting.particles;
  EXPECT_EQ(balls.repair(), (std::vector<char>{1, 0}));
  EXPECT_NEAR(balls.moved(0, balls.drawn, before), depth, 0.01f * mm);
  EXPECT_EQ(balls.meeting.particles[1].xyzw, before[1].xyzw);
}

TEST(PenetrationRepair, an_attached_particle_stays_as_deep_as_its_bone_takes_it) {
  DrawnIn balls(2 * mm, 0, 1);
  const std::vector<Particles> before = balls.meeting.particles;
  EXPECT_TRUE(balls.repair().empty());
  EXPECT_EQ(balls.meeting.particles[1].xyzw, before[1].xyzw);
}

TEST(PenetrationRepair, what_is_hardly_in_is_left_to_contact) {
  DrawnIn balls(0.4f * mm);
  const std::vector<Particles> before = balls.meeting.particles;
  EXPECT_TRUE(balls.repair().empty());
  EXPECT_EQ(balls.meeting.particles[0].xyzw, before[0].xyzw);
}

TEST(PenetrationRepair, surfaces_that_lay_in_each_other_at_rest_may_lie_as_deep_there) {
  for (const float deepest : {1.0f * mm, 3.0f * mm}) {
    DrawnIn balls(2 * mm);
    balls.lie_at_rest(deepest, balls.drawn);
    const float depth = balls.depth();
    const std::vector<Particles> before = balls.meeting.particles;
    EXPECT_EQ(balls.repair().empty(), deepest > depth);
    EXPECT_NEAR(balls.moved(0, balls.drawn, before), std::max(depth - deepest, 0.0f) / 2, 0.01f * mm);
  }
}

TEST(PenetrationRepair, what_lay_in_each_other_elsewhere_excuses_nothing) {
  DrawnIn balls(2 * mm);
  balls.lie_at_rest(3 * mm, nearest_particle(balls.meeting.particles[0], {-ball_radius, 0, 0}));
  EXPECT_FALSE(balls.repair().empty());
  EXPECT_LT(balls.depth(), 0.5f * mm);
}

TEST(PenetrationRepair, what_lay_in_the_other_at_rest_comes_out_to_where_it_lay) {
  DrawnIn balls(2 * mm);
  balls.meeting.world.pairs[0].first_overlaps.assign(static_cast<std::size_t>(balls.meeting.particles[0].count()), 1);
  balls.lie_at_rest(1 * mm, balls.drawn);
  const float depth = balls.depth();
  const std::vector<Particles> before = balls.meeting.particles;
  balls.repair();
  EXPECT_NEAR(balls.moved(0, balls.drawn, before), (depth - 1 * mm) / 2, 0.01f * mm);
}

TEST(PenetrationRepair, what_the_winding_number_finds_outside_is_left_although_the_nearest_face_looks_away) {
  // The second ball is turned inside out: its faces say that all around it is inside.
  TriangleMesh everted = shapes::sphere(second_center.cast<Real>(), static_cast<Real>(ball_radius), 4);
  everted.faces.row(0).swap(everted.faces.row(1));
  Meeting meeting;
  meeting.add(shapes::sphere(Vec3::Zero(), static_cast<Real>(ball_radius), 4));
  meeting.add(everted);
  meeting.pair(0, 1, 0.3f * mm);
  meeting.prepare();
  meeting.move(0, {-0.8f * mm, 0, 0});
  meeting.find();
  meeting.follow();
  const std::vector<VertexFaceCandidate>& near = meeting.state.candidates[0].near_second;
  ASSERT_TRUE(std::any_of(near.begin(), near.end(), [](const auto& each) { return each.distance < -0.5f * mm; }));
  EXPECT_TRUE(
      repair_penetrations(meeting.world, meeting.state, meeting.pointers<Particles*>(meeting.particles)).empty());
}

TEST(PenetrationRepair, the_same_particle_seen_from_either_side_of_a_pair_comes_out_alike) {
  DrawnIn balls(2 * mm);
  DrawnIn swapped(2 * mm);
  std::swap(swapped.meeting.world.pairs[0].first, swapped.meeting.world.pairs[0].second);
  swapped.meeting.prepare();
  balls.repair();
  EXPECT_EQ(swapped.repair(), (std::vector<char>{1, 1}));
  EXPECT_EQ(balls.meeting.particles[0].xyzw, swapped.meeting.particles[0].xyzw);
  EXPECT_EQ(balls.meeting.particles[1].xyzw, swapped.meeting.particles[1].xyzw);
}

}  // namespace gracilis
