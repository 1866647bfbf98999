#include <gracilis/dynamics/contact/mesh/contact_surface.hpp>
#include <gracilis/dynamics/contact/mesh/particle_normals.hpp>

#include <shapes.hpp>

#include "systems_for_tests.hpp"

#include <gtest/gtest.h>

#include <random>

namespace gracilis {
namespace {

using Eigen::Vector3f;

/// A surface with its particles and normals.
struct Body {
  ContactSurface surface;
  Particles particles;
  Eigen::Matrix3Xf normals;
};

Body body_of(const TriangleMesh& mesh) {
  Body body{build_contact_surface(mesh.faces, mesh.vertex_count()),
            make_particles(mesh.vertices, Eigen::VectorXd::Ones(mesh.vertex_count())),
            {}};
  particle_normals(body.surface, body.particles, body.normals);
  return body;
}

/// The gap to the face that is nearest by trying all.
PointGap nearest_gap(const Body& body, const Vector3f& p) {
  PointGap best;
  for (Index face = 0; face < body.surface.faces.cols(); ++face) {
    const PointGap gap = point_gap(p, body.surface, face, body.particles, body.normals);
    if (face == 0 || std::abs(gap.distance) < std::abs(best.distance)) best = gap;
  }
  return best;
}

const Body& cube() {
  static const Body body = body_of(shapes::box({0, 0, 0}, {1, 1, 1}));
  return body;
}

}  // namespace

TEST(ContactSurface, a_side_knows_the_face_behind_it_and_its_edge) {
  const ContactSurface& surface = cube().surface;
  for (Index face = 0; face < surface.faces.cols(); ++face)
    for (int corner = 0; corner < 3; ++corner) {
      const auto& edge = surface.edges[static_cast<std::size_t>(surface.sides(corner, face))];
      EXPECT_NE(surface.faces(corner, face), edge.ends[0]);
      EXPECT_NE(surface.faces(corner, face), edge.ends[1]);
      const Index behind = surface.across(corner, face);
      ASSERT_GE(behind, 0);
      EXPECT_TRUE((edge.faces == std::array<Index, 2>{face, behind}) ||
                  (edge.faces == std::array<Index, 2>{behind, face}));
    }
  EXPECT_EQ(surface.edges.size(), 18u);
}

TEST(ContactSurface, an_open_side_has_nothing_behind_it) {
  const TriangleMesh triangle = shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  EXPECT_TRUE((build_contact_surface(triangle.faces, 3).across.array() == -1).all());
}

TEST(ContactSurface, edges_of_an_open_surface_are_listed_once_at_each_end_whichever_side_their_face_lies_on) {
  const TriangleMesh square = shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  for (const bool turned : {false, true}) {
    Eigen::Matrix3Xi faces = square.faces;
    if (turned) faces.row(1).swap(faces.row(2));
    const ContactSurface surface = build_contact_surface(faces, 4);
    EXPECT_EQ(surface.edges.size(), 5u);
    const std::size_t at_corners[] = {3, 2, 3, 2};
    for (Index p = 0; p < 4; ++p) EXPECT_EQ(surface.edges_at(p).size(), at_corners[p]) << p;
  }
}

TEST(ContactSurface, a_cube_s_corner_points_along_its_diagonal) {
  for (Index p = 0; p < 8; ++p) {
    const Vector3f diagonal = (cube().particles.position(p) - Vector3f::Constant(0.5f)).normalized();
    EXPECT_GT(cube().normals.col(p).dot(diagonal), 1 - 1e-3f) << "the split of the squares must not turn it";
  }
}

TEST(ContactSurface, the_faces_of_a_vertex_go_around_it_and_its_edges_are_listed) {
  const ContactSurface& surface = cube().surface;
  std::vector<int> seen(surface.edges.size(), 0);
  for (Index p = 0; p < 8; ++p) {
    const auto at = static_cast<std::size_t>(p);
    for (Index i = surface.vertex_faces.offsets[at]; i < surface.vertex_faces.offsets[at + 1]; ++i) {
      const Eigen::Vector3i corners = surface.faces.col(surface.vertex_faces.faces[static_cast<std::size_t>(i)]);
      const Eigen::Vector3i around(p, surface.vertex_faces.ends(0, i), surface.vertex_faces.ends(1, i));
      EXPECT_TRUE(around == corners || around == corners({1, 2, 0}) || around == corners({2, 0, 1}));
    }
    for (Index i = surface.particle_edge_offsets[at]; i < surface.particle_edge_offsets[at + 1]; ++i) {
      const Index edge = surface.particle_edges[static_cast<std::size_t>(i)];
      const auto& ends = surface.edges[static_cast<std::size_t>(edge)].ends;
      EXPECT_TRUE(ends[0] == p || ends[1] == p);
      ++seen[static_cast<std::size_t>(edge)];
    }
  }
  for (const int times : seen) EXPECT_EQ(times, 2) << "once at each end";
}

TEST(ContactSurface, normals_are_those_of_the_faces_weighted_by_their_angles) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> away(-0.2, 0.2);
  TriangleMesh crumpled = shapes::sphere(Vec3::Zero(), 1, 2);
  for (double& coordinate : crumpled.vertices.reshaped()) coordinate += away(generator);
  const Body body = body_of(crumpled);
  Points sums = Points::Zero(3, crumpled.vertex_count());
  for (const auto face : crumpled.faces.colwise())
    for (int k = 0; k < 3; ++k) {
      const Vec3 at = crumpled.vertices.col(face[k]), along = crumpled.vertices.col(face[(k + 1) % 3]) - at,
                 back = crumpled.vertices.col(face[(k + 2) % 3]) - at;
      sums.col(face[k]) += std::atan2(along.cross(back).norm(), along.dot(back)) * along.cross(back).normalized();
    }
  for (Index p = 0; p < crumpled.vertex_count(); ++p)
    EXPECT_LT((body.normals.col(p).cast<double>() - sums.col(p).normalized()).norm(), 1e-5) << p;
}

TEST(ContactSurface, only_the_normals_that_are_listed_change) {
  Body body = body_of(shapes::sphere(Vec3::Zero(), 1, 2));
  const Eigen::Matrix3Xf made = body.normals;
  body.normals.setZero();
  particle_normals(body.surface, body.particles, {40, 3, 17}, body.normals);
  for (Index p = 0; p < made.cols(); ++p) {
    const bool listed = p == 40 || p == 3 || p == 17;
    EXPECT_EQ(body.normals.col(p), listed ? Vector3f(made.col(p)) : Vector3f(Vector3f::Zero())) << p;
  }
}

TEST(ContactSurface, a_particle_whose_faces_are_all_flat_has_no_normal) {
  const Body flat = body_of(shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}));
  EXPECT_EQ(flat.normals, Eigen::Matrix3Xf::Zero(3, 3));
}

TEST(PointGap, over_a_face_is_the_height) {
  const PointGap gap = nearest_gap(cube(), {0.3f, 0.4f, 1.2f});
  EXPECT_NEAR(gap.distance, 0.2f, 1e-6f);
  EXPECT_LT((gap.normal - Vector3f::UnitZ()).norm(), 1e-6f);
}

TEST(PointGap, under_a_face_is_negative_and_points_out) {
  const PointGap gap = nearest_gap(cube(), {0.3f, 0.4f, 0.9f});
  EXPECT_NEAR(gap.distance, -0.1f, 1e-6f);
  EXPECT_LT((gap.normal - Vector3f::UnitZ()).norm(), 1e-6f);
}

TEST(PointGap, beside_an_edge_points_away_from_it) {
  const PointGap gap = nearest_gap(cube(), {1.3f, 0.5f, 1.4f});
  EXPECT_NEAR(gap.distance, 0.5f, 1e-6f);
  EXPECT_LT((gap.normal - Vector3f(0.6f, 0, 0.8f)).norm(), 1e-5f);
}

TEST(PointGap, beside_a_corner_points_away_from_it) {
  const PointGap gap = nearest_gap(cube(), {-0.1f, -0.1f, -0.1f});
  EXPECT_NEAR(gap.distance, 0.1f * std::sqrt(3.0f), 1e-6f);
  EXPECT_LT((gap.normal + Vector3f::Constant(1 / std::sqrt(3.0f))).norm(), 1e-5f);
}

TEST(PointGap, on_an_edge_takes_the_surface_s_normal) {
  const PointGap gap = nearest_gap(cube(), {1, 0.5f, 1});
  EXPECT_NEAR(gap.distance, 0, 1e-6f);
  EXPECT_NEAR(gap.normal.norm(), 1, 1e-5f);
  EXPECT_GT(gap.normal.x(), 0.3f);
  EXPECT_GT(gap.normal.z(), 0.3f);
}

TEST(PointGap, is_continuous_where_a_point_passes_from_a_face_over_an_edge) {
  for (const float height : {0.2f, 0.05f}) {
    const PointGap before = nearest_gap(cube(), {0.99999f, 0.5f, 1 + height});
    const PointGap after = nearest_gap(cube(), {1.00001f, 0.5f, 1 + height});
    EXPECT_NEAR(before.distance, after.distance, 1e-5f);
    EXPECT_LT((before.normal - after.normal).norm(), 1e-3f);
  }
}

TEST(PointGap, to_a_flat_triangle_is_finite) {
  Body needle = body_of(shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}));
  const PointGap gap = point_gap({0.5f, 0.1f, 0}, needle.surface, 0, needle.particles, needle.normals);
  EXPECT_TRUE(gap.normal.allFinite());
  EXPECT_NEAR(std::abs(gap.distance), 0.1f, 1e-6f);
  const PointGap on_it = point_gap({0.5f, 0, 0}, needle.surface, 0, needle.particles, needle.normals);
  EXPECT_TRUE(on_it.normal.allFinite());
}

TEST(EdgeGap, of_crossing_edges_is_signed_by_the_outward_side) {
  const EdgeGap apart = edge_gap({-1, 0, 0.1f}, {1, 0, 0.1f}, {0, -1, 0}, {0, 1, 0}, {0, 0, 1});
  ASSERT_TRUE(apart.crossing);
  EXPECT_NEAR(apart.distance, 0.1f, 1e-6f);
  EXPECT_NEAR(apart.s, 0.5f, 1e-6f);
  EXPECT_NEAR(apart.t, 0.5f, 1e-6f);
  const EdgeGap passed = edge_gap({-1, 0, -0.1f}, {1, 0, -0.1f}, {0, -1, 0}, {0, 1, 0}, {0, 0, 1});
  ASSERT_TRUE(passed.crossing);
  EXPECT_NEAR(passed.distance, -0.1f, 1e-6f);
  EXPECT_GT(passed.normal.z(), 0.99f) << "the way out does not turn";
}

TEST(EdgeGap, finds_where_skew_edges_come_nearest) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<float> uniform(-1, 1);
  const auto random = [&] { return Vector3f(uniform(generator), uniform(generator), uniform(generator)); };
  int tried = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3f a0 = random(), a1 = random(), b0 = random(), b1 = random();
    const EdgeGap gap = edge_gap(a0, a1, b0, b1, (a1 - a0).cross(b1 - b0));
    if (!gap.crossing) continue;
    ++tried;
    const Vector3f p = a0 + gap.s * (a1 - a0), q = b0 + gap.t * (b1 - b0);
    EXPECT_NEAR((p - q).dot(a1 - a0), 0, 1e-3f);
    EXPECT_NEAR((p - q).dot(b1 - b0), 0, 1e-3f);
    EXPECT_LT((p - q - gap.distance * gap.normal).norm(), 1e-4f);
  }
  EXPECT_GT(tried, 100);
}

TEST(EdgeGap, parallel_edges_and_edges_past_an_end_do_not_cross) {
  EXPECT_FALSE(edge_gap({-1, 0, 0.1f}, {1, 0, 0.1f}, {-1, 0, 0}, {1, 0, 0}, {0, 0, 1}).crossing);
  EXPECT_FALSE(edge_gap({-1, 2, 0.1f}, {1, 2, 0.1f}, {0, -1, 0}, {0, 1, 0}, {0, 0, 1}).crossing);
  EXPECT_FALSE(edge_gap({0, 0, 0}, {0, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, 1}).crossing) << "an edge without length";
  EXPECT_FALSE(edge_gap({-1, 0, 0.1f}, {1, 0, 0.1f}, {0, -1, 0}, {0, 1, 0}, {1, 0, 0}).crossing)
      << "a side that cannot be told";
}

TEST(EdgeGap, an_edge_that_begins_or_ends_over_another_crosses_it) {
  EXPECT_TRUE(edge_gap({0, 0, 0.1f}, {1, 0, 0.1f}, {0, -1, 0}, {0, 1, 0}, {0, 0, 1}).crossing);
  EXPECT_TRUE(edge_gap({-1, 0, 0.1f}, {0, 0, 0.1f}, {0, -1, 0}, {0, 1, 0}, {0, 0, 1}).crossing);
  EXPECT_TRUE(edge_gap({-1, 0, 0.1f}, {1, 0, 0.1f}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}).crossing);
  EXPECT_TRUE(edge_gap({-1, 0, 0.1f}, {1, 0, 0.1f}, {0, -1, 0}, {0, 0, 0}, {0, 0, 1}).crossing);
}

TEST(Walk, ends_at_the_nearest_face_of_a_sphere_wherever_it_begins) {
  const Body ball = body_of(shapes::sphere(Vec3::Zero(), 1, 4));
  std::mt19937 generator(4);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::uniform_int_distribution<Index> any_face(0, static_cast<Index>(ball.surface.faces.cols()) - 1);
  for (int i = 0; i < 200; ++i) {
    const Vector3f p = 1.2f * Vector3f(uniform(generator), uniform(generator), uniform(generator)).normalized();
    const Index face = walk_to_nearest(p, ball.surface, any_face(generator), ball.particles).face;
    const PointGap found = point_gap(p, ball.surface, face, ball.particles, ball.normals);
    EXPECT_NEAR(found.distance, nearest_gap(ball, p).distance, 1e-5f);
  }
}

TEST(ContactSurface, sums_around_particles_are_those_of_their_faces) {
  const Body ball = body_of(shapes::sphere({0.1, 0.2, 0.3}, 1, 2));
  Eigen::Matrix3Xf of_faces(3, ball.surface.faces.cols());
  for (Index face = 0; face < of_faces.cols(); ++face)
    of_faces.col(face) = Vector3f(1, static_cast<float>(face), static_cast<float>(face % 7));
  Eigen::Matrix3Xf expected = Eigen::Matrix3Xf::Zero(3, ball.particles.count());
  for (Index face = 0; face < of_faces.cols(); ++face)
    for (const Index corner : ball.surface.faces.col(face)) expected.col(corner) += of_faces.col(face);
  EXPECT_EQ(sums_around_particles(ball.surface, of_faces), expected);
}

TEST(ContactSurface, the_nearest_point_of_a_face_is_told_by_weights_of_its_corners) {
  const Body triangle = body_of(shapes::mesh_of({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}));
  const auto nearest = [&](const Vector3f& p) -> Vector3f {
    return point_on(triangle.surface, nearest_on_face(p, triangle.surface, 0, triangle.particles), triangle.particles);
  };
  EXPECT_LT((nearest({0.5f, 0.25f, 3}) - Vector3f(0.5f, 0.25f, 0)).norm(), 1e-6f);
  EXPECT_LT((nearest({1, -1, 1}) - Vector3f(1, 0, 0)).norm(), 1e-6f);
  EXPECT_LT((nearest({2, 2, -1}) - Vector3f(1, 1, 0)).norm(), 1e-6f);
  EXPECT_LT((nearest({5, -1, 0}) - Vector3f(2, 0, 0)).norm(), 1e-6f);
  EXPECT_LT(face_area(triangle.surface, 0, triangle.particles).cross(Vector3f::UnitZ()).norm(), 1e-6f);
  EXPECT_NEAR(face_area(triangle.surface, 0, triangle.particles).z(), 4, 1e-6f) << "twice its area";
}

TEST(Walk, goes_only_where_it_may) {
  // A strip of eight squares along x.
  std::vector<Vec3> vertices;
  std::vector<Eigen::Vector3i> faces;
  for (int i = 0; i <= 8; ++i) vertices.emplace_back(i, 0, 0), vertices.emplace_back(i, 1, 0);
  for (int i = 0; i < 8; ++i)
    faces.emplace_back(2 * i, 2 * i + 2, 2 * i + 1), faces.emplace_back(2 * i + 1, 2 * i + 2, 2 * i + 3);
  const Body strip = body_of(shapes::mesh_of(vertices, faces));
  const Vector3f p(7.9f, 0.5f, 0.1f);
  EXPECT_GE(walk_to_nearest(p, strip.surface, 0, strip.particles).face, 14);
  const auto before_six = [](Index face) { return face < 6; };
  const NearestFace stopped = walk_to_nearest(p, strip.surface, 0, strip.particles, before_six);
  EXPECT_EQ(stopped.face, 5);
  EXPECT_LT((point_on(strip.surface, stopped, strip.particles) - Vector3f(3, 0.5f, 0)).norm(), 1e-5f);
  EXPECT_EQ(walk_to_nearest(p, strip.surface, 9, strip.particles, before_six).face, 9) << "where it begins it may stay";
}

TEST(Walk, stays_where_the_surface_ends) {
  const Body triangle = body_of(shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  EXPECT_EQ(walk_to_nearest({5, 5, 5}, triangle.surface, 0, triangle.particles).face, 0);
}

}  // namespace gracilis
