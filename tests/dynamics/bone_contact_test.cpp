#include <gracilis/dynamics/contact/field/field_contact_points.hpp>
#include <gracilis/dynamics/solver/bone_contact.hpp>

#include "around_a_ball.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace gracilis {
namespace {

/// An edge whose ends are outside of the ball and whose middle is 1 mm inside, as a whole system.
SurfaceSystem system_of_an_edge(int balls) {
  SurfaceSystem system;
  Points ends(3, 2);
  ends << -0.012, 0.012, 0.029, 0.029, 0, 0;
  system.rest = make_particles(ends, Eigen::Vector2d(1, 1));
  system.distances = build_distance_set({{0, 1, 0.024, 0}}, 2);
  FieldContactSet contact;
  contact.field = bounded(ball());
  set_gap(contact, 2, 0.0005f);
  contact.captured.edge_sag.assign(system.distances.a.size(), 0);
  contact.released.edge_sag = contact.captured.edge_sag;
  system.contacts.assign(static_cast<std::size_t>(balls), contact);
  return system;
}

/// Its middle's distance from the center of the one ball that it meets; any others are far away.
Real pushed_out_by(int which, int balls) {
  const SurfaceSystem system = system_of_an_edge(balls);
  SurfaceState state = make_state(system);
  std::vector<FieldPlacement> placements(static_cast<std::size_t>(balls));
  for (int b = 0; b < balls; ++b)
    if (b != which) placements[static_cast<std::size_t>(b)].translation = Eigen::Vector3f(1, 0, 0);
  refresh_contacts(system, placements, state);
  find_edge_points(system, placements, state);
  EXPECT_GT(project_bone_contact(system, placements, state), 0);
  return ((state.particles.position(0) + state.particles.position(1)) / 2).norm();
}

}  // namespace

TEST(BoneContact, edges_are_pushed_out_of_each_obstacle_the_first_the_last_and_a_single_one) {
  EXPECT_NEAR(pushed_out_by(0, 1), radius + 0.0005, 3e-5);
  EXPECT_NEAR(pushed_out_by(0, 2), radius + 0.0005, 3e-5);
  EXPECT_NEAR(pushed_out_by(1, 2), radius + 0.0005, 3e-5);
}

TEST(DeepestOnFace, comes_near_the_deepest_point_wherever_it_lies_in_the_face) {
  for (const Vec3& foot : {Vec3(0.6, 0.3, 0.1), Vec3(0.1, 0.8, 0.1), Vec3(0.2, 0.2, 0.6), Vec3(0, 0.4, 0.6)}) {
    // A face of 10 mm that lies 1 mm deep in the ball, over its own foot.
    const Points face = (Points(3, 3) << 0, 0.01, 0, 0.029, 0.029, 0.029, 0, 0, 0.01).finished();
    Vec3 shift = -face * foot;
    shift.y() = 0;
    std::array<ContactCorner, 3> corners;
    for (Index k = 0; k < 3; ++k) corners[static_cast<std::size_t>(k)].q = (face.col(k) + shift).cast<float>();
    const BoundedField field = bounded(ball());
    const Eigen::Vector3f found = deepest_on_face(field.grid, corners);
    EXPECT_NEAR(found.sum(), 1, 1e-6);
    EXPECT_GE(found.minCoeff(), 0);
    const auto height = [&](const Vec3& where) { return (face * where + shift).norm() - 0.029; };
    // Six steps of the method halve how much higher than the foot the center of the face is, at least.
    EXPECT_LT(height(found.cast<Real>()), 0.5 * height(Vec3::Constant(1.0 / 3)) + 1e-5) << foot.transpose();
  }
}

/// A field that falls along x and z.
static const DistanceField& slope() {
  static const DistanceField field = [] {
    DistanceField made;
    made.origin = Vec3(-1, -1, -1);
    made.nodes = {3, 3, 3};
    for (int z = -1; z < 2; ++z)
      for (int y = -1; y < 2; ++y)
        for (int x = -1; x < 2; ++x) made.values.push_back(static_cast<float>(-x - 2 * z));
    return made;
  }();
  return field;
}

TEST(DeepestOnFace, of_a_face_over_a_slope_is_but_for_one_part_in_thirty_its_lowest_corner) {
  // Steps of 2/3, 2/4, 2/5 ... towards the lowest corner leave the others 2/3 · 1/3 · 2/4 · 3/5 · 4/6 · 5/7 = 2/63.
  for (int lowest = 0; lowest < 3; ++lowest) {
    std::array<ContactCorner, 3> corners;
    for (int k = 0; k < 3; ++k) {
      ContactCorner& corner = corners[static_cast<std::size_t>(k)];
      corner.q =
          k == lowest ? Eigen::Vector3f(0.5f, 0, 0) : Eigen::Vector3f(0, k == (lowest + 1) % 3 ? 0.3f : -0.3f, 0);
    }
    const Eigen::Vector3f found = deepest_on_face(grid_of(slope()), corners);
    EXPECT_NEAR(found[lowest], 1 - 2.0 / 63, 1e-5);
    EXPECT_NEAR(found.sum(), 1, 1e-6);
  }
}

TEST(DeepestOnFace, counts_the_gaps_that_corners_keep) {
  std::array<ContactCorner, 3> corners;
  for (auto& corner : corners) corner.q.setZero();
  corners[1].gap = 0.1f;
  EXPECT_NEAR(deepest_on_face(grid_of(slope()), corners)[1], 1 - 2.0 / 63, 1e-5) << "all are as high";
}

TEST(DeepestOnFace, corners_that_cannot_move_have_a_share_that_is_not_tested) {
  std::array<ContactCorner, 3> corners;
  corners[0].q = {0.5f, 0, 0};  // deepest, and fixed
  corners[1].q = {0, 0.3f, 0}, corners[2].q = {0, -0.3f, 0};
  const float untested = 0.4f;
  const Eigen::Vector3f found = deepest_tested(grid_of(slope()), corners, {0, 1, 1}, untested);
  EXPECT_NEAR(found.sum(), 1, 1e-6);
  EXPECT_NEAR(found[0], (1 - untested) * (1 - 2.0 / 63), 1e-5);
  EXPECT_NEAR(found[1], found[2], 1e-5);
  const Eigen::Vector3f one = deepest_tested(grid_of(slope()), corners, {0, 1, 0}, untested);
  EXPECT_GE(one[1], untested - 1e-6);
  corners[0].q = {0, 0, 0}, corners[1].q = {0.5f, 0, 0};
  EXPECT_EQ(deepest_tested(grid_of(slope()), corners, {0, 1, 1}, untested), deepest_on_face(grid_of(slope()), corners))
      << "what moves lies deepest";
}

}  // namespace gracilis
