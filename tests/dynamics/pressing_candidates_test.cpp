#include <gracilis/dynamics/contact/surface/pressing_candidates.hpp>

#include <gtest/gtest.h>

#include <random>

namespace gracilis {

namespace {

/// Two crumpled sheets at random, so near each other that some candidates press and others do not.
struct Sheets {
  std::mt19937 random{7};
  ContactSurface surface;
  Particles first, second;
  Eigen::Matrix3Xf normals;

  Sheets() {
    constexpr Index triangles = 40;
    Eigen::Matrix3Xi faces(3, triangles);
    for (Index f = 0; f < triangles; ++f) faces.col(f) = Eigen::Vector3i(3 * f, 3 * f + 1, 3 * f + 2);
    surface = build_contact_surface(faces, 3 * triangles);
    first = place(), second = place();
    normals.resize(3, first.count());
    for (Index p = 0; p < first.count(); ++p) normals.col(p) = anywhere(1);
  }

  float any(float most) { return std::uniform_real_distribution<float>(-most, most)(random); }
  Eigen::Vector3f anywhere(float most) { return {any(most), any(most), any(most)}; }

  Particles place() {
    const Index count = 3 * static_cast<Index>(surface.faces.cols());
    Points points(3, count);
    for (Index p = 0; p < count; ++p) points.col(p) = anywhere(0.004f).cast<Real>();
    return make_particles(points, Eigen::VectorXd::Ones(count));
  }
};

bool says(PressingBits bits, std::size_t at) { return (bits >> at & 1) != 0; }

}  // namespace

TEST(PressingCandidates, every_edge_that_is_too_near_is_told_and_few_others) {
  Sheets sheets;
  const Eigen::Vector3f shift(0.0003f, 0, -0.0002f);
  int pressing = 0, told = 0, all = 0;
  for (int round = 0; round < 200; ++round) {
    std::vector<EdgeEdgeCandidate> block(1 + static_cast<std::size_t>(round) % candidates_per_block);
    const auto edges = static_cast<Index>(sheets.surface.edges.size());
    for (EdgeEdgeCandidate& candidate : block) {
      candidate.first = static_cast<Index>(sheets.random() % static_cast<unsigned>(edges));
      candidate.second = static_cast<Index>(sheets.random() % static_cast<unsigned>(edges));
      candidate.most_gap = sheets.any(0.001f), candidate.outward = sheets.anywhere(1);
    }
    const PressingBits bits = pressing_edges(block, sheets.surface, sheets.surface, shift, sheets.first, sheets.second);
    for (std::size_t i = 0; i < block.size(); ++i) {
      const auto& ends = sheets.surface.edges[static_cast<std::size_t>(block[i].first)].ends;
      const auto& others = sheets.surface.edges[static_cast<std::size_t>(block[i].second)].ends;
      const EdgeGap gap =
          edge_gap(sheets.first.position(ends[0]) + shift, sheets.first.position(ends[1]) + shift,
                   sheets.second.position(others[0]), sheets.second.position(others[1]), block[i].outward);
      const bool presses = gap.crossing && gap.distance < block[i].most_gap;
      EXPECT_TRUE(!presses || says(bits, i));
      pressing += presses, told += says(bits, i), ++all;
    }
    EXPECT_EQ(bits >> block.size(), 0u);
  }
  EXPECT_GT(pressing, 50);
  // Those that face away from where they lie, too.
  EXPECT_LT(told, 2 * pressing);
  EXPECT_LT(told, all / 2);
}

TEST(PressingCandidates, every_point_that_is_too_near_is_told_and_few_others) {
  Sheets sheets;
  const Eigen::Vector3f shift(0.0003f, 0, -0.0002f);
  int pressing = 0, told = 0, all = 0;
  for (int round = 0; round < 200; ++round) {
    std::vector<VertexFaceCandidate> block(1 + static_cast<std::size_t>(round) % candidates_per_block);
    for (VertexFaceCandidate& candidate : block) {
      candidate.particle = static_cast<Index>(sheets.random() % static_cast<unsigned>(sheets.first.count()));
      candidate.face = static_cast<Index>(sheets.random() % static_cast<unsigned>(sheets.surface.faces.cols()));
      candidate.side = sheets.any(1) < 0 ? -1.0f : 1.0f, candidate.most_gap = sheets.any(0.001f);
    }
    const auto distance = [&](const VertexFaceCandidate& candidate) {
      return candidate.side * point_gap(sheets.first.position(candidate.particle) + shift, sheets.surface,
                                        candidate.face, sheets.second, sheets.normals)
                                  .distance;
    };
    for (VertexFaceCandidate& candidate : block) candidate.distance = distance(candidate);
    const PressingBits bits = pressing_points(block, sheets.surface, shift, sheets.first, sheets.second);
    for (std::size_t i = 0; i < block.size(); ++i) {
      const bool presses = distance(block[i]) < block[i].most_gap;
      EXPECT_TRUE(!presses || says(bits, i));
      pressing += presses, told += says(bits, i), ++all;
    }
    EXPECT_EQ(bits >> block.size(), 0u);
  }
  EXPECT_GT(pressing, 50);
  EXPECT_LT(told, all) << "what lies well in front of its face's plane is not told";
}

}  // namespace gracilis
