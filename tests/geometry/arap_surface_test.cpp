#include <gracilis/geometry/arap_surface.hpp>

#include <gracilis/geometry/arap_volume.hpp>
#include <gracilis/geometry/measures.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gracilis::arap {
namespace {

/// A tube along z whose ends are held.
struct HeldTube {
  TriangleMesh mesh = shapes::cylinder(0.01, 0.06, 12, 12);
  MeshTopology topology = build_topology(mesh.faces, mesh.vertex_count());
  std::vector<char> held;

  HeldTube() {
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      held.push_back(mesh.vertices(2, v) < 1e-9 || mesh.vertices(2, v) > 0.06 - 1e-9);
  }
  Surface surface() const { return {mesh, topology, held}; }
};

Points shaken(const HeldTube& tube, Real amount, bool also_held = false) {
  std::mt19937 chance(3);
  std::uniform_real_distribution<Real> share(-amount, amount);
  Points points = tube.mesh.vertices;
  for (Index v = 0; v < points.cols(); ++v)
    for (Index k = 0; k < 3; ++k) {
      const Real by = share(chance);
      if (also_held || !tube.held[static_cast<std::size_t>(v)]) points(k, v) += by;
    }
  return points;
}

}  // namespace

TEST(ArapSurface, of_a_surface_moved_as_a_whole_all_turn_alike_and_nothing_is_left_to_do) {
  const HeldTube tube;
  const Surface surface = tube.surface();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  Points points = (turn * tube.mesh.vertices).colwise() + Vec3(0.1, 0.2, 0.3);
  const Rotations rotations = surface.best_rotations(points);
  for (const Eigen::Matrix3d& each : rotations) EXPECT_TRUE(each.isApprox(turn, 1e-9));
  EXPECT_NEAR(surface.energy(points, rotations), 0, 1e-20);
  const Points before = points;
  surface.relax(3, points);
  EXPECT_LT((points - before).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(ArapSurface, the_energy_of_a_stretch_is_that_of_its_edges) {
  // Two triangles of a square, one diagonal: cotangents of 45 and 90 degrees are 1 and 0.
  const TriangleMesh square = shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const Surface surface(square, build_topology(square.faces, 4), {1, 1, 0, 0});
  Points stretched = square.vertices;
  stretched.row(0) *= 1.5;
  const Rotations none(4, Eigen::Matrix3d::Identity());
  // Sides have a weight of 1/2 and stretch by half where they lie along x; the diagonal has the least weight. Each
  // counts once from either end.
  const Real expected = 2 * (0.5 * 0.25 + 0.5 * 0.25 + Surface::smallest_weight * 0.25);
  EXPECT_NEAR(surface.energy(stretched, none), expected, 1e-12);
}

TEST(ArapSurface, both_steps_lower_the_energy_and_each_is_least_where_it_ends) {
  const HeldTube tube;
  const Surface surface = tube.surface();
  Points points = shaken(tube, 0.002);
  Rotations rotations(static_cast<std::size_t>(points.cols()), Eigen::Matrix3d::Identity());
  Real energy = surface.energy(points, rotations);
  for (int round = 0; round < 3; ++round) {
    rotations = surface.best_rotations(points);
    const Real turned = surface.energy(points, rotations);
    EXPECT_LT(turned, energy);
    for (int axis = 0; axis < 3; ++axis) {
      Rotations other = rotations;
      for (Eigen::Matrix3d& each : other) each = Eigen::AngleAxisd(0.01, Vec3::Unit(axis)).toRotationMatrix() * each;
      EXPECT_GT(surface.energy(points, other), turned);
    }
    surface.place(rotations, points);
    energy = surface.energy(points, rotations);
    EXPECT_LT(energy, turned);
    for (const Real by : {1e-5, -1e-5}) {
      Points other = points;
      for (Index v = 0; v < points.cols(); ++v)
        if (!tube.held[static_cast<std::size_t>(v)]) other.col(v) += by * Vec3(1, std::sin(3.0 * v), std::cos(5.0 * v));
      EXPECT_GT(surface.energy(other, rotations), energy);
    }
  }
  for (Index v = 0; v < points.cols(); ++v)
    EXPECT_TRUE(!tube.held[static_cast<std::size_t>(v)] || points.col(v) == tube.mesh.vertices.col(v));
}

TEST(ArapSurface, what_was_shaken_comes_back_to_rest) {
  const HeldTube tube;
  Points points = shaken(tube, 0.0005);
  tube.surface().relax(400, points);
  EXPECT_LT((points - tube.mesh.vertices).cwiseAbs().maxCoeff(), 2e-5);
}

TEST(ArapSurface, a_response_is_the_displacement_whose_energy_balances_the_forces) {
  const HeldTube tube;
  const Surface surface = tube.surface();
  Points forces = Points::Zero(3, tube.mesh.vertex_count());
  for (Index v = 0; v < forces.cols(); ++v) forces.col(v) = Vec3(std::sin(2.0 * v), std::cos(3.0 * v), 1);
  const Points response = surface.response(forces);
  const Rotations none(static_cast<std::size_t>(forces.cols()), Eigen::Matrix3d::Identity());
  // The energy counts each edge from both ends: a quarter of its slope along the response is that by the forces.
  const Points& rest = tube.mesh.vertices;
  Real work = 0;
  for (Index v = 0; v < forces.cols(); ++v) {
    EXPECT_TRUE(!tube.held[static_cast<std::size_t>(v)] || response.col(v).isZero());
    work += response.col(v).dot(forces.col(v));
  }
  EXPECT_NEAR(surface.energy(rest + response, none) / (2 * work), 1, 1e-9);
}

TEST(ArapSurface, with_all_vertices_held_nothing_moves) {
  const HeldTube tube;
  const Surface surface(tube.mesh, tube.topology, std::vector<char>(tube.held.size(), 1));
  const Points start = shaken(tube, 0.001, true);
  Points points = start;
  surface.relax(2, points);
  EXPECT_EQ(points, start);
  EXPECT_TRUE(surface.response(start).isZero());
}

TEST(ArapVolume, is_brought_back_along_the_response_and_held_vertices_stay) {
  const HeldTube tube;
  const Real rest = enclosed_volume(tube.mesh.vertices, tube.mesh.faces);
  for (const Real share : {0.9, 1.0, 1.2}) {
    Points points = tube.mesh.vertices;
    restore_volume_by_multiplier(tube.surface(), tube.mesh.faces, tube.held, share * rest, points);
    EXPECT_NEAR(enclosed_volume(points, tube.mesh.faces) / rest, share, 1e-6 * share);
    for (Index v = 0; v < points.cols(); ++v) {
      const Vec3 moved = points.col(v) - tube.mesh.vertices.col(v);
      if (tube.held[static_cast<std::size_t>(v)] || share == 1)
        EXPECT_TRUE(moved.isZero());
      else
        EXPECT_GT((share > 1 ? 1 : -1) * moved.dot(Vec3(tube.mesh.vertices(0, v), tube.mesh.vertices(1, v), 0)), 0);
    }
  }
}

TEST(ArapVolume, within_a_millionth_is_left_as_it_is) {
  const HeldTube tube;
  const Real rest = enclosed_volume(tube.mesh.vertices, tube.mesh.faces);
  Points points = tube.mesh.vertices;
  restore_volume_by_multiplier(tube.surface(), tube.mesh.faces, tube.held, rest * (1 + 0.9e-6), points);
  EXPECT_EQ(points, tube.mesh.vertices);
  restore_volume_by_multiplier(tube.surface(), tube.mesh.faces, tube.held, rest * (1 + 2e-6), points);
  EXPECT_NE(points, tube.mesh.vertices);
}

TEST(ArapVolume, by_scaling_is_exact_where_nothing_is_held_and_about_the_middle) {
  const HeldTube tube;
  const Real rest = enclosed_volume(tube.mesh.vertices, tube.mesh.faces);
  Points points = tube.mesh.vertices;
  restore_volume_by_scaling(tube.mesh.faces, std::vector<char>(tube.held.size(), 0), 1.728 * rest, points);
  const Vec3 middle = tube.mesh.vertices.rowwise().mean();
  EXPECT_LT((points - ((1.2 * (tube.mesh.vertices.colwise() - middle)).colwise() + middle)).cwiseAbs().maxCoeff(),
            1e-12);
  Points held = tube.mesh.vertices;
  restore_volume_by_scaling(tube.mesh.faces, tube.held, 1.728 * rest, held);
  for (Index v = 0; v < held.cols(); ++v)
    EXPECT_EQ(held.col(v),
              tube.held[static_cast<std::size_t>(v)] ? Vec3(tube.mesh.vertices.col(v)) : Vec3(points.col(v)));
  Points inside_out = tube.mesh.vertices;
  inside_out.row(0) *= -1;
  const Points before = inside_out;
  restore_volume_by_scaling(tube.mesh.faces, tube.held, rest, inside_out);
  EXPECT_EQ(inside_out, before) << "no volume to scale";
}

}  // namespace gracilis::arap
