#include <gracilis/anatomy/attachments/skinning_weights.hpp>
#include <gracilis/geometry/harmonic_field.hpp>
#include <gracilis/geometry/mesh_pieces.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gracilis {
namespace {

/// A tube along z, held by body 0 at its upper end and by body 1 on a small patch at the lower end's side.
struct HeldByAPatch {
  TriangleMesh surface = shapes::cylinder(0.01, 0.16, 20, 40);
  MeshTopology topology;
  std::vector<Index> fixed_body, fixed;

  HeldByAPatch() : topology(build_topology(surface.faces, surface.vertex_count())) {
    surface.vertices.row(2).array() -= surface.vertices.row(2).mean();
    for (Index v = 0; v < surface.vertex_count(); ++v) {
      const Vec3 p = surface.vertices.col(v);
      const Index body = p.z() > 0.07 ? 0 : p.z() < -0.05 && p.z() > -0.07 && p.x() > 0.008 ? 1 : -1;
      fixed_body.push_back(body);
      if (body >= 0) fixed.push_back(v);
    }
  }

  Eigen::MatrixXf shares(Real tendon_length) const {
    return skinning_weights(surface, topology, fixed_body, {0, 1}, tendon_length);
  }
  Real steepest(const Eigen::MatrixXf& shares) const {
    const Eigen::VectorXd share = shares.row(1).transpose().cast<Real>();
    return face_gradients(surface.vertices, surface.faces, share).colwise().norm().maxCoeff();
  }
};

}  // namespace

TEST(SkinningWeights, a_tendon_takes_the_concentration_from_a_small_attachment) {
  const HeldByAPatch tube;
  ASSERT_GE(tube.fixed.size(), 20u);
  EXPECT_LT(tube.steepest(tube.shares(0.03)), 0.75 * tube.steepest(tube.shares(0)));
}

TEST(SkinningWeights, stay_between_0_and_1_sum_to_1_and_are_whole_at_attachments) {
  const HeldByAPatch tube;
  const Eigen::MatrixXf shares = tube.shares(0.03);
  EXPECT_GE(shares.minCoeff(), -1e-6f);
  for (Index v = 0; v < shares.cols(); ++v) {
    EXPECT_NEAR(shares.col(v).sum(), 1, 1e-6);
    const Index body = tube.fixed_body[static_cast<std::size_t>(v)];
    if (body >= 0) {
      EXPECT_EQ(shares(body, v), 1);
    }
  }
}

TEST(SkinningWeights, without_tendons_they_are_harmonic) {
  const HeldByAPatch tube;
  Eigen::MatrixXd given = Eigen::MatrixXd::Zero(static_cast<Index>(tube.fixed.size()), 1);
  for (Index i = 0; i < given.rows(); ++i)
    given(i, 0) = tube.fixed_body[static_cast<std::size_t>(tube.fixed[static_cast<std::size_t>(i)])] == 1;
  const Eigen::MatrixXd field = harmonic_fields(tube.surface.vertices, tube.topology, tube.fixed, given);
  EXPECT_LT((tube.shares(0).row(1).transpose().cast<Real>() - field.col(0)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(SkinningWeights, in_tendons_conductance_grows_with_the_slope_above_its_mean_the_more_the_nearer_the_attachment) {
  const HeldByAPatch tube;
  const Real tendon = 0.03;
  Eigen::MatrixXd given = Eigen::MatrixXd::Zero(static_cast<Index>(tube.fixed.size()), 2);
  for (Index i = 0; i < given.rows(); ++i)
    given(i, tube.fixed_body[static_cast<std::size_t>(tube.fixed[static_cast<std::size_t>(i)])]) = 1;
  const Points& x = tube.surface.vertices;
  const std::vector<MeshEdge>& edges = tube.topology.edges;
  // Along edges, by asking all again and again.
  std::vector<Real> away(static_cast<std::size_t>(x.cols()), 1e9);
  for (const Index v : tube.fixed) away[static_cast<std::size_t>(v)] = 0;
  for (bool is_shorter = true; is_shorter;) {
    is_shorter = false;
    for (const MeshEdge& edge : edges)
      for (const auto& [a, b] : {std::pair(edge.a, edge.b), std::pair(edge.b, edge.a)}) {
        const Real way = away[static_cast<std::size_t>(a)] + (x.col(a) - x.col(b)).norm();
        if (way + 1e-15 < away[static_cast<std::size_t>(b)]) away[static_cast<std::size_t>(b)] = way, is_shorter = true;
      }
  }
  std::vector<Real> conductance(edges.size(), 1);
  Eigen::MatrixXd fields = harmonic_fields(x, tube.topology, tube.fixed, given);
  for (int round = 0; round < 8; ++round) {
    std::vector<Real> squares;
    Real mean = 0;
    for (const MeshEdge& edge : edges) {
      Real square = 0;
      for (Index k = 0; k < 2; ++k) {
        const Points slopes = face_gradients(x, tube.surface.faces, fields.col(k));
        square += (slopes.col(edge.left).squaredNorm() + slopes.col(edge.right).squaredNorm()) / 2;
      }
      squares.push_back(square);
      mean += square / static_cast<Real>(edges.size());
    }
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const Real middle = (away[static_cast<std::size_t>(edges[e].a)] + away[static_cast<std::size_t>(edges[e].b)]) / 2;
      const Real wanted = std::pow(std::max(squares[e] / mean, 1.0), std::max(1 - middle / tendon, 0.0));
      conductance[e] = std::sqrt(conductance[e] * wanted);
    }
    fields = harmonic_fields(x, tube.topology, tube.fixed, given, conductance);
  }
  EXPECT_LT((tube.shares(tendon).transpose().cast<Real>() - fields).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_GT((tube.shares(tendon) - tube.shares(0)).cwiseAbs().maxCoeff(), 0.03f);
}

TEST(SkinningWeights, a_tube_held_by_whole_rings_needs_no_tendons) {
  HeldByAPatch tube;
  for (Index v = 0; v < tube.surface.vertex_count(); ++v) {
    const Real z = tube.surface.vertices(2, v);
    tube.fixed_body[static_cast<std::size_t>(v)] = z > 0.07 ? 0 : z < -0.07 ? 1 : -1;
  }
  EXPECT_LT((tube.shares(0.03) - tube.shares(0)).cwiseAbs().maxCoeff(), 0.02f);
}

/// A long head held by both bodies, and a short head beside its lower half that body 0 alone holds, at its upper end.
struct TwoHeads {
  TriangleMesh surface = shapes::cylinder(0.01, 0.16, 20, 40);
  std::vector<Index> fixed_body, short_head;

  TwoHeads() {
    surface.vertices.row(2).array() -= surface.vertices.row(2).mean();
    TriangleMesh other = shapes::cylinder(0.005, 0.08, 12, 20);
    other.vertices.row(2).array() -= other.vertices.row(2).mean() + 0.03;
    other.vertices.row(0).array() += 0.016;
    const Index first = surface.vertex_count();
    surface = merged({surface, other});
    for (Index v = 0; v < surface.vertex_count(); ++v) {
      const Real z = surface.vertices(2, v);
      if (v >= first) short_head.push_back(v);
      fixed_body.push_back(z > 0.07 || (v >= first && z > 0.005) ? 0 : v < first && z < -0.07 ? 1 : -1);
    }
  }
  Eigen::MatrixXf weights() const {
    return skinning_weights(surface, build_topology(surface.faces, surface.vertex_count()), fixed_body, {0, 1}, 0);
  }
};

TEST(SkinningWeights, a_piece_that_is_held_at_one_end_follows_what_it_lies_on_at_the_other) {
  const TwoHeads heads;
  const Eigen::MatrixXf weights = heads.weights();
  Real lowest = 0;
  for (const Index v : heads.short_head) {
    EXPECT_NEAR(weights.col(v).sum(), 1, 1e-5);
    lowest = std::max(lowest, Real(weights(1, v)));
  }
  EXPECT_GT(lowest, 0.3);  // the other body's share comes over from the long head
}

TEST(SkinningWeights, a_piece_that_nothing_holds_follows_the_others) {
  TwoHeads heads;
  for (const Index v : heads.short_head) heads.fixed_body[static_cast<std::size_t>(v)] = -1;
  const Eigen::MatrixXf weights = heads.weights();
  for (const Index v : heads.short_head) EXPECT_NEAR(weights.col(v).sum(), 1, 1e-5);
}

}  // namespace gracilis
