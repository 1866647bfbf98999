#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/signed_distance.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace gracilis {

namespace {

Points random_points(int count, Real half_width) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<Real> uniform(-half_width, half_width);
  Points points(3, count);
  for (Index i = 0; i < count; ++i) points.col(i) = Vec3(uniform(generator), uniform(generator), uniform(generator));
  return points;
}

Real box_distance(const Vec3& p, Real half) {
  const Vec3 q = p.cwiseAbs() - Vec3::Constant(half);
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
}

}  // namespace

TEST(SignedDistance, of_a_box_is_exact_inside_outside_and_beside_edges_and_corners) {
  const SignedDistance surface(shapes::box(Vec3::Constant(-0.05), Vec3::Constant(0.05)));
  ASSERT_TRUE(surface.closed());
  const Points points = random_points(2000, 0.1);
  for (Index i = 0; i < points.cols(); ++i)
    EXPECT_NEAR(surface.query(points.col(i)).distance, box_distance(points.col(i), 0.05), 1e-12);
}

TEST(SignedDistance, beyond_its_reach_answers_with_infinity) {
  const SignedDistance surface(shapes::sphere(Vec3::Zero(), 0.05, 2));
  EXPECT_EQ(surface.query({0.2, 0, 0}, 0.1).nearest.face, -1);
  EXPECT_GT(surface.query({0.2, 0, 0}, 0.1).distance, 1e9);
}

TEST(SignedDistance, of_a_sphere_with_a_hole_still_tells_inside_from_outside) {
  TriangleMesh mesh = shapes::sphere(Vec3::Zero(), 0.05, 3);
  mesh.faces = mesh.faces.rightCols(mesh.face_count() - 12).eval();
  const SignedDistance surface(mesh);
  ASSERT_FALSE(surface.closed());
  const Points points = random_points(2000, 0.08);
  int inside = 0;
  for (Index i = 0; i < points.cols(); ++i) {
    const Vec3 p = points.col(i);
    if (std::abs(p.norm() - 0.05) < 0.01) continue;
    EXPECT_EQ(surface.query(p).distance < 0, p.norm() < 0.05) << p.transpose();
    inside += p.norm() < 0.05;
  }
  EXPECT_GT(inside, 20);
}

TEST(SignedDistance, of_a_sphere_that_is_folded_over_itself_still_tells_inside_from_outside) {
  TriangleMesh mesh = shapes::sphere(Vec3::Zero(), 0.05, 3);
  // Points of the surface pulled across their neighbors: the triangles around them lie over others, or the other way
  // up.
  for (const Index v : {5, 100, 200}) {
    const Vec3 along = Vec3(mesh.vertices.col(v)).unitOrthogonal();
    mesh.vertices.col(v) += 0.014 * along - 0.001 * mesh.vertices.col(v).normalized();
  }
  const SignedDistance surface(mesh);
  ASSERT_TRUE(surface.closed());
  const Points points = random_points(20000, 0.08);
  for (Index i = 0; i < points.cols(); ++i) {
    const Vec3 p = points.col(i);
    if (std::abs(p.norm() - 0.05) < 0.004) continue;
    EXPECT_EQ(surface.query(p).distance < 0, p.norm() < 0.05) << p.transpose();
  }
}

/// Discs of 40 mm across an arc of 20 mm, so that the tube passes through itself on the inner side, closed at its ends.
TriangleMesh tube_that_turns_within_its_width(Points& path) {
  constexpr int rings = 25, corners = 32;
  constexpr Real radius = 0.04, turn = 0.02;
  path.resize(3, rings);
  TriangleMesh tube;
  tube.vertices.resize(3, rings * corners + 2);
  for (int i = 0; i < rings; ++i) {
    const Real angle = 2.5 * i / (rings - 1);
    const Vec3 outward(std::cos(angle), std::sin(angle), 0);
    path.col(i) = turn * outward;
    for (int j = 0; j < corners; ++j) {
      const Real around = 2 * pi * j / corners;
      tube.vertices.col(i * corners + j) =
          Vec3(path.col(i)) + radius * (std::cos(around) * outward + std::sin(around) * Vec3::UnitZ());
    }
  }
  const int first = rings * corners, last = first + 1;
  tube.vertices.col(first) = path.col(0), tube.vertices.col(last) = path.col(rings - 1);
  std::vector<std::array<int, 3>> faces;
  for (int j = 0; j < corners; ++j) {
    const int k = (j + 1) % corners, top = (rings - 1) * corners;
    faces.push_back({first, j, k});
    faces.push_back({last, top + k, top + j});
    for (int i = 0; i + 1 < rings; ++i) {
      const int a = i * corners + j, b = i * corners + k;
      faces.push_back({a, a + corners, b});
      faces.push_back({b, a + corners, b + corners});
    }
  }
  tube.faces.resize(3, static_cast<Index>(faces.size()));
  for (std::size_t f = 0; f < faces.size(); ++f)
    tube.faces.col(static_cast<Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
  return tube;
}

TEST(SignedDistance, of_a_tube_that_passes_through_itself_tells_what_is_outside_of_it) {
  Points path;
  const TriangleMesh tube = tube_that_turns_within_its_width(path);
  ASSERT_GT(enclosed_volume(tube.vertices, tube.faces), 0);
  const SignedDistance surface(tube);
  ASSERT_TRUE(surface.closed());
  const Points points = random_points(20000, 0.1);
  int outside = 0;
  for (Index i = 0; i < points.cols(); ++i) {
    const Vec3 p = points.col(i);
    if ((path.colwise() - p).colwise().norm().minCoeff() < 0.042) continue;
    ++outside;
    EXPECT_GT(surface.query(p).distance, 0) << p.transpose();
  }
  EXPECT_GT(outside, 5000);
}

TEST(SignedDistance, of_two_balls_that_pass_through_each_other_is_negative_within_either) {
  const TriangleMesh left = shapes::sphere({-0.02, 0, 0}, 0.05, 3), right = shapes::sphere({0.02, 0, 0}, 0.05, 3);
  TriangleMesh both;
  both.vertices.resize(3, left.vertex_count() + right.vertex_count());
  both.vertices << left.vertices, right.vertices;
  both.faces.resize(3, left.face_count() + right.face_count());
  both.faces << left.faces, right.faces.array() + left.vertex_count();
  const SignedDistance surface(both);
  const Points points = random_points(20000, 0.1);
  for (Index i = 0; i < points.cols(); ++i) {
    const Vec3 p = points.col(i);
    const Real nearest = std::min((p - Vec3(-0.02, 0, 0)).norm(), (p - Vec3(0.02, 0, 0)).norm());
    if (std::abs(nearest - 0.05) < 0.002) continue;
    EXPECT_EQ(surface.query(p).distance < 0, nearest < 0.05) << p.transpose();
  }
}

TEST(DistanceField, of_a_sphere_and_its_gradient_agree_with_the_closed_form) {
  const TriangleMesh mesh = shapes::sphere({0.01, -0.02, 0.03}, 0.04, 5);
  const DistanceField field = build_distance_field(mesh, domain_by_cell_size(mesh, 0.002, 0.02));
  const Points points = random_points(3000, 0.05).colwise() + Vec3(0.01, -0.02, 0.03);
  Eigen::VectorXd distances;
  Points gradients;
  sample(field, points, distances, &gradients);
  for (Index i = 0; i < points.cols(); ++i) {
    const Vec3 radial = points.col(i) - Vec3(0.01, -0.02, 0.03);
    if (radial.norm() < 0.015 || radial.norm() > 0.055) continue;
    // Within two diagonals of a cell of two nodes all values are exact; farther away they lie between such of 0.004 m.
    const Real exact = radial.norm() - 0.04;
    EXPECT_NEAR(distances[i], exact, std::abs(exact) < 0.01 ? 1e-4 : 1e-4 + 0.004 * 0.004 / (4 * radial.norm()));
    // A difference over one cell h of a field with curvature 1/r errs by less than h / r.
    EXPECT_NEAR(gradients.col(i).dot(radial.normalized()), 1, 0.002 / radial.norm());
  }
}

TEST(DistanceField, nodes_near_the_surface_are_exact_to_the_last_digit) {
  const TriangleMesh mesh = shapes::box({0.001, 0.002, 0.003}, {0.05, 0.04, 0.03});
  const FieldDomain domain = domain_by_cell_size(mesh, 0.0013, 0.01);
  const DistanceField field = build_distance_field(mesh, domain);
  const SignedDistance exact(mesh);
  Index near = 0;
  for (Index k = 0; k < field.nodes[2]; ++k)
    for (Index j = 0; j < field.nodes[1]; ++j)
      for (Index i = 0; i < field.nodes[0]; ++i) {
        const Real distance = exact.query(field.origin + field.cell_size.cwiseProduct(Vec3(i, j, k))).distance;
        const float value = field.values[static_cast<std::size_t>(i + field.nodes[0] * (j + field.nodes[1] * k))];
        if (std::abs(distance) < 3 * 0.0013) {
          EXPECT_NEAR(value, distance, 1e-8);
          ++near;
        }
        EXPECT_NEAR(value, distance, 2e-3) << "and of the right size everywhere";
      }
  EXPECT_GT(near, 1000);
}

TEST(DistanceField, domains_hold_the_surface_with_its_margin_in_whole_cells) {
  const TriangleMesh mesh = shapes::box({0.1, 0.2, 0.3}, {0.15, 0.22, 0.301});
  const FieldDomain domain = domain_by_cell_size(mesh, 0.004, 0.0105);
  EXPECT_LT((domain.box.min() - Vec3(0.0895, 0.1895, 0.2895)).norm(), 1e-12);
  EXPECT_EQ(domain.cells, (std::array<Index, 3>{18, 11, 6}));
  EXPECT_LT((domain.box.sizes() - 0.004 * Vec3(18, 11, 6)).norm(), 1e-12);
  EXPECT_EQ(domain_by_cell_size(mesh, 1, 0.01).cells, (std::array<Index, 3>{1, 1, 1}));
  const DistanceField field = build_distance_field(mesh, domain);
  EXPECT_EQ(field.nodes, (std::array<Index, 3>{25, 17, 9})) << "up to whole eights of cells";
  EXPECT_LT((field.cell_size - Vec3::Constant(0.004)).norm(), 1e-12);
  const FieldDomain published = domain_by_resolution(shapes::box({0.1, 0.2, 0.3}, {0.15, 0.22, 0.3}), 10, 1.2);
  EXPECT_LT((published.box.center() - Vec3(0.125, 0.21, 0.3)).norm(), 1e-12);
  EXPECT_LT((published.box.sizes() - Vec3(0.06, 0.024, 2e-6)).norm(), 1e-12) << "what is flat, too";
  EXPECT_EQ(published.cells, (std::array<Index, 3>{10, 10, 10}));
}

TEST(DistanceField, has_the_right_sign_far_from_the_surface_where_values_are_interpolated) {
  const TriangleMesh mesh = shapes::box(Vec3::Constant(-0.06), Vec3::Constant(0.06));
  const DistanceField field = build_distance_field(mesh, domain_by_cell_size(mesh, 0.002, 0.05));
  const Points points = random_points(5000, 0.1);
  for (Index i = 0; i < points.cols(); ++i) {
    const Real exact = box_distance(points.col(i), 0.06);
    const FieldSample answer = sample(field, Eigen::Vector3f(points.col(i).cast<float>()));
    EXPECT_NEAR(answer.distance, exact, 0.004);
    if (std::abs(exact) > 5e-4) {
      EXPECT_EQ(answer.distance < 0, exact < 0);
    }
  }
}

TEST(DistanceField, gradient_is_the_derivative_of_the_sampled_distance) {
  const TriangleMesh mesh = shapes::sphere(Vec3::Zero(), 0.04, 3);
  const DistanceField field = build_distance_field(mesh, domain_by_cell_size(mesh, 0.004, 0.02));
  const Points points = random_points(500, 0.04);
  int compared = 0;
  for (Index i = 0; i < points.cols(); ++i) {
    // Keep the stencil within one cell, where the interpolant is smooth.
    const Vec3 cell = (points.col(i) - field.origin).cwiseQuotient(field.cell_size);
    const Vec3 t = cell - cell.array().floor().matrix();
    if (t.minCoeff() < 0.2 || t.maxCoeff() > 0.8) continue;
    const Eigen::Vector3f p = points.col(i).cast<float>();
    const float h = 4e-4f;
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector3f step = Eigen::Vector3f::Zero();
      step[axis] = h;
      const float difference =
          (sample(field, Eigen::Vector3f(p + step)).distance - sample(field, Eigen::Vector3f(p - step)).distance) /
          (2 * h);
      EXPECT_NEAR(sample(field, p).gradient[axis], difference, 2e-3);
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(DistanceField, by_resolution_has_that_many_cells_over_the_scaled_box) {
  const TriangleMesh mesh = shapes::box(Vec3(0, 0, 0), Vec3(0.1, 0.2, 0.4));
  const DistanceField field = build_distance_field(mesh, domain_by_resolution(mesh, 16, 1.5));
  EXPECT_EQ(field.nodes[0], 17);
  EXPECT_NEAR(field.cell_size.z(), 0.4 * 1.5 / 16, 1e-12);
  EXPECT_NEAR(field.origin.x(), -0.025, 1e-12);
}

TEST(DistanceField, outside_of_its_grid_answers_with_infinity) {
  const TriangleMesh mesh = shapes::sphere(Vec3::Zero(), 0.04, 2);
  const DistanceField field = build_distance_field(mesh, domain_by_cell_size(mesh, 0.004, 0.01));
  EXPECT_EQ(sample(field, Eigen::Vector3f(1, 0, 0)).distance, std::numeric_limits<float>::infinity());
}

}  // namespace gracilis
