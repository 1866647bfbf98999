#include <gracilis/dynamics/contact/mesh/edge_crossings.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace gracilis {
namespace {

using Eigen::Vector3f;

Particles particles_of(const TriangleMesh& mesh) {
  return make_particles(mesh.vertices, Eigen::VectorXd::Ones(mesh.vertex_count()));
}

std::vector<Index> all_edges(const ContactSurface& surface) {
  std::vector<Index> edges(surface.edges.size());
  std::iota(edges.begin(), edges.end(), 0);
  return edges;
}

/// The same test in double precision; `reserve` widens what counts as crossing, as a share.
bool crosses(const Segment& edge, const Vec3& from, const Vec3& to, double within, double reserve) {
  const Vec3 a = (edge.to - edge.from).cast<double>(), b = to - from, between = edge.from.cast<double>() - from,
             across = a.cross(b);
  const double across2 = across.squaredNorm();
  const double s = b.cross(between).dot(across) / across2, t = a.cross(between).dot(across) / across2;
  const auto is_inside = [&](double share) { return share >= -reserve && share <= 1 + reserve; };
  return std::abs(between.dot(across)) / std::sqrt(across2) < within * (1 + reserve) && is_inside(s) && is_inside(t);
}

}  // namespace

TEST(EdgeCrossings, keep_all_that_cross_closely_and_hardly_any_other) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<float> place(-1.1f, 1.1f);
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 1, 2);
  const ContactSurface surface = build_contact_surface(ball.faces, ball.vertex_count());
  const Particles particles = particles_of(ball);
  int kept_in_all = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Vector3f from(place(generator), place(generator), place(generator));
    const Segment edge = {from, from + 0.4f * Vector3f(place(generator), place(generator), place(generator))};
    const float within = 0.05f;
    std::vector<Index> kept = all_edges(surface);
    keep_crossing(edge, within, surface, particles, kept);
    for (const Index each : all_edges(surface)) {
      const auto& ends = surface.edges[static_cast<std::size_t>(each)].ends;
      const Vec3 a = ball.vertices.col(ends[0]), b = ball.vertices.col(ends[1]);
      const bool is_kept = std::find(kept.begin(), kept.end(), each) != kept.end();
      EXPECT_TRUE(is_kept || !crosses(edge, a, b, within, 0));
      EXPECT_TRUE(!is_kept || crosses(edge, a, b, within, 1e-3));
      kept_in_all += is_kept;
    }
  }
  EXPECT_GT(kept_in_all, 300) << "else this says nothing";
}

TEST(EdgeCrossings, keep_the_order_and_what_is_there_twice) {
  const TriangleMesh square = shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const ContactSurface surface = build_contact_surface(square.faces, 4);
  std::vector<Index> diagonal;
  for (const Index each : all_edges(surface))
    if (surface.edges[static_cast<std::size_t>(each)].ends == std::array<Index, 2>{0, 2}) diagonal.push_back(each);
  ASSERT_EQ(diagonal.size(), 1u);
  std::vector<Index> candidates;
  for (int i = 0; i < 40; ++i) candidates.push_back(i % 4 == 0 ? diagonal[0] : (diagonal[0] + i % 4) % 5);
  keep_crossing({{0.2f, 0.8f, 0.01f}, {0.8f, 0.2f, 0.01f}}, 0.02f, surface, particles_of(square), candidates);
  EXPECT_EQ(candidates, std::vector<Index>(10, diagonal[0]));
}

TEST(EdgeCrossings, parallel_edges_and_those_without_length_cross_nothing) {
  const TriangleMesh flat = shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, {{0, 1, 2}});
  const ContactSurface surface = build_contact_surface(flat.faces, 3);
  std::vector<Index> candidates = all_edges(surface);
  keep_crossing({{0, 0, 0}, {1, 0, 0}}, 1, surface, particles_of(flat), candidates);
  EXPECT_TRUE(candidates.empty());
  candidates = all_edges(surface);
  keep_crossing({{0.5f, 0, 0}, {0.5f, 0, 0}}, 1, surface, particles_of(flat), candidates);
  EXPECT_TRUE(candidates.empty());
}

}  // namespace gracilis
