#include <gracilis/dynamics/contact/self/unfolding.hpp>

#include <gracilis/geometry/rotations.hpp>
#include <gracilis/geometry/topology.hpp>

#include <shapes.hpp>

#include "sheet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <set>

namespace gracilis {
namespace {

using Eigen::Vector3f;

/// A crumpled ball; a few of its particles are fixed.
struct Crumpled {
  TriangleMesh mesh;
  ContactSurface surface;
  Eigen::Matrix3Xf rest;
  Particles particles;
  VertexStars stars;

  explicit Crumpled(int levels = 3)
      : mesh(shapes::sphere(Vec3::Zero(), 0.01, levels)),
        surface(build_contact_surface(mesh.faces, mesh.vertex_count())),
        rest(mesh.vertices.cast<float>()),
        stars(build_topology(mesh.faces, mesh.vertex_count()).stars) {
    Eigen::VectorXd inverse_masses = Eigen::VectorXd::Ones(mesh.vertex_count());
    for (Index v = 0; v < mesh.vertex_count(); v += 11) inverse_masses[v] = 0;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.9, Vec3(1, 2, 2) / 3).toRotationMatrix();
    std::mt19937 chance(6);
    std::normal_distribution<Real> off(0, 0.0006);
    Points now = (turn * mesh.vertices).colwise() + Vec3(0.02, -0.01, 0.03);
    for (Real& coordinate : now.reshaped()) coordinate += off(chance);
    particles = make_particles(now, inverse_masses);
  }

  std::set<Index> corners(const FacePair& cut) const {
    std::set<Index> found;
    for (const Index face : cut)
      for (const Index corner : surface.faces.col(face)) found.insert(corner);
    return found;
  }
  std::set<Index> with_ring(const std::set<Index>& inner) const {
    std::set<Index> grown = inner;
    for (const Index v : inner)
      for (Index i = stars.offsets[static_cast<std::size_t>(v)]; i < stars.offsets[static_cast<std::size_t>(v) + 1];
           ++i)
        grown.insert(stars.neighbors[static_cast<std::size_t>(i)]);
    return grown;
  }
  Vec3 now(Index p) const { return particles.position(p).cast<Real>(); }

  /// The affine map from rest that fits how these lie now, in double precision: the turn alone counts a tenth.
  std::function<Vec3(const Vec3&)> map_of(const std::set<Index>& listed) const {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    for (const Index p : listed) from += mesh.vertices.col(p), to += now(p);
    const auto count = static_cast<Real>(listed.size());
    from /= count, to /= count;
    Eigen::Matrix3d mixed = Eigen::Matrix3d::Zero(), square = Eigen::Matrix3d::Zero();
    for (const Index p : listed) {
      const Vec3 away = mesh.vertices.col(p) - from;
      mixed += (now(p) - to) * away.transpose(), square += away * away.transpose();
    }
    const Real weight = 0.1 * square.trace() / 3;
    const Eigen::Matrix3d linear =
        (mixed + weight * nearest_rotation(mixed)) * (square + weight * Eigen::Matrix3d::Identity()).inverse();
    return [=](const Vec3& p) -> Vec3 { return to + linear * (p - from); };
  }
};

/// A triangle in the plane z = 0 and one that stands on its tip over the middle of it.
TriangleMesh pierced_in_its_middle() {
  return shapes::mesh_of({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, {0, 0, 0.1}, {0.2, 0, 1}, {-0.2, 0, 1}},
                         {{0, 1, 2}, {3, 4, 5}});
}

constexpr float no_limit = 1;

}  // namespace

TEST(Unfolding, smoothing_takes_corners_and_those_next_to_them_half_way_to_the_middle_of_their_neighbors_all_at_once) {
  Crumpled ball;
  const std::vector<FacePair> cuts = {{3, 40}, {200, 201}};
  std::set<Index> corners = ball.corners(cuts[0]);
  corners.merge(ball.corners(cuts[1]));
  const std::set<Index> moved = ball.with_ring(corners);
  const Crumpled before = ball;
  smooth(ball.surface, cuts, 1, no_limit, ball.particles);
  for (Index p = 0; p < ball.particles.count(); ++p) {
    Vec3 middle = Vec3::Zero();
    const std::set<Index> around = before.with_ring({p});
    for (const Index q : around)
      if (q != p) middle += before.now(q) / static_cast<Real>(around.size() - 1);
    const bool goes = moved.contains(p) && ball.particles.inverse_mass(p) > 0;
    const Vec3 expected = goes ? Vec3((before.now(p) + middle) / 2) : before.now(p);
    EXPECT_LT((ball.now(p) - expected).norm(), goes ? 1e-8 : 1e-30) << p;
  }
  // Twice is once and once again, and no way is longer than allowed.
  Crumpled twice = before, limited = before;
  smooth(twice.surface, cuts, 2, no_limit, twice.particles);
  smooth(ball.surface, cuts, 1, no_limit, ball.particles);
  EXPECT_EQ(twice.particles.xyzw, ball.particles.xyzw);
  smooth(limited.surface, cuts, 1, 2e-4f, limited.particles);
  EXPECT_NEAR(largest_motion(before.particles, limited.particles), 2e-4, 1e-8);
}

TEST(Unfolding, corners_go_where_the_surface_around_them_is_carried_and_those_next_to_them_half_of_the_way) {
  const Crumpled before;
  const FacePair cut = {10, before.surface.across(0, 10)};
  Crumpled ball = before;
  unfold(ball.surface, ball.rest, {cut}, no_limit, ball.particles);
  const std::set<Index> corners = before.corners(cut), moved = before.with_ring(corners);
  EXPECT_EQ(corners.size(), 4u);
  const auto map = before.map_of(before.with_ring(before.with_ring(moved)));
  for (Index p = 0; p < ball.particles.count(); ++p) {
    const Vec3 goal = map(before.mesh.vertices.col(p));
    Vec3 expected = before.now(p);
    if (ball.particles.inverse_mass(p) > 0 && moved.contains(p))
      expected = corners.contains(p) ? goal : Vec3((expected + goal) / 2);
    EXPECT_LT((ball.now(p) - expected).norm(), 2e-7) << p << ": in single precision";
  }
}

TEST(Unfolding, cuts_with_a_common_corner_are_one_part_whichever_comes_first) {
  const Crumpled before;
  const FacePair one = {10, before.surface.across(0, 10)};
  // Around one of its corners, by another face there; and one far away.
  const Index corner = before.surface.faces(0, 10);
  Index beside = -1;
  for (const Index face : before.surface.vertex_faces.around(corner))
    if (face != one[0] && face != one[1] && before.surface.across(0, face) >= 0) beside = face;
  const FacePair other = {beside, before.surface.across(0, beside)}, far = {500, 501};
  Crumpled together = before, turned = before;
  unfold(together.surface, together.rest, {one, other, far}, no_limit, together.particles);
  unfold(turned.surface, turned.rest, {other, far, one}, no_limit, turned.particles);
  std::set<Index> corners = before.corners(one);
  corners.merge(before.corners(other));
  const auto map = before.map_of(before.with_ring(before.with_ring(before.with_ring(corners))));
  for (const Index p : corners) {
    if (!(before.particles.inverse_mass(p) > 0)) continue;
    EXPECT_LT((together.now(p) - map(before.mesh.vertices.col(p))).norm(), 2e-7) << p;
    EXPECT_LT((turned.now(p) - together.now(p)).norm(), 2e-7) << p;
  }
}

TEST(Unfolding, a_shape_that_is_not_thin_is_restored_by_smoothing) {
  // Edges of about 1.2 mm on a ball of 10 mm: its particles stand out from their neighbors' middle by 6 % of them.
  const Crumpled ball(4);
  Crumpled restored = ball, smoothed = ball;
  const std::vector<FacePair> cuts = {{3, 40}, {1000, 1001}};
  restore_shape(restored.surface, restored.rest, cuts, 3, no_limit, restored.particles);
  smooth(smoothed.surface, cuts, 3, no_limit, smoothed.particles);
  EXPECT_EQ(restored.particles.xyzw, smoothed.particles.xyzw);
}

TEST(FacePairs, one_particle_of_either_face_that_can_move_is_enough) {
  for (Index movable = 0; movable < 6; ++movable) {
    Sheet sheet(pierced_in_its_middle(), 0);
    sheet.particles.position(3).z() = -0.1f;
    sheet.particles.at(movable)[3] = 1;
    EXPECT_EQ(sheet.cuts(), (std::vector<FacePair>{{0, 1}})) << movable;
  }
  for (Index movable = 0; movable < 4; ++movable) {
    Sheet sheet(shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, {{0, 1, 2}, {1, 0, 3}}), 0);
    sheet.particles.position(3) = Vector3f(0, 0.9f, 0.3f);
    sheet.particles.at(movable)[3] = 1;
    EXPECT_EQ(sheet.folds().size(), 1u) << movable;
  }
}

TEST(FacePairs, two_faces_cut_when_a_side_of_one_passes_through_the_other_whichever_side_and_face_it_is) {
  std::mt19937 random(11);
  std::uniform_real_distribution<Real> place(-1, 1);
  int cutting = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<Vec3> corners;
    for (int i = 0; i < 6; ++i) corners.emplace_back(place(random), place(random), place(random));
    const TriangleMesh mesh = shapes::mesh_of(corners, {{0, 1, 2}, {3, 4, 5}});
    // Where side p q is in the plane of a, b, c, by solving for it.
    const auto passes = [](const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
      Eigen::Matrix3d sides;
      sides << b - a, c - a, p - q;
      const Vec3 at = sides.inverse() * (p - a);
      return at.x() > 0 && at.y() > 0 && at.x() + at.y() < 1 && at.z() > 0 && at.z() < 1;
    };
    bool expected = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      expected = expected || passes(corners[k], corners[next], corners[3], corners[4], corners[5]) ||
                 passes(corners[3 + k], corners[3 + next], corners[0], corners[1], corners[2]);
    }
    Sheet sheet(mesh);
    // At rest and before, all of them elsewhere: apart.
    for (const Index p : {3, 4, 5}) {
      sheet.rest.col(p) += Vector3f(10, 0, 0);
      sheet.before.position(p) += Vector3f(10, 0, 0);
    }
    EXPECT_EQ(sheet.cuts().size(), expected ? 1u : 0u) << trial;
    cutting += expected;
  }
  EXPECT_GT(cutting, 30);
}

}  // namespace gracilis
