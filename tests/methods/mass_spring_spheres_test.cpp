#include <gracilis/methods/mass_spring/sphere_collisions.hpp>
#include <gracilis/methods/mass_spring/sphere_tree.hpp>
#include <gracilis/methods/mass_spring/spheres.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

namespace gracilis::mass_spring {
namespace {

using Pairs = std::vector<std::array<Index, 2>>;

Spheres random_spheres(Index count, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  Spheres spheres;
  spheres.centers.resize(3, count);
  for (Index i = 0; i < count; ++i) {
    spheres.centers.col(i) = Vec3(uniform(generator), uniform(generator), uniform(generator));
    spheres.radii.push_back(0.05 + 0.04 * uniform(generator));
  }
  return spheres;
}

Pairs by_brute_force(const Spheres& one, const Spheres& other) {
  Pairs pairs;
  for (Index s = 0; s < one.count(); ++s)
    for (Index t = 0; t < other.count(); ++t)
      if ((one.centers.col(s) - other.centers.col(t)).norm() <
          one.radii[static_cast<std::size_t>(s)] + other.radii[static_cast<std::size_t>(t)])
        pairs.push_back({s, t});
  return pairs;
}

Index intersections(const Points& centers, const std::vector<Real>& radii) {
  Index count = 0;
  for (Index a = 0; a < static_cast<Index>(radii.size()); ++a)
    for (Index b = a + 1; b < static_cast<Index>(radii.size()); ++b) {
      const Real ra = radii[static_cast<std::size_t>(a)], rb = radii[static_cast<std::size_t>(b)];
      // Where they touch, rounding decides.
      count += ra > 0 && rb > 0 && (centers.col(a) - centers.col(b)).norm() < ra + rb - 1e-12;
    }
  return count;
}

/// Two muscles of one sphere each, side by side, and a bone of one sphere.
struct Meeting {
  std::vector<MuscleSpheres> muscles;
  std::vector<PlacedSpheres> bones;
  std::vector<RelaxedMuscle> relaxed;

  Meeting(const Vec3& a, const Vec3& b, bool a_is_fixed, bool keeps_rest_gap, const Vec3& rest_b) {
    const auto add = [&](const Vec3& now, const Vec3& rest, bool is_fixed) {
      MuscleSpheres muscle;
      muscle.particles = {0};
      muscle.rest = {rest, {0.5}};
      muscle.fixed = {static_cast<char>(is_fixed)};
      muscle.meets_bones = true;
      muscle.keeps_rest_gap = keeps_rest_gap;
      muscles.push_back(muscle);
      RelaxedMuscle moving;
      moving.motion = {now, now - Vec3(0.1, 0.2, 0.3)};
      relaxed.push_back(moving);
    };
    add(a, a, a_is_fixed);
    add(b, rest_b, false);
  }
  std::vector<Index> resolve(bool between_muscles = true) {
    return SphereCollisions(muscles, bones, between_muscles, TreeUpdate::rebuild).resolve(relaxed);
  }
  Vec3 now(std::size_t m) const { return relaxed[m].motion.now.col(0); }
  bool is_stopped(std::size_t m) const { return relaxed[m].motion.now == relaxed[m].motion.before; }
};

}  // namespace

TEST(MassSpringSpheres, trees_find_the_pairs_that_brute_force_finds_while_spheres_move) {
  for (const TreeUpdate update : {TreeUpdate::rebuild, TreeUpdate::refit_only}) {
    Spheres one = random_spheres(400, 1), other = random_spheres(300, 2);
    SphereTree first(one, update), second(other, update);
    std::mt19937 generator(3);
    std::normal_distribution<Real> normal(0, 0.05);
    std::size_t found = 0;
    for (int i = 0; i < 20; ++i) {
      first.update();
      second.update();
      const Pairs pairs = SphereTree::intersecting(first, second);
      EXPECT_EQ(pairs, by_brute_force(one, other)) << i;
      found += pairs.size();
      for (Index s = 0; s < one.count(); ++s)
        one.centers.col(s) += Vec3(normal(generator), normal(generator), normal(generator));
    }
    EXPECT_GT(found, 1000u);
  }
}

TEST(MassSpringSpheres, in_rounds_all_meet_all_once_and_nobody_meets_two_at_a_time) {
  for (std::size_t count = 0; count < 12; ++count) {
    std::set<std::array<std::size_t, 2>> met;
    for (const auto& round : rounds_of_pairs(count)) {
      std::set<std::size_t> busy;
      for (const auto& [a, b] : round) {
        EXPECT_LT(a, b);
        EXPECT_LT(b, count);
        EXPECT_TRUE(busy.insert(a).second && busy.insert(b).second) << count;
        EXPECT_TRUE(met.insert({a, b}).second) << count;
      }
    }
    EXPECT_EQ(met.size(), count < 2 ? 0 : count * (count - 1) / 2);
  }
}

TEST(MassSpringSpheres, boxes_are_divided_only_where_a_query_comes) {
  Spheres one = random_spheres(400, 1), far = random_spheres(400, 2), near = random_spheres(400, 2);
  far.centers.colwise() += Vec3(10, 0, 0);
  SphereTree tree(one, TreeUpdate::rebuild), away(far, TreeUpdate::rebuild), beside(near, TreeUpdate::rebuild);
  EXPECT_TRUE(SphereTree::intersecting(tree, away).empty());
  EXPECT_EQ(tree.box_count(), 1u);
  EXPECT_FALSE(SphereTree::intersecting(tree, beside).empty());
  EXPECT_GT(tree.box_count(), 50u);
}

TEST(MassSpringSpheres, spheres_without_number_or_all_in_one_place_are_fine) {
  Spheres none, same;
  same.centers = Points::Constant(3, 50, 0.2);
  same.radii.assign(50, 0.1);
  SphereTree empty(none, TreeUpdate::rebuild), heap(same, TreeUpdate::rebuild), other(same, TreeUpdate::rebuild);
  empty.update();
  EXPECT_TRUE(SphereTree::intersecting(empty, heap).empty());
  EXPECT_EQ(SphereTree::intersecting(heap, other).size(), 2500u);
}

TEST(MassSpringSpheres, spheres_that_touch_do_not_intersect) {
  Spheres one, other;
  one.centers = Vec3(0, 0, 0);
  other.centers = Vec3(1, 0, 0);
  one.radii = other.radii = {0.5};
  SphereTree first(one, TreeUpdate::rebuild), second(other, TreeUpdate::rebuild);
  EXPECT_TRUE(SphereTree::intersecting(first, second).empty());
}

TEST(MassSpringSpheres, a_muscles_radii_are_mean_distances_to_the_vertices_nearest_to_each) {
  Points particles(3, 3), vertices(3, 3);
  particles << 0, 1, 0.1, 0, 0, 0, 0, 0, 0;
  vertices << 0, 0, 1, 0.1, -0.2, 0.15, 0, 0, 0;
  // The third particle is nearer to the first two vertices, but on no boundary fiber.
  const std::vector<Real> radii = muscle_radii(particles, {1, 1, 0}, vertices);
  EXPECT_NEAR(radii[0], 0.15, 1e-12);
  EXPECT_NEAR(radii[1], 0.15, 1e-12);
  EXPECT_EQ(radii[2], 0);
}

TEST(MassSpringSpheres, shrinking_leaves_no_two_that_intersect_and_touches_only_those_that_did) {
  Spheres spheres = random_spheres(300, 5);
  spheres.radii[7] = 3;  // one that reaches over all
  const std::vector<Real> before = spheres.radii;
  ASSERT_GT(intersections(spheres.centers, before), 300);
  shrink_apart(spheres.centers, spheres.radii);
  EXPECT_EQ(intersections(spheres.centers, spheres.radii), 0);
  EXPECT_LT(spheres.radii[7], 0.3) << "very large ones vanish";
  for (std::size_t s = 0; s < before.size(); ++s) {
    EXPECT_GE(spheres.radii[s], 0);
    EXPECT_LE(spheres.radii[s], before[s]);
  }
  std::vector<Real> apart = spheres.radii;
  shrink_apart(spheres.centers, apart);
  for (std::size_t s = 0; s < apart.size(); ++s) EXPECT_NEAR(apart[s], spheres.radii[s], 1e-12);
}

TEST(MassSpringSpheres, of_two_the_larger_gives_way_first) {
  Points centers(3, 2);
  centers << 0, 1, 0, 0, 0, 0;
  std::vector<Real> radii = {2, 0.3};
  shrink_apart(centers, radii);
  EXPECT_NEAR(radii[0], 0.7, 1e-12);
  EXPECT_NEAR(radii[1], 0.3, 1e-12);
  radii = {2, 0.8};
  shrink_apart(centers, radii);
  EXPECT_NEAR(radii[0], 0.5, 1e-12);
  EXPECT_NEAR(radii[1], 0.5, 1e-12);
}

TEST(MassSpringSpheres, a_bones_spheres_lie_below_their_roots_and_cover_its_surface) {
  const TriangleMesh ball = shapes::sphere(Vec3(0.1, 0, 0), 0.03, 3);
  std::vector<Index> counts;
  for (const int rings : {1, 2}) {
    const Spheres spheres = bone_spheres(ball, rings);
    counts.push_back(spheres.count());
    for (Index s = 0; s < spheres.count(); ++s) {
      const Real radius = spheres.radii[static_cast<std::size_t>(s)], below = radius / std::sqrt(2.0);
      EXPECT_NEAR((spheres.centers.col(s) - Vec3(0.1, 0, 0)).norm(), 0.03 - below, 0.001);
    }
    for (Index v = 0; v < ball.vertex_count(); ++v) {
      Real outside = 1;
      for (Index s = 0; s < spheres.count(); ++s)
        outside = std::min(outside, (ball.vertices.col(v) - spheres.centers.col(s)).norm() -
                                        spheres.radii[static_cast<std::size_t>(s)]);
      EXPECT_LT(outside, 1e-4) << v;
    }
  }
  EXPECT_LT(counts[1], counts[0] / 2) << "two rings, fewer spheres";
  EXPECT_LT(counts[0], ball.vertex_count() / 2);
}

TEST(MassSpringSpheres, a_response_moves_each_by_half_and_beside_a_fixed_one_the_other_by_all) {
  const Vec3 a(0, 0, 0), b(0.6, 0, 0);
  Response both = response(a, b, 1, false, false);
  EXPECT_LT((both.a - Vec3(-0.2, 0, 0)).norm(), 1e-12);
  EXPECT_LT((both.b - Vec3(0.2, 0, 0)).norm(), 1e-12);
  EXPECT_LT((response(a, b, 1, true, false).b - Vec3(0.4, 0, 0)).norm(), 1e-12);
  EXPECT_LT((response(a, b, 1, false, true).a - Vec3(-0.4, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(response(a, b, 1, true, true).a, Vec3(0, 0, 0));
  EXPECT_EQ(response(a, b, 0.6, false, false).a, Vec3(0, 0, 0)) << "they touch";
  EXPECT_EQ(response(a, a, 1, false, false).a, Vec3(0, 0, 0)) << "nothing tells the way";
}

TEST(MassSpringSpheres, muscles_that_collide_are_brought_apart_and_stopped) {
  Meeting meeting(Vec3(0, 0, 0), Vec3(0.6, 0, 0), false, false, Vec3(3, 0, 0));
  EXPECT_EQ(meeting.resolve(), (std::vector<Index>{1, 1}));
  EXPECT_NEAR((meeting.now(0) - meeting.now(1)).norm(), 1, 1e-12);
  EXPECT_TRUE(meeting.is_stopped(0) && meeting.is_stopped(1));
  Meeting apart(Vec3(0, 0, 0), Vec3(1.2, 0, 0), false, false, Vec3(3, 0, 0));
  EXPECT_EQ(apart.resolve(), (std::vector<Index>{0, 0}));
  EXPECT_FALSE(apart.is_stopped(0));
  Meeting ignored(Vec3(0, 0, 0), Vec3(0.6, 0, 0), false, false, Vec3(3, 0, 0));
  EXPECT_EQ(ignored.resolve(false), (std::vector<Index>{0, 0}));
}

TEST(MassSpringSpheres, fixed_particles_stay_and_the_other_gives_way) {
  Meeting meeting(Vec3(0, 0, 0), Vec3(0.6, 0, 0), true, false, Vec3(3, 0, 0));
  meeting.resolve();
  EXPECT_EQ(meeting.now(0), Vec3(0, 0, 0));
  EXPECT_NEAR(meeting.now(1).x(), 1, 1e-12);
}

TEST(MassSpringSpheres, pairs_that_overlap_at_rest_may_come_as_near_again) {
  Meeting meeting(Vec3(0, 0, 0), Vec3(0.6, 0, 0), false, true, Vec3(0.7, 0, 0));
  meeting.resolve();
  EXPECT_NEAR((meeting.now(0) - meeting.now(1)).norm(), 0.7, 1e-12);
  Meeting at_rest(Vec3(0, 0, 0), Vec3(0.7, 0, 0), false, true, Vec3(0.7, 0, 0));
  EXPECT_EQ(at_rest.resolve(), (std::vector<Index>{0, 0}));
}

TEST(MassSpringSpheres, bones_do_not_move_and_several_collisions_add_up) {
  Meeting meeting(Vec3(0, 0, 0), Vec3(5, 0, 0), false, false, Vec3(5, 0, 0));
  PlacedSpheres bone;
  bone.rest = {Vec3(0, -10, 0), {0.5}};
  bone.motion = Eigen::Translation3d(0, 9.4, 0) * RigidTransform::Identity();
  PlacedSpheres other = bone;
  other.rest.centers = Vec3(0.6, -9.4, 0);
  meeting.bones = {bone, other};
  EXPECT_EQ(meeting.resolve(), (std::vector<Index>{2, 0}));
  EXPECT_LT((meeting.now(0) - Vec3(-0.4, 0.4, 0)).norm(), 1e-12);
}

}  // namespace gracilis::mass_spring
