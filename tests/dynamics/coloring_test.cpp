#include <gracilis/dynamics/coloring.hpp>
#include <gracilis/dynamics/contact/field/face_set.hpp>
#include <gracilis/geometry/topology.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace gracilis {
namespace {

ConstraintGraph edges_of(const TriangleMesh& mesh) {
  ConstraintGraph graph{2, mesh.vertex_count(), {}};
  for (const MeshEdge& e : build_topology(mesh.faces, mesh.vertex_count()).edges)
    graph.particles.insert(graph.particles.end(), {e.a, e.b});
  return graph;
}

ConstraintGraph dihedrals_of(const TriangleMesh& mesh) {
  ConstraintGraph graph{4, mesh.vertex_count(), {}};
  for (const MeshEdge& e : build_topology(mesh.faces, mesh.vertex_count()).edges)
    graph.particles.insert(graph.particles.end(), {e.a, e.b, e.left_apex, e.right_apex});
  return graph;
}

ConstraintGraph random_graph(unsigned seed) {
  std::mt19937 generator(seed);
  ConstraintGraph graph{3, 60, {}};
  for (int c = 0; c < 150; ++c) {
    std::set<Index> members;
    while (members.size() < 3) members.insert(static_cast<Index>(generator() % 60));
    graph.particles.insert(graph.particles.end(), members.begin(), members.end());
  }
  return graph;
}

std::vector<std::set<Index>> conflicts_of(const ConstraintGraph& graph) {
  std::vector<std::set<Index>> touching(static_cast<std::size_t>(graph.particle_count));
  for (std::size_t i = 0; i < graph.particles.size(); ++i)
    touching[static_cast<std::size_t>(graph.particles[i])].insert(static_cast<Index>(i) / graph.arity);
  std::vector<std::set<Index>> conflicts(static_cast<std::size_t>(graph.constraint_count()));
  for (const auto& group : touching)
    for (Index c : group) conflicts[static_cast<std::size_t>(c)].insert(group.begin(), group.end());
  for (std::size_t c = 0; c < conflicts.size(); ++c) conflicts[c].erase(static_cast<Index>(c));
  return conflicts;
}

/// The largest of the smallest degrees met while constraints are taken away, found by looking at all each time.
std::size_t degeneracy(std::vector<std::set<Index>> conflicts) {
  std::set<Index> left;
  for (std::size_t c = 0; c < conflicts.size(); ++c) left.insert(static_cast<Index>(c));
  std::size_t largest = 0;
  while (!left.empty()) {
    const Index least = *std::min_element(left.begin(), left.end(), [&](Index l, Index r) {
      return conflicts[static_cast<std::size_t>(l)].size() < conflicts[static_cast<std::size_t>(r)].size();
    });
    largest = std::max(largest, conflicts[static_cast<std::size_t>(least)].size());
    for (Index other : conflicts[static_cast<std::size_t>(least)])
      conflicts[static_cast<std::size_t>(other)].erase(least);
    left.erase(least);
  }
  return largest;
}

std::vector<ConstraintGraph> graphs() {
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 1, 2);
  return {edges_of(ball), dihedrals_of(ball), edges_of(shapes::cylinder(1, 3, 12, 6)), random_graph(1),
          random_graph(2)};
}

}  // namespace

TEST(Coloring, no_two_constraints_of_a_color_share_a_particle) {
  for (const ConstraintGraph& graph : graphs()) {
    const std::vector<Index> colors = color_constraints(graph);
    ASSERT_EQ(static_cast<Index>(colors.size()), graph.constraint_count());
    std::set<std::pair<Index, Index>> taken;  // color, particle
    for (std::size_t i = 0; i < graph.particles.size(); ++i) {
      const Index color = colors[i / static_cast<std::size_t>(graph.arity)];
      ASSERT_GE(color, 0);
      EXPECT_TRUE(taken.emplace(color, graph.particles[i]).second);
    }
  }
}

TEST(Coloring, needs_at_most_one_color_more_than_the_degeneracy_and_uses_every_color) {
  for (const ConstraintGraph& graph : graphs()) {
    const std::vector<Index> colors = color_constraints(graph);
    const std::set<Index> used(colors.begin(), colors.end());
    EXPECT_LE(used.size(), degeneracy(conflicts_of(graph)) + 1);
    EXPECT_EQ(*used.rbegin() + 1, static_cast<Index>(used.size()));
  }
}

TEST(Coloring, a_chain_takes_two_colors_and_a_star_one_for_each_ray) {
  ConstraintGraph chain{2, 101, {}}, star{2, 8, {}};
  for (Index i = 0; i < 100; ++i) chain.particles.insert(chain.particles.end(), {i, i + 1});
  for (Index i = 1; i < 8; ++i) star.particles.insert(star.particles.end(), {0, i});
  const std::vector<Index> of_chain = color_constraints(chain), of_star = color_constraints(star);
  EXPECT_EQ(std::set<Index>(of_chain.begin(), of_chain.end()).size(), 2u);
  EXPECT_EQ(std::set<Index>(of_star.begin(), of_star.end()).size(), 7u);
}

TEST(Coloring, is_the_same_every_time) {
  for (const ConstraintGraph& graph : graphs()) EXPECT_EQ(color_constraints(graph), color_constraints(graph));
}

TEST(FaceSet, holds_every_face_once_in_colors_without_common_particles) {
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 1, 2);
  const FaceSet set = build_face_set(ball.faces, ball.vertex_count());
  ASSERT_EQ(set.count(), ball.face_count());
  std::set<std::array<Index, 3>> faces, found;
  for (const auto face : ball.faces.colwise()) faces.insert({face[0], face[1], face[2]});
  Index end = 0;
  for (const ColorRange& color : set.colors) {
    EXPECT_EQ(color.begin, end);
    EXPECT_GT(color.end, color.begin) << "no color is empty";
    end = color.end;
    std::set<Index> touched;
    for (auto slot = static_cast<std::size_t>(color.begin); slot < static_cast<std::size_t>(color.end); ++slot) {
      found.insert({set.particles[0][slot], set.particles[1][slot], set.particles[2][slot]});
      for (const auto& corners : set.particles) EXPECT_TRUE(touched.insert(corners[slot]).second);
    }
  }
  EXPECT_EQ(end, set.count());
  EXPECT_EQ(found, faces);
  EXPECT_TRUE(build_face_set(Eigen::Matrix3Xi(3, 0), 5).colors.empty());
}

TEST(Coloring, of_nothing_is_nothing) {
  EXPECT_TRUE(color_constraints({2, 0, {}}).empty());
  EXPECT_TRUE(color_constraints({4, 10, {}}).empty());
}

TEST(Rounds, hold_every_pair_once_and_no_surface_twice) {
  const std::vector<std::array<Index, 2>> pairs = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}, {2, 3}};
  std::set<Index> seen;
  for (const std::vector<Index>& round : rounds_of(pairs)) {
    std::set<Index> surfaces;
    for (const Index i : round) {
      EXPECT_TRUE(seen.insert(i).second);
      const auto [a, b] = pairs[static_cast<std::size_t>(i)];
      EXPECT_TRUE(surfaces.insert(a).second);
      EXPECT_TRUE(a == b || surfaces.insert(b).second);
    }
  }
  EXPECT_EQ(seen.size(), pairs.size());
}

TEST(Rounds, each_pair_goes_into_the_first_that_is_free_for_it) {
  EXPECT_EQ(rounds_of({{0, 1}, {2, 3}, {1, 2}, {0, 3}, {4, 4}, {0, 2}, {4, 1}}),
            (std::vector<std::vector<Index>>{{0, 1, 4}, {2, 3}, {5, 6}}));
  EXPECT_TRUE(rounds_of({}).empty());
}

}  // namespace gracilis
