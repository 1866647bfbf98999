#include <gracilis/core/parallel.hpp>
#include <gracilis/core/state_hash.hpp>
#include <gracilis/dynamics/coloring.hpp>
#include <gracilis/dynamics/havlicek_2024/virtual_edge_seeds.hpp>
#include <gracilis/dynamics/havlicek_2024/virtual_edges.hpp>
#include <gracilis/geometry/topology.hpp>

#include <shapes.hpp>

#include "strips.hpp"

#include "millimeter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace gracilis {
namespace {

using Eigen::Vector3f;

/// Surfaces that keep out of each other by virtual edges, with nothing else that acts on them.
struct EdgeMeeting {
  VirtualEdgeWorld world;
  VirtualEdgeState state;
  std::vector<Particles> particles;

  void add(const TriangleMesh& mesh, const Eigen::VectorXd& inverse_masses) {
    world.stars.push_back(build_topology(mesh.faces, mesh.vertex_count()).stars);
    particles.push_back(make_particles(mesh.vertices, inverse_masses));
  }
  void add(const TriangleMesh& mesh) { add(mesh, Eigen::VectorXd::Ones(mesh.vertex_count())); }

  /// All may meet all.
  void start() {
    std::vector<std::array<Index, 2>> pairs;
    for (Index first = 0; first < static_cast<Index>(particles.size()); ++first)
      for (Index second = first + 1; second < static_cast<Index>(particles.size()); ++second) {
        world.pairs.push_back({first, second});
        pairs.push_back({first, second});
      }
    world.rounds = rounds_of(pairs);
    state = make_virtual_edge_state(world);
  }

  template <class Pointer>
  std::vector<Pointer> pointers() {
    std::vector<Pointer> result;
    for (Particles& each : particles) result.push_back(&each);
    return result;
  }

  /// Moves a surface as one, as a prediction does, and projects so many times.
  Index frame(std::size_t moved, const Vector3f& by, int iterations) {
    begin_edge_frame(world, pointers<const Particles*>(), state);
    remember_positions(pointers<const Particles*>(), state);
    for (Index p = 0; p < particles[moved].count(); ++p) particles[moved].position(p) += by;
    adapt_distances(world, pointers<const Particles*>(), state);
    Index pushes = 0;
    for (int i = 0; i < iterations; ++i) pushes = project_virtual_edges(world, pointers<Particles*>(), state);
    end_edge_frame(world, state);
    return pushes;
  }
};

/// Two balls of 10 mm, 1 mm apart, of particles with different masses.
EdgeMeeting two_balls() {
  EdgeMeeting meeting;
  for (const Real x : {0.0, 0.021}) {
    const TriangleMesh ball = shapes::sphere({x, 0.0003, 0.0002}, 0.01, 4);
    Eigen::VectorXd inverse_masses(ball.vertex_count());
    for (Index v = 0; v < ball.vertex_count(); ++v) inverse_masses[v] = 1 + 0.5 * ((v * 7) % 5);
    meeting.add(ball, inverse_masses);
  }
  meeting.start();
  return meeting;
}

/// Shortest distance between vertices of two surfaces, m.
Real nearest_vertices(const Particles& first, const Particles& second) {
  Real shortest = 1;
  for (Index p = 0; p < first.count(); ++p)
    for (Index q = 0; q < second.count(); ++q)
      shortest = std::min<Real>(shortest, (first.position(p) - second.position(q)).norm());
  return shortest;
}

/// Seven edges, of which three end on (1, 1) and two on (2, 2).
EdgeMeeting with_coinciding_edges(CoincidingEdgeRule rule) {
  EdgeMeeting meeting = two_balls();
  meeting.world.settings.coinciding = rule;
  PairEdges& pair = meeting.state.pairs[0];
  const Index ends[] = {1, 2, 1, 3, 2, 1, 4};
  for (Index i = 0; i < 7; ++i) pair.edges.push_back({{10 + i, 20 + i}, {ends[i], ends[i]}, 0});
  end_edge_frame(meeting.world, meeting.state);
  return meeting;
}

}  // namespace

TEST(VirtualEdgeSeeds, lead_from_every_particle_within_reach_to_the_nearest_of_the_other_surface) {
  EdgeMeeting meeting = two_balls();
  meeting.world.settings.reach = 0.005f;
  meeting.frame(0, Vector3f::Zero(), 0);
  const Particles &first = meeting.particles[0], &second = meeting.particles[1];
  std::set<Index> seeded;
  for (const PairEdges::Edge& edge : meeting.state.pairs[0].edges) {
    EXPECT_TRUE(seeded.insert(edge.seed.a).second);
    const float length = (first.position(edge.seed.a) - second.position(edge.seed.b)).norm();
    EXPECT_LE(length, 0.005f);
    for (Index q = 0; q < second.count(); ++q)
      EXPECT_GE((first.position(edge.seed.a) - second.position(q)).norm(), length * 0.99999f);
  }
  EXPECT_GT(seeded.size(), 20u);
  for (Index p = 0; p < first.count(); ++p) {
    if (seeded.count(p)) continue;
    for (Index q = 0; q < second.count(); ++q) EXPECT_GT((first.position(p) - second.position(q)).norm(), 0.00499f);
  }
}

TEST(VirtualEdgeSeeds, are_taken_anew_after_the_period_and_not_before) {
  EdgeMeeting meeting = two_balls();
  meeting.frame(0, Vector3f::Zero(), 0);
  const std::size_t all = meeting.state.pairs[0].edges.size();
  meeting.state.pairs[0].edges.clear();
  for (int frame = 1; frame < 5; ++frame) {
    meeting.frame(0, Vector3f::Zero(), 0);
    EXPECT_TRUE(meeting.state.pairs[0].edges.empty()) << "frame " << frame;
  }
  meeting.frame(0, Vector3f::Zero(), 0);
  EXPECT_EQ(meeting.state.pairs[0].edges.size(), all);
}

TEST(VirtualEdgeWorld, two_balls_that_move_into_each_other_are_parted_to_the_contact_distance) {
  for (const auto resolution : {EdgeResolution::push, EdgeResolution::unit_sum, EdgeResolution::vector_sum}) {
    EdgeMeeting meeting = two_balls();
    meeting.world.settings.resolution = resolution;
    Vec3 momentum = Vec3::Zero();
    const auto add_momentum = [&](Real sign) {
      for (const Particles& each : meeting.particles)
        for (Index p = 0; p < each.count(); ++p)
          momentum += sign * each.position(p).cast<Real>() / static_cast<Real>(each.inverse_mass(p));
    };
    meeting.frame(0, {1.2f * mm, 0, 0}, 0);
    EXPECT_LT(nearest_vertices(meeting.particles[0], meeting.particles[1]), 0.0008) << "they overlap by 0.2 mm";
    add_momentum(-1);
    EXPECT_GT(meeting.frame(0, Vector3f::Zero(), 1), 10);
    for (int frame = 0; frame < 12; ++frame) meeting.frame(0, Vector3f::Zero(), 10);
    add_momentum(1);
    EXPECT_GT(nearest_vertices(meeting.particles[0], meeting.particles[1]), 0.00199);
    EXPECT_LT(momentum.norm(), 1e-5) << "rounding of 2052 particles; one push is " << 0.001;
  }
}

TEST(VirtualEdgeWorld, balls_farther_than_the_contact_distance_are_left_alone) {
  EdgeMeeting meeting = two_balls();
  meeting.world.settings.distance = 0.9f * mm;
  const std::vector<Particles> before = meeting.particles;
  EXPECT_EQ(meeting.frame(0, Vector3f::Zero(), 5), 0);
  EXPECT_EQ(meeting.particles[0].xyzw, before[0].xyzw);
}

TEST(VirtualEdgeWorld, an_adaptive_contact_distance_is_what_the_ends_came_nearer) {
  EdgeMeeting meeting = two_balls();
  meeting.world.settings.adaptive = true;
  meeting.world.settings.distance = 0.1f * mm;
  meeting.frame(0, {0.5f * mm, 0, 0}, 0);
  for (const PairEdges::Edge& edge : meeting.state.pairs[0].edges) {
    EXPECT_GE(edge.distance, 0.1f * mm);
    EXPECT_LE(edge.distance, 0.5001f * mm);
  }
  float largest = 0;
  for (const PairEdges::Edge& edge : meeting.state.pairs[0].edges) largest = std::max(largest, edge.distance);
  EXPECT_NEAR(largest, 0.5f * mm, 0.01f * mm);
  meeting.frame(0, {-0.5f * mm, 0, 0}, 0);
  for (const PairEdges::Edge& edge : meeting.state.pairs[0].edges) EXPECT_FLOAT_EQ(edge.distance, 0.1f * mm);
}

TEST(VirtualEdgeWorld, edges_stay_where_they_ended_or_begin_at_their_seeds_in_every_iteration) {
  for (const bool reset : {false, true}) {
    EdgeMeeting meeting;
    meeting.add(straight_strip(31)), meeting.add(tetrahedron({0.03, 0, 0.001}));
    meeting.start();
    meeting.world.settings.reset = reset;
    meeting.world.settings.walk_steps = 5;
    meeting.world.settings.distance = 0.5f * mm;
    meeting.world.settings.reach = 0.1f;
    meeting.frame(0, Vector3f::Zero(), 3);
    ASSERT_EQ(meeting.state.pairs[0].edges.front().seed, (VirtualEdge{0, 0}));
    EXPECT_EQ(meeting.state.pairs[0].edges.front().now.a, reset ? 10 : 30) << "columns 5 and 15";
  }
}

TEST(VirtualEdgeWorld, has_the_same_bits_for_any_number_of_threads) {
  for (const auto rule : {CoincidingEdgeRule::keep, CoincidingEdgeRule::reseed}) {
    std::set<std::uint64_t> hashes;
    for (const int threads : {1, 2, 2}) {
      const ThreadLimit limit(threads);
      EdgeMeeting meeting;
      for (const Real x : {0.0, 0.0195})
        for (const Real y : {0.0, 0.0195}) meeting.add(shapes::sphere({x, y, 0.1 * x + 0.05 * y}, 0.01, 3));
      meeting.start();
      meeting.world.settings.coinciding = rule;
      Index pushes = 0;
      for (int frame = 0; frame < 7; ++frame) pushes += meeting.frame(0, {0.3f * mm, 0.3f * mm, 0}, 5);
      EXPECT_GT(pushes, 20);
      std::uint64_t hash = hash_seed;
      for (const Particles& each : meeting.particles) hash = hash_of(each.xyzw, hash);
      hashes.insert(hash);
    }
    EXPECT_EQ(hashes.size(), 1u);
  }
}

TEST(CoincidingVirtualEdges, are_counted_and_left) {
  const EdgeMeeting meeting = with_coinciding_edges(CoincidingEdgeRule::keep);
  EXPECT_EQ(meeting.state.pairs[0].coinciding, 3);
  EXPECT_EQ(meeting.state.pairs[0].edges.size(), 7u);
}

TEST(CoincidingVirtualEdges, are_dropped_but_for_the_first) {
  const EdgeMeeting meeting = with_coinciding_edges(CoincidingEdgeRule::drop);
  const auto& edges = meeting.state.pairs[0].edges;
  EXPECT_EQ(meeting.state.pairs[0].coinciding, 3);
  ASSERT_EQ(edges.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(edges[i].now.a, static_cast<Index>(i + 1));
}

TEST(CoincidingVirtualEdges, begin_again_between_ends_of_seeds_the_same_in_every_run) {
  const EdgeMeeting one = with_coinciding_edges(CoincidingEdgeRule::reseed);
  const EdgeMeeting other = with_coinciding_edges(CoincidingEdgeRule::reseed);
  const auto &edges = one.state.pairs[0].edges, &again = other.state.pairs[0].edges;
  ASSERT_EQ(edges.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(edges[i].now, again[i].now);
    const bool repeated = i == 2 || i == 4 || i == 5;
    EXPECT_EQ(edges[i].now.a >= 10, repeated);
    EXPECT_EQ(edges[i].now.b >= 20, repeated);
  }
}

}  // namespace gracilis
