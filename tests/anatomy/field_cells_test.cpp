#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/signed_distance.hpp>

#include <shaped_hip.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <random>

/// Trilinear cells of a distance field, which this project has, beside cubic ones of 32 nodes, which the published
/// programs have (Havlíček 2024, section 4.3): what each errs by at the published resolution and at the default one.
namespace gracilis {
namespace {

using Field = std::function<Real(const Vec3&)>;

/// The shape function of the node at `n`, a corner of [-1, 1]³ or a third of an edge, at `p` (32-node serendipity
/// hexahedron; Zienkiewicz and Taylor 2000, section 8.7).
Real shape_function(const Vec3& n, const Vec3& p) {
  Real product = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const bool inner = std::abs(n[axis]) < 0.5;
    product *= inner ? (1 - p[axis] * p[axis]) * (1 + 9 * p[axis] * n[axis]) * 9 / 64 : 1 + p[axis] * n[axis];
  }
  const bool corner = n.cwiseAbs().minCoeff() > 0.5;
  return corner ? product * (9 * p.squaredNorm() - 19) / 64 : product;
}

/// A cell's 8 corners, and after them the 24 thirds of its edges.
std::vector<Vec3> nodes_of_cell() {
  std::vector<Vec3> nodes;
  for (const Real x : {-1.0, 1.0})
    for (const Real y : {-1.0, 1.0})
      for (const Real z : {-1.0, 1.0}) nodes.emplace_back(x, y, z);
  for (int axis = 0; axis < 3; ++axis)
    for (int corner = 0; corner < 8; ++corner)
      if (nodes[static_cast<std::size_t>(corner)][axis] < 0)
        for (const Real third : {-1.0 / 3, 1.0 / 3}) {
          nodes.push_back(nodes[static_cast<std::size_t>(corner)]);
          nodes.back()[axis] = third;
        }
  return nodes;
}

struct Cell {
  Vec3 middle, half;
  Vec3 place(const Vec3& local) const { return middle + half.cwiseProduct(local); }
};

/// What the cell says at `p` from exact values at its nodes: {trilinear, cubic}.
std::array<Real, 2> interpolated(const Field& field, const Cell& cell, const Vec3& p) {
  static const std::vector<Vec3> nodes = nodes_of_cell();
  const Vec3 local = (p - cell.middle).cwiseQuotient(cell.half);
  std::array<Real, 2> sums{};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Real value = field(cell.place(nodes[i]));
    if (i < 8) sums[0] += value * (Vec3::Ones() + local.cwiseProduct(nodes[i])).prod() / 8;
    sums[1] += value * shape_function(nodes[i], local);
  }
  return sums;
}

Cell cell_at(const Vec3& p, const Vec3& origin, const Vec3& size) {
  const Vec3 number = (p - origin).cwiseQuotient(size).array().floor();
  return {origin + (number + Vec3::Constant(0.5)).cwiseProduct(size), size / 2};
}

/// Root mean squares over places within 2 mm of a surface, m: {trilinear, cubic}.
std::array<Real, 2> errors(const TriangleMesh& surface, const Vec3& origin, const Vec3& size, int places) {
  const SignedDistance distance(surface);
  const Field exact = [&](const Vec3& p) { return distance.query(p).distance; };
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> offset(-0.002, 0.002);
  std::uniform_int_distribution<Index> face(0, static_cast<Index>(surface.faces.cols()) - 1);
  std::array<Real, 2> sums{};
  for (int i = 0; i < places; ++i) {
    const auto corners = surface.faces.col(face(random));
    const Vec3 center =
        (surface.vertices.col(corners[0]) + surface.vertices.col(corners[1]) + surface.vertices.col(corners[2])) / 3;
    const Vec3 p = center + offset(random) * area_vector(surface.vertices, corners).normalized();
    const std::array<Real, 2> found = interpolated(exact, cell_at(p, origin, size), p);
    for (std::size_t k = 0; k < 2; ++k) sums[k] += std::pow(found[k] - exact(p), 2) / places;
  }
  return {std::sqrt(sums[0]), std::sqrt(sums[1])};
}

}  // namespace

TEST(FieldCells, cubic_ones_of_32_nodes_hold_a_cubic_polynomial_and_trilinear_ones_do_not) {
  const Field cubic = [](const Vec3& p) { return p.x() * p.x() * p.y() + p.z() * p.z() * p.z() - p.y() + 2; };
  const Cell cell{{1, 2, 3}, {0.5, 1, 2}};
  for (const Vec3& local : {Vec3(0.3, -0.4, 0.7), Vec3(-0.9, 0.1, 0.2)}) {
    const Vec3 p = cell.place(local);
    const std::array<Real, 2> found = interpolated(cubic, cell, p);
    EXPECT_GT(std::abs(found[0] - cubic(p)), 0.1);
    EXPECT_NEAR(found[1], cubic(p), 1e-12);
  }
}

TEST(FieldCells, of_the_published_resolution_err_by_up_to_a_tenth_of_a_millimetre_cubic_ones_by_a_third_of_that) {
  for (const Bone& bone : shaped_hip().bones) {
    const FieldDomain published = domain_by_resolution(bone.surface, 128, 1.5);
    const std::array<Real, 2> coarse = errors(bone.surface, published.box.min(), published.box.sizes() / 128, 200);
    const std::array<Real, 2> fine = errors(bone.surface, published.box.min(), Vec3::Constant(0.001), 200);
    EXPECT_LT(coarse[0], 1e-4) << bone.name;
    EXPECT_GT(coarse[0], 1e-5) << bone.name;
    EXPECT_LT(coarse[1], coarse[0] / 3) << bone.name;
    EXPECT_LT(fine[0], 3e-5) << bone.name << ": trilinear cells of 1 mm, the default";
    EXPECT_LT(fine[1], 1e-5) << bone.name;
  }
}

}  // namespace gracilis
