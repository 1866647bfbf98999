#include <gracilis/dynamics/contact/self/self_contact.hpp>

#include <gracilis/dynamics/contact/mesh/particle_normals.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

/// Two triangles of one surface: a lower one (particles 0, 1, 2; face 0) whose normal points up, and another (3, 4, 5;
/// face 1). Sides of 10 mm, a neighborhood of 4 mm.
struct TwoParts {
  ContactSurface surface;
  Eigen::Matrix3Xf rest, rest_normals;
  Particles before, now;

  explicit TwoParts(const Points& at_rest) : rest(at_rest.cast<float>()) {
    surface = build_contact_surface((Eigen::Matrix3Xi(3, 2) << 0, 3, 1, 4, 2, 5).finished(), 6);
    before = now = make_particles(at_rest, Eigen::VectorXd::Ones(6));
    particle_normals(surface, now, rest_normals);
  }
  SelfRule rule() const { return {surface, rest, rest_normals, before, now, 0.004f}; }
};

/// The other one at this height, whose normal points up or down, shifted along x.
Points parts(Real height, bool up, Real shift = 0) {
  Points points(3, 6);
  points.leftCols(3) << 0, 0.01, 0, 0, 0, 0.01, 0, 0, 0;
  points.col(3) = Vec3(0.002 + shift, 0.002, height);
  points.col(up ? 4 : 5) = Vec3(0.012 + shift, 0.002, height);
  points.col(up ? 5 : 4) = Vec3(0.002 + shift, 0.012, height);
  return points;
}

Particles at(const Points& points) { return make_particles(points, Eigen::VectorXd::Ones(6)); }

/// Two that cross, seen from above.
constexpr std::array<Index, 2> lower_edge{1, 2}, upper_edge{3, 4};

}  // namespace

TEST(SelfRule, parts_that_face_each_other_at_rest_meet_from_outside_wherever_they_have_gone) {
  for (const Real height : {0.001, 0.05}) {
    TwoParts two(parts(height, false));
    EXPECT_EQ(two.rule().side(3, 0), 1) << height;
    EXPECT_EQ(two.rule().side(lower_edge, upper_edge), 1) << height;
    two.now = two.before = at(parts(-0.001, false));
    EXPECT_EQ(two.rule().side(3, 0), 1) << "they went through each other";
    EXPECT_EQ(two.rule().side(upper_edge, lower_edge), 1);
  }
}

TEST(SelfRule, a_sheet_meets_its_own_back_from_inside) {
  for (const Real depth : {0.001, 0.006}) {
    const TwoParts two(parts(-depth, false));
    EXPECT_EQ(two.rule().side(3, 0), -1) << depth;
    EXPECT_EQ(two.rule().side(lower_edge, upper_edge), -1) << depth;
  }
}

TEST(SelfRule, of_what_lies_back_to_back_far_apart_the_places_before_the_step_tell) {
  TwoParts two(parts(-0.02, false));
  EXPECT_EQ(two.rule().side(3, 0), -1) << "right under it";
  two.before = at(parts(0.001, false));
  EXPECT_EQ(two.rule().side(3, 0), 1) << "right over it";
  two.before = at(parts(0.001, false, 0.02));
  EXPECT_EQ(two.rule().side(3, 0), 1) << "beside it: what comes from afar comes from outside";
  two.before = at(parts(-0.001, true));
  EXPECT_EQ(two.rule().side(3, 0), 1) << "facing the same way then";
}

TEST(SelfRule, parts_that_lie_side_by_side_at_rest_do_not_meet_until_one_folds_over_the_other) {
  TwoParts two(parts(0, true, 0.001));
  EXPECT_EQ(two.rule().side(3, 0), 0) << "they face the same way";
  EXPECT_EQ(two.rule().side_when_facing(3, 0), 0) << "neighbors that were not over each other";
  EXPECT_EQ(two.rule().side(lower_edge, upper_edge), 0);
  two.now = two.before = at(parts(0.001, false));
  EXPECT_EQ(two.rule().side(3, 0), 1) << "folded over it before";
  EXPECT_EQ(two.rule().side(lower_edge, upper_edge), 1);
  EXPECT_EQ(two.rule().side(upper_edge, lower_edge), 1);
  two.before = at(parts(-0.001, false));
  EXPECT_EQ(two.rule().side(3, 0), -1) << "under it before";
  EXPECT_EQ(two.rule().side(lower_edge, upper_edge), -1);
  two.before = at(parts(0.001, false, 0.02));
  EXPECT_EQ(two.rule().side(lower_edge, upper_edge), 0) << "edges that did not cross";
}

TEST(SelfRule, parts_far_apart_side_by_side_come_from_outside) {
  const TwoParts near(parts(0, true, 0.015)), far(parts(0, true, 0.017));
  // From the nearest corner of the face, at 10 mm: 7.3 and 9.2 mm. A sheet is at most two neighborhoods thick.
  EXPECT_EQ(near.rule().side_when_facing(3, 0), 0);
  EXPECT_EQ(far.rule().side_when_facing(3, 0), 1);
}

TEST(SelfRule, a_face_does_not_meet_its_own_corners_nor_an_edge_one_at_its_end) {
  const TwoParts two(parts(0.001, false));
  for (const Index corner : {0, 1, 2}) EXPECT_EQ(two.rule().side_when_facing(corner, 0), 0);
  for (const std::array<Index, 2>& other : {std::array<Index, 2>{1, 5}, {5, 1}, {2, 5}, {5, 2}, {1, 2}})
    EXPECT_EQ(two.rule().side(lower_edge, other), 0);
  // Whatever the normals at the ends say, by which an edge to particle 5 would face one between 1 and 2.
  TwoParts facing(parts(0.001, false));
  facing.rest_normals.col(5) = Eigen::Vector3f(0, 0, -3);
  facing.rest_normals.col(0) = Eigen::Vector3f(0, 0, 1);
  EXPECT_EQ(facing.rule().side(lower_edge, {0, 5}), 1);
  for (const std::array<Index, 2>& other : {std::array<Index, 2>{1, 5}, {5, 1}, {2, 5}, {5, 2}}) {
    EXPECT_EQ(facing.rule().side(lower_edge, other), 0) << other[0] << ' ' << other[1];
    EXPECT_EQ(facing.rule().side(other, lower_edge), 0);
  }
}

TEST(SelfRule, neighbors_keep_a_tenth_of_their_distance_at_rest) {
  TwoParts two(parts(0.001, false, 0.001));
  two.now = at(parts(0.03, false));
  EXPECT_NEAR(two.rule().most_gap(3, 0), 0.1 * Vec3(0.003, 0.002, 0.001).norm(), 1e-8) << "from the nearest corner";
  EXPECT_NEAR(two.rule().most_gap(4, 0), 0.1 * Vec3(0.003, 0.002, 0.001).norm(), 1e-8) << "from the third one";
  const Vec3 middle = (Vec3(0.003, 0.002, 0.001) + Vec3(0.003, 0.012, 0.001)) / 2 - Vec3(0.005, 0.005, 0);
  EXPECT_NEAR(two.rule().most_gap(lower_edge, upper_edge), 0.1 * middle.norm(), 1e-8) << "of their middles";
}

}  // namespace gracilis
