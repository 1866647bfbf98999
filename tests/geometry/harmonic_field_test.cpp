#include <gracilis/geometry/harmonic_field.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

namespace gracilis {

TEST(HarmonicField, on_an_open_tube_between_its_ends_grows_linearly_along_the_axis) {
  TriangleMesh tube = shapes::cylinder(0.02, 0.1, 24, 20);
  tube.faces = tube.faces.leftCols(2 * 24 * 20).eval();  // without the caps
  const MeshTopology topology = build_topology(tube.faces, tube.vertex_count());
  std::vector<Index> fixed;
  for (Index v = 0; v < 24; ++v) fixed.push_back(v);
  for (Index v = 24 * 20; v < 24 * 21; ++v) fixed.push_back(v);
  Eigen::MatrixXd values(48, 1);
  values << Eigen::VectorXd::Zero(24), Eigen::VectorXd::Ones(24);
  const Eigen::MatrixXd field = harmonic_fields(tube.vertices, topology, fixed, values);
  for (Index v = 0; v < 24 * 21; ++v) EXPECT_NEAR(field(v, 0), tube.vertices(2, v) / 0.1, 1e-9);

  const Points gradients = face_gradients(tube.vertices, tube.faces, field.col(0));
  for (Index f = 0; f < tube.face_count(); ++f) EXPECT_NEAR((gradients.col(f) - Vec3(0, 0, 10)).norm(), 0, 1e-6);
}

TEST(HarmonicField, stays_between_its_fixed_values_and_sums_to_one_over_bodies) {
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 0.05, 4);
  const MeshTopology topology = build_topology(ball.faces, ball.vertex_count());
  Eigen::MatrixXd values(3, 2);
  values << 1, 0, 0, 1, 1, 0;
  const Eigen::MatrixXd fields = harmonic_fields(ball.vertices, topology, {0, 1, 2}, values);
  EXPECT_GE(fields.minCoeff(), 0);
  EXPECT_LE(fields.maxCoeff(), 1);
  for (Index v = 0; v < ball.vertex_count(); ++v) EXPECT_NEAR(fields.row(v).sum(), 1, 1e-9);
}

TEST(HarmonicField, of_a_solver_asked_again_is_what_a_new_one_finds) {
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 0.05, 3);
  const MeshTopology topology = build_topology(ball.faces, ball.vertex_count());
  Eigen::MatrixXd values(3, 1);
  values << 1, 0, 0.5;
  std::vector<Real> conductance(topology.edges.size(), 1);
  for (std::size_t e = 0; e < conductance.size(); e += 3) conductance[e] = 7;
  HarmonicSolver solver(ball.vertices, topology, {0, 1, 2});
  EXPECT_EQ(solver.solve(values), harmonic_fields(ball.vertices, topology, {0, 1, 2}, values));
  const Eigen::MatrixXd graded = harmonic_fields(ball.vertices, topology, {0, 1, 2}, values, conductance);
  EXPECT_EQ(solver.solve(values, conductance), graded);
  EXPECT_NE(solver.solve(values), graded);
}

TEST(HarmonicField, by_conjugate_gradients_is_that_by_factorization) {
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 0.05, 4);
  const MeshTopology topology = build_topology(ball.faces, ball.vertex_count());
  Eigen::MatrixXd values(3, 2);
  values << 1, 0, 0, 1, 0.5, 0.5;
  std::vector<Real> conductance;
  for (std::size_t e = 0; e < topology.edges.size(); ++e) conductance.push_back(e % 7 == 0 ? 100 : 1);
  HarmonicSolver factorized(ball.vertices, topology, {0, 1, 2}), iterated(ball.vertices, topology, {0, 1, 2}, 0);
  for (const std::vector<Real>& by : {std::vector<Real>(), conductance}) {
    const Eigen::MatrixXd fields = iterated.solve(values, by);
    EXPECT_LT((fields - factorized.solve(values, by)).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_GE(fields.minCoeff(), 0);
    EXPECT_LE(fields.maxCoeff(), 1);
  }
}

TEST(HarmonicField, leaves_a_part_that_no_fixed_vertex_reaches_at_zero) {
  const TriangleMesh two =
      shapes::both(shapes::box(Vec3::Zero(), Vec3::Ones()), shapes::box(Vec3::Constant(2), Vec3::Constant(3)));
  const MeshTopology topology = build_topology(two.faces, 16);
  const Eigen::MatrixXd field = harmonic_fields(two.vertices, topology, {0}, Eigen::MatrixXd::Constant(1, 1, 3.0));
  for (Index v = 0; v < 8; ++v) EXPECT_NEAR(field(v, 0), 3, 1e-9);
  for (Index v = 8; v < 16; ++v) EXPECT_EQ(field(v, 0), 0);
}

TEST(FaceGradients, of_a_linear_field_is_its_slope_along_each_face_and_zero_on_degenerate_ones) {
  const TriangleMesh mesh = shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 1, 3}});
  Eigen::VectorXd field(4);
  for (Index v = 0; v < 4; ++v) field[v] = 3 * mesh.vertices(0, v) - mesh.vertices(1, v);
  const Points gradients = face_gradients(mesh.vertices, mesh.faces, field);
  EXPECT_NEAR((gradients.col(0) - Vec3(3, -1, 0)).norm(), 0, 1e-12);
  EXPECT_EQ(gradients.col(1), Vec3::Zero());
}

}  // namespace gracilis
