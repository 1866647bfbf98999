#include <gracilis/core/parallel.hpp>
#include <gracilis/core/state_hash.hpp>
#include <gracilis/dynamics/contact/surface/surface_contact.hpp>

#include <shapes.hpp>

#include "meeting_surfaces.hpp"
#include "strips.hpp"

#include <gtest/gtest.h>

namespace gracilis {
namespace {

using Eigen::Vector3f;

Vec3 momentum(const std::vector<Particles>& now, const std::vector<Particles>& start) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t s = 0; s < now.size(); ++s)
    for (Index p = 0; p < now[s].count(); ++p)
      if (now[s].inverse_mass(p) > 0)
        sum += (now[s].position(p) - start[s].position(p)).cast<Real>() / static_cast<Real>(now[s].inverse_mass(p));
  return sum;
}

/// How deep the particles of one ball are in the other, m.
Real deepest(const Particles& probe, const Vec3& center) {
  Real depth = 0;
  for (Index p = 0; p < probe.count(); ++p)
    depth = std::max(depth, 0.01 - (probe.position(p).cast<Real>() - center).norm());
  return depth;
}

/// Two roofs, ridge over ridge: the lower's ridge lies along x, the upper's along y, so much (m) too low.
Meeting crossed_roofs(Real too_low) {
  const auto roof = [](Real ridge, Real eaves, bool along_x) {
    std::vector<Vec3> v = {{-0.02, 0, ridge},    {0.02, 0, ridge},     {-0.02, -0.01, eaves},
                           {0.02, -0.01, eaves}, {-0.02, 0.01, eaves}, {0.02, 0.01, eaves}};
    std::vector<Eigen::Vector3i> f = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4},
                                      {0, 4, 2}, {1, 3, 5}, {2, 4, 5}, {2, 5, 3}};
    if (!along_x)
      for (Vec3& p : v) p = Vec3(p.y(), p.x(), p.z());
    // Mirrored once per swap and once per turning upside down.
    if (along_x == (eaves > ridge))
      for (Eigen::Vector3i& t : f) std::swap(t[0], t[1]);
    return shapes::mesh_of(v, f);
  };
  Meeting meeting;
  meeting.add(roof(0, -0.01, true));
  meeting.add(roof(-too_low, 0.01, false));
  meeting.pair(0, 1, 0.0002f).reach = 0.03f;
  return meeting;
}

}  // namespace

TEST(SurfaceContact, every_push_counts_once_whichever_surface_it_is_on) {
  // Tips 0.1 mm above faces of a strip that are to keep 0.2 mm, away from the faces' sides.
  const Vec3 tip(0.0013, 0.0003, 0.0001), other_tip(0.0033, 0.0003, 0.0001);
  for (const bool is_first : {true, false})
    for (const bool both : {true, false}) {
      Meeting meeting;
      const TriangleMesh tips = both ? shapes::both(tetrahedron(tip), tetrahedron(other_tip)) : tetrahedron(tip);
      meeting.add(is_first ? tips : straight_strip(8));
      meeting.add(is_first ? straight_strip(8) : tips);
      meeting.pair(0, 1, 0.0002f);
      EXPECT_EQ(meeting.solve(1), both ? 2 : 1);
    }
}

TEST(SurfaceContact, leaves_alone_what_is_farther_than_the_gap) {
  Meeting meeting = pressed_balls(-0.001);
  EXPECT_EQ(meeting.solve(3), 0);
  EXPECT_EQ(meeting.particles[0].xyzw, meeting.start[0].xyzw);
}

TEST(SurfaceContact, pushes_two_balls_apart_equally_and_keeps_their_momentum) {
  Meeting meeting = pressed_balls(0.001);
  EXPECT_GT(deepest(meeting.particles[0], {0.019, 0.0003, 0.0002}), 0.0009);
  meeting.solve(40);
  EXPECT_LT(meeting.unrest(), 1e-6);
  Vec3 first = Vec3::Zero();
  for (Index p = 0; p < meeting.particles[0].count(); ++p)
    first += (meeting.particles[0].position(p) - meeting.start[0].position(p)).cast<Real>();
  EXPECT_LT(first.x(), -1e-3) << "the first ball gave way";
  EXPECT_LT(momentum(meeting.particles, meeting.start).norm(), 1e-4 * first.norm());
}

TEST(SurfaceContact, moves_the_lighter_side_more) {
  Meeting meeting = pressed_balls(0.0005, 1e-3);
  meeting.solve(40);
  Real light = 0, heavy = 0;
  for (Index p = 0; p < meeting.particles[0].count(); ++p) {
    light = std::max<Real>(light, (meeting.particles[0].position(p) - meeting.start[0].position(p)).norm());
    heavy = std::max<Real>(heavy, (meeting.particles[1].position(p) - meeting.start[1].position(p)).norm());
  }
  EXPECT_GT(light, 0.0005);
  EXPECT_LT(heavy, 0.01 * light);
}

TEST(SurfaceContact, never_moves_what_is_fixed) {
  Meeting meeting = pressed_balls(0.0005, 0);
  meeting.solve(40);
  EXPECT_EQ(meeting.particles[1].xyzw, meeting.start[1].xyzw);
  EXPECT_LT(meeting.unrest(), 1e-6);
}

TEST(SurfaceContact, a_mover_gives_way_alone_to_what_stays) {
  Meeting meeting;
  meeting.add(shapes::sphere(Vec3::Zero(), 0.01, 4));
  meeting.add(shapes::sphere({0.0199, 0, 0}, 0.01, 4));
  meeting.pair(0, 1, 0.0003f);
  meeting.prepare();
  meeting.start = meeting.particles;
  meeting.find();
  meeting.follow();
  EXPECT_GT(project_candidates(meeting.world, meeting.state, meeting.pointers<const Particles*>(meeting.start),
                               meeting.pointers<Particles*>(meeting.particles), {{1, 0}}),
            0);
  EXPECT_GT(largest_motion(meeting.start[0], meeting.particles[0]), 0);
  EXPECT_EQ(largest_motion(meeting.start[1], meeting.particles[1]), 0);
}

TEST(SurfaceContact, a_pair_s_shift_carries_one_into_the_other_s_coordinates) {
  Meeting meeting;
  meeting.add(shapes::sphere(Vec3::Zero(), 0.01, 4));
  meeting.add(shapes::sphere(Vec3::Zero(), 0.01, 4));
  meeting.pair(0, 1, 0.0003f).shift = {-0.0195f, 0, 0};
  EXPECT_GT(meeting.solve(1), 0);
  meeting.solve(40);
  EXPECT_LT(meeting.unrest(), 1e-6);
}

TEST(SurfaceContact, edges_that_cross_while_every_particle_is_outside_are_pushed_apart) {
  Meeting meeting = crossed_roofs(0.0004);
  const auto gap = [&] { return meeting.particles[1].position(0).z() - meeting.particles[0].position(0).z(); };
  EXPECT_LT(gap(), 0);
  EXPECT_GT(meeting.solve(1), 0);
  meeting.solve(30);
  EXPECT_GT(gap(), 0.00019f);
}

TEST(SurfaceContact, edges_keep_what_lies_between_the_gaps_at_their_ends_or_the_other_edges_where_that_is_less) {
  // The ridges cross in their middles: 0.2 mm there, on whichever of the two.
  for (const bool is_first : {true, false}) {
    Meeting meeting = crossed_roofs(0.0004);
    SurfacePair& pair = meeting.world.pairs[0];
    pair.first_gap.assign(6, 0.0006f), pair.second_gap.assign(6, 0.0006f);
    std::vector<float>& less = is_first ? pair.first_gap : pair.second_gap;
    less[0] = 0.0001f, less[1] = 0.0003f;
    for (int i = 0; i < 10; ++i) meeting.start.clear(), meeting.solve(10);
    EXPECT_NEAR(meeting.particles[1].position(0).z() - meeting.particles[0].position(0).z(), 0.0002, 1e-5);
  }
}

TEST(SurfaceContact, takes_no_particle_further_from_where_the_step_began_than_it_may_and_each_outwards) {
  Meeting meeting = pressed_balls(0.001);
  meeting.world.settings.most_motion = 0.0002f;
  meeting.solve(20);
  Real farthest = 0;
  for (std::size_t s = 0; s < 2; ++s)
    for (Index p = 0; p < meeting.particles[s].count(); ++p) {
      const Vector3f moved = meeting.particles[s].position(p) - meeting.start[s].position(p);
      farthest = std::max<Real>(farthest, moved.norm());
      EXPECT_TRUE(moved.norm() < 1e-6f || (s == 0 ? -1 : 1) * moved.x() > 0) << s << ' ' << p;
    }
  EXPECT_NEAR(farthest, 0.0002, 1e-7) << "in single precision";
}

TEST(SurfaceContact, lists_edges_that_cross_near_each_other_and_no_others) {
  Meeting meeting = crossed_roofs(-0.0004);
  meeting.solve(1);
  ASSERT_FALSE(meeting.state.candidates[0].edges.empty());
  for (const EdgeEdgeCandidate& each : meeting.state.candidates[0].edges) {
    const auto& one = meeting.world.surfaces[0].edges[static_cast<std::size_t>(each.first)].ends;
    const auto& other = meeting.world.surfaces[1].edges[static_cast<std::size_t>(each.second)].ends;
    EXPECT_EQ(std::minmax(one[0], one[1]), std::minmax(0, 1)) << "the ridge";
    EXPECT_EQ(std::minmax(other[0], other[1]), std::minmax(0, 1));
  }
  Meeting apart = crossed_roofs(-0.002);
  apart.solve(1);
  EXPECT_TRUE(apart.state.candidates[0].edges.empty());
}

TEST(SurfaceContact, edges_that_had_passed_each_other_come_back_by_half_a_millimetre_at_once) {
  Meeting meeting = crossed_roofs(0.0004);
  meeting.solve(1);
  Real most = 1;
  for (const EdgeEdgeCandidate& each : meeting.state.candidates[0].edges) most = std::min<Real>(most, each.most_gap);
  EXPECT_NEAR(most, 0.0005 - 0.0004, 1e-7);
}

TEST(SurfaceContact, lets_go_of_what_is_torn_from_its_neighbors_until_the_step_ends) {
  Meeting meeting = pressed_balls(0.0005);
  Index tip = 0;
  for (Index p = 0; p < meeting.particles[0].count(); ++p)
    if (meeting.particles[0].position(p).x() > meeting.particles[0].position(tip).x()) tip = p;
  const Vector3f home = meeting.particles[0].position(tip), away = home + Vector3f(0.004f, 0, 0);
  meeting.particles[0].position(tip) = away;
  EXPECT_GT(meeting.solve(1), 0) << "the rest is pushed";
  EXPECT_EQ(meeting.particles[0].position(tip), away);

  meeting.particles[0].position(tip) = home;
  const auto places = meeting.pointers<const Particles*>(meeting.particles);
  meeting.follow();
  EXPECT_TRUE(meeting.state.torn[0][static_cast<std::size_t>(tip)]) << "in this step";
  remember_places(places, meeting.state);
  meeting.follow();
  EXPECT_FALSE(meeting.state.torn[0][static_cast<std::size_t>(tip)]) << "in the next";
}

TEST(SurfaceContact, an_overlap_that_is_allowed_stays) {
  Meeting meeting = pressed_balls(0.001);
  meeting.world.pairs[0].first_gap.assign(meeting.world.pairs[0].first_gap.size(), -0.0011f);
  meeting.world.pairs[0].second_gap.assign(meeting.world.pairs[0].second_gap.size(), -0.0011f);
  EXPECT_EQ(meeting.solve(3), 0);
}

TEST(SurfaceContact, friction_holds_back_what_slides_and_nothing_else_does) {
  const auto slid = [](float friction) {
    Meeting meeting;
    meeting.add(shapes::box({-0.02, -0.02, -0.02}, {0.02, 0.02, 0}), 0);
    meeting.add(shapes::sphere({0, 0, 0.0099}, 0.01, 4));
    meeting.pair(0, 1, 0.0002f);
    meeting.world.settings.friction = friction;
    meeting.start = meeting.particles;
    for (Index p = 0; p < meeting.start[1].count(); ++p) meeting.start[1].position(p).x() -= 0.0001f;
    Index lowest = 0;
    for (Index p = 0; p < meeting.particles[1].count(); ++p)
      if (meeting.particles[1].position(p).z() < meeting.particles[1].position(lowest).z()) lowest = p;
    meeting.solve(1);
    return meeting.particles[1].position(lowest).x() - meeting.start[1].position(lowest).x();
  };
  EXPECT_NEAR(slid(0), 0.0001f, 2e-6f);
  EXPECT_NEAR(slid(10), 0, 2e-6f);
  const float some = slid(0.1f);
  EXPECT_GT(some, 0.00002f);
  EXPECT_LT(some, 0.00009f);
}

TEST(SurfaceContact, cohesion_holds_together_what_touched_and_lets_it_slide) {
  const auto parted = [](float cohesion, char touched) {
    Meeting meeting;
    meeting.add(shapes::box({-0.02, -0.02, -0.02}, {0.02, 0.02, 0}), 0);
    meeting.add(shapes::sphere({0.003, 0, 0.013}, 0.01, 4));
    SurfacePair& pair = meeting.pair(0, 1, 0.0002f);
    pair.first_touches.assign(pair.first_touches.size(), touched);
    Index lowest = 0;
    for (Index p = 0; p < meeting.particles[1].count(); ++p)
      if (meeting.particles[1].position(p).z() < meeting.particles[1].position(lowest).z()) lowest = p;
    pair.second_touches[static_cast<std::size_t>(lowest)] = touched;
    meeting.world.settings.cohesion = cohesion;
    meeting.solve(30);
    EXPECT_NEAR(meeting.particles[1].position(lowest).x(), 0.003f, 1e-6f);
    return meeting.particles[1].position(lowest).z();
  };
  EXPECT_NEAR(parted(0, 1), 0.003f, 1e-6f);
  EXPECT_NEAR(parted(0.001f, 0), 0.003f, 1e-6f);
  EXPECT_NEAR(parted(0.001f, 1), 0.001f, 1e-6f);
}

TEST(SurfaceContact, gives_the_same_bits_for_any_number_of_threads) {
  std::vector<std::uint64_t> hashes;
  for (int threads : {1, 2, 64}) {
    const ThreadLimit limit(threads);
    Meeting meeting;
    meeting.add(shapes::sphere(Vec3::Zero(), 0.01, 5));
    meeting.add(shapes::sphere({0.0192, 0, 0}, 0.01, 5));
    meeting.add(shapes::sphere({0.0095, 0.0165, 0}, 0.01, 5));
    for (Index a = 0; a < 3; ++a)
      for (Index b = a; b < 3; ++b) meeting.pair(a, b, 0.0003f);
    EXPECT_GT(meeting.solve(10), 0);
    std::uint64_t hash = hash_seed;
    for (const Particles& each : meeting.particles) hash = hash_of(each.xyzw, hash);
    hashes.push_back(hash);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

}  // namespace gracilis
