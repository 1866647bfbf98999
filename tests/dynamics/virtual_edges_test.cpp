#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/coloring.hpp>
#include <gracilis/dynamics/havlicek_2024/virtual_edges.hpp>

#include <shapes.hpp>
#include <gracilis/core/state_hash.hpp>

#include "systems_for_tests.hpp"

#include <gtest/gtest.h>

#include <set>

namespace gracilis {
namespace {

using Eigen::Vector3f;

constexpr float mm = 0.001f;

/// A surface by its particles and their neighbors.
struct Surface {
  VertexStars stars;
  Particles particles;
};

Surface surface_of(const TriangleMesh& mesh, Real inverse_mass = 1) {
  return {build_topology(mesh.faces, mesh.vertex_count()).stars,
          make_particles(mesh.vertices, Eigen::VectorXd::Constant(mesh.vertex_count(), inverse_mass))};
}

/// A band of squares in two triangles each: column i has the vertices 2 i at `columns[i]` and 2 i + 1 at 1 mm beside it
/// along y.
TriangleMesh strip(const std::vector<Vec3>& columns) {
  std::vector<Vec3> vertices;
  std::vector<Eigen::Vector3i> faces;
  for (const Vec3& column : columns) vertices.insert(vertices.end(), {column, column + Vec3(0, 0.001, 0)});
  for (int i = 0; i + 2 < static_cast<int>(vertices.size()); i += 2)
    faces.insert(faces.end(), {{i, i + 2, i + 1}, {i + 1, i + 2, i + 3}});
  return shapes::mesh_of(vertices, faces);
}

/// A straight strip along x, columns 1 mm apart.
TriangleMesh straight_strip(int columns, Real z = 0) {
  std::vector<Vec3> line;
  for (int i = 0; i < columns; ++i) line.emplace_back(0.001 * i, 0, z);
  return strip(line);
}

/// A plane of so many squares of 1 mm in each direction.
TriangleMesh grid(int squares) {
  std::vector<Vec3> vertices;
  std::vector<Eigen::Vector3i> faces;
  const int width = squares + 1;
  for (int j = 0; j < width; ++j)
    for (int i = 0; i < width; ++i) vertices.emplace_back(0.001 * i, 0.001 * j, 0);
  for (int j = 0; j < squares; ++j)
    for (int i = 0; i < squares; ++i) {
      const int at = j * width + i;
      faces.insert(faces.end(), {{at, at + 1, at + width}, {at + 1, at + width + 1, at + width}});
    }
  return shapes::mesh_of(vertices, faces);
}

/// Vertex 0 at `tip`, the others 200 mm above it.
TriangleMesh tetrahedron(const Vec3& tip) {
  return shapes::mesh_of({tip, tip + Vec3(0.01, 0, 0.2), tip + Vec3(-0.01, 0.01, 0.2), tip + Vec3(-0.01, -0.01, 0.2)},
                         {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}});
}

EdgeWalk walk(VirtualEdge edge, const Surface& first, const Surface& second, float distance, int most_steps = 100,
              const Vector3f& shift = Vector3f::Zero()) {
  return walk_virtual_edge(edge, first.stars, first.particles, second.stars, second.particles, shift, distance,
                           most_steps);
}

}  // namespace

TEST(VirtualEdgeWalk, goes_along_a_strip_column_by_column_and_ends_where_none_is_nearer) {
  const Surface band = surface_of(straight_strip(11)), spike = surface_of(tetrahedron({0.01, 0, 0.001}));
  const EdgeWalk found = walk({0, 0}, band, spike, 0.5f * mm);
  EXPECT_EQ(found.end, (VirtualEdge{20, 0}));
  EXPECT_FALSE(found.near);
  EXPECT_EQ(found.steps, 11) << "ten columns, and one step that finds nothing nearer";
}

TEST(VirtualEdgeWalk, both_ends_walk_toward_each_other) {
  const Surface low = surface_of(straight_strip(11)), high = surface_of(straight_strip(11, 0.001));
  const EdgeWalk found = walk({0, 20}, low, high, 0.5f * mm);
  EXPECT_EQ(found.end, (VirtualEdge{10, 10}));
  EXPECT_EQ(found.steps, 6);
}

TEST(VirtualEdgeWalk, stops_where_it_is_shorter_than_the_contact_distance) {
  const Surface band = surface_of(straight_strip(11)), spike = surface_of(tetrahedron({0.01, 0, 0.001}));
  // Column 7 is sqrt(3² + 1²) = 3.16 mm from the tip, column 6 is 4.12 mm.
  const EdgeWalk found = walk({0, 0}, band, spike, 3.5f * mm);
  EXPECT_TRUE(found.near);
  EXPECT_EQ(found.end, (VirtualEdge{14, 0}));
  EXPECT_EQ(found.steps, 7);
}

TEST(VirtualEdgeWalk, ends_after_its_last_step_wherever_it_is) {
  const Surface band = surface_of(straight_strip(151)), spike = surface_of(tetrahedron({0.15, 0, 0.001}));
  EXPECT_EQ(walk({0, 0}, band, spike, 0.5f * mm).end, (VirtualEdge{200, 0})) << "100 of 150 columns";
  EXPECT_EQ(walk({0, 0}, band, spike, 0.5f * mm, 4).end, (VirtualEdge{8, 0}));
  EXPECT_EQ(walk({0, 0}, band, spike, 0.5f * mm, 4).steps, 4);
  EXPECT_EQ(walk({0, 0}, band, spike, 0.5f * mm, 1000).end, (VirtualEdge{300, 0}));
}

TEST(VirtualEdgeWalk, is_caught_in_a_local_minimum) {
  // A U whose legs are 10 mm apart: from the tip of the left leg every neighbor is farther from the tip of the right.
  std::vector<Vec3> line;
  for (int i = 0; i <= 20; ++i) line.emplace_back(0, 0, 0.001 * (20 - i));
  for (int i = 1; i <= 10; ++i) line.emplace_back(0.001 * i, 0, 0);
  for (int i = 1; i <= 20; ++i) line.emplace_back(0.01, 0, 0.001 * i);
  const Surface bend = surface_of(strip(line)), spike = surface_of(tetrahedron({0.01, 0, 0.021}));
  const EdgeWalk found = walk({0, 0}, bend, spike, 2 * mm);
  EXPECT_EQ(found.end, (VirtualEdge{0, 0}));
  EXPECT_EQ(found.steps, 1);
  EXPECT_FALSE(found.near);
  EXPECT_TRUE(walk({60, 0}, bend, spike, 2 * mm).near) << "from the right leg it is found";
}

TEST(VirtualEdgeWalk, finds_the_nearest_vertex_of_a_grid_from_every_other) {
  const Surface plane = surface_of(grid(12)), spike = surface_of(tetrahedron({0.0031, 0.0079, 0.001}));
  for (Index start = 0; start < plane.particles.count(); ++start)
    for (Index corner = 0; corner < 4; ++corner)
      EXPECT_EQ(walk({start, corner}, plane, spike, 0.1f * mm).end, (VirtualEdge{8 * 13 + 3, 0})) << start;
}

TEST(VirtualEdgeWalk, takes_the_second_surface_where_the_shift_puts_it) {
  const Surface band = surface_of(straight_strip(11)), spike = surface_of(tetrahedron({0, 0, 0.001}));
  EXPECT_EQ(walk({0, 0}, band, spike, 0.5f * mm).end.a, 0);
  EXPECT_EQ(walk({0, 0}, band, spike, 0.5f * mm, 100, {-4 * mm, 0, 0}).end.a, 8);
}

TEST(VirtualEdgeWalk, stays_where_an_end_has_no_neighbors) {
  const Surface band = surface_of(straight_strip(2)), point = surface_of(shapes::mesh_of({{0.001, 0, 0.001}}, {}));
  EXPECT_EQ(walk({0, 0}, band, point, 0.5f * mm).end, (VirtualEdge{2, 0}));
}

TEST(VirtualEdgeDirection, the_plain_push_goes_along_the_edge_wherever_the_ends_were) {
  const Vector3f now(0, 0, 1 * mm), before(3 * mm, 0, 1 * mm);
  EXPECT_TRUE(parting_direction(EdgeResolution::push, now, before, 2 * mm).isApprox(Vector3f(0, 0, 1)));
}

TEST(VirtualEdgeDirection, leans_toward_the_way_back_by_unit_vectors_or_by_vectors_as_they_are) {
  const Vector3f now(0, 0, 1 * mm), before(3 * mm, 0, 1 * mm);
  EXPECT_TRUE(
      parting_direction(EdgeResolution::unit_sum, now, before, 2 * mm).isApprox(Vector3f(1, 0, 1) / std::sqrt(2.0f)));
  EXPECT_TRUE(parting_direction(EdgeResolution::vector_sum, now, before, 2 * mm)
                  .isApprox(Vector3f(3, 0, 2) / std::sqrt(13.0f)));
}

TEST(VirtualEdgeDirection, an_end_that_passed_the_other_goes_back_where_its_way_was_longer_than_the_contact_distance) {
  const Vector3f now(0, 0, -0.5f * mm);
  const auto direction = [&](EdgeResolution resolution, float before) {
    return parting_direction(resolution, now, {0, 0, before}, 2 * mm).z();
  };
  EXPECT_FLOAT_EQ(direction(EdgeResolution::push, 2.5f * mm), -1) << "the plain push drives it on";
  EXPECT_FLOAT_EQ(direction(EdgeResolution::vector_sum, 2.5f * mm), 1);
  EXPECT_FLOAT_EQ(direction(EdgeResolution::vector_sum, 1.0f * mm), -1);
  EXPECT_FLOAT_EQ(direction(EdgeResolution::unit_sum, 2.5f * mm), -1) << "the sum vanishes: the plain push is left";
}

TEST(VirtualEdgeDirection, ends_in_one_place_part_as_they_were_before_or_not_at_all) {
  for (const auto resolution : {EdgeResolution::push, EdgeResolution::unit_sum, EdgeResolution::vector_sum}) {
    const Vector3f none = Vector3f::Zero();
    EXPECT_TRUE(parting_direction(resolution, none, {0, 3 * mm, 0}, 2 * mm).isApprox(Vector3f(0, 1, 0)));
    EXPECT_TRUE(parting_direction(resolution, none, none, 2 * mm).isZero());
  }
}

namespace {

/// One particle, and where it was before.
struct Point {
  Particles now, before;
  Point(const Vec3& position, const Vec3& previous, Real inverse_mass)
      : now(make_particles(position, Eigen::VectorXd::Constant(1, inverse_mass))),
        before(make_particles(previous, Eigen::VectorXd::Constant(1, inverse_mass))) {}
};

bool part(Point& first, Point& second, EdgeResolution resolution, const Vector3f& shift = Vector3f::Zero()) {
  return part_ends({0, 0}, resolution, 2 * mm, shift, first.before, second.before, first.now, second.now);
}

}  // namespace

TEST(VirtualEdgePush, equal_ends_move_by_half_of_what_is_missing) {
  Point first({0, 0, 0.0005}, {0, 0, 0.0005}, 1), second({0, 0, 0}, {0, 0, 0}, 1);
  EXPECT_TRUE(part(first, second, EdgeResolution::push));
  EXPECT_TRUE(first.now.position(0).isApprox(Vector3f(0, 0, 1.25f * mm)));
  EXPECT_TRUE(second.now.position(0).isApprox(Vector3f(0, 0, -0.75f * mm)));
}

TEST(VirtualEdgePush, unequal_ends_move_by_their_inverse_masses_and_keep_momentum) {
  for (const auto resolution : {EdgeResolution::push, EdgeResolution::unit_sum, EdgeResolution::vector_sum}) {
    const Vec3 a(0.0003, 0.0002, 0.0005), b(0, 0.0001, 0);
    Point first(a, {0.002, 0, 0.001}, 1), second(b, {0, 0, -0.001}, 3);
    EXPECT_TRUE(part(first, second, resolution));
    const Vector3f one = first.now.position(0) - a.cast<float>(), other = second.now.position(0) - b.cast<float>();
    EXPECT_LT((one + other / 3).norm(), 1e-9f) << "m₁ Δx₁ + m₂ Δx₂";
    EXPECT_GT(one.norm(), 1e-4f);
    EXPECT_NEAR((first.now.position(0) - second.now.position(0)).norm(), 0.002, 1e-8);
  }
}

TEST(VirtualEdgePush, by_the_way_back_the_ends_come_to_lie_across_the_edge) {
  Point first({0, 0, 0.001}, {0.003, 0, 0.001}, 1), second({0, 0, 0}, {0, 0, 0}, 1);
  EXPECT_TRUE(part(first, second, EdgeResolution::vector_sum));
  // About the midpoint (0, 0, 0.5 mm), by 1 mm along (3, 0, 2)/√13.
  EXPECT_TRUE(first.now.position(0).isApprox(Vector3f(0.83205f, 0, 1.05470f) * mm, 1e-4f));
  EXPECT_TRUE(second.now.position(0).isApprox(Vector3f(-0.83205f, 0, -0.05470f) * mm, 1e-4f));
}

TEST(VirtualEdgePush, a_fixed_end_leaves_all_motion_to_the_other) {
  Point first({0, 0, 0.001}, {0, 0, 0.001}, 0), second({0, 0, 0}, {0, 0, 0}, 2);
  EXPECT_TRUE(part(first, second, EdgeResolution::push));
  EXPECT_TRUE(first.now.position(0).isApprox(Vector3f(0, 0, 1 * mm)));
  EXPECT_TRUE(second.now.position(0).isApprox(Vector3f(0, 0, -1 * mm)));
  Point fixed({0, 0, 0}, {0, 0, 0}, 0);
  EXPECT_FALSE(part(first, fixed, EdgeResolution::push));
}

TEST(VirtualEdgePush, the_common_motion_of_both_ends_changes_nothing) {
  const Vec3 common(0.04, -0.02, 0.03);
  for (const auto resolution : {EdgeResolution::push, EdgeResolution::unit_sum, EdgeResolution::vector_sum}) {
    Point first({0.001, 0, 0.001}, {0.003, 0, 0.001}, 1), second({0, 0, 0}, {0, 0, 0}, 1);
    Point carried({0.001, 0, 0.001}, Vec3(0.003, 0, 0.001) - common, 1), with({0, 0, 0}, -common, 1);
    part(first, second, resolution);
    part(carried, with, resolution);
    EXPECT_LT((first.now.position(0) - carried.now.position(0)).norm(), 1e-7f);
  }
}

TEST(VirtualEdgePush, acts_in_the_coordinates_of_each_surface) {
  Point first({0, 0, 0}, {0, 0, 0}, 1), second({0.1, 0, 0}, {0.1, 0, 0}, 1);
  EXPECT_TRUE(part(first, second, EdgeResolution::push, {0.1f, 0, 0.5f * mm}));
  EXPECT_TRUE(first.now.position(0).isApprox(Vector3f(0, 0, 0.75f * mm), 1e-4f));
  EXPECT_NEAR(second.now.position(0).z(), -0.00075, 1e-8);
}

namespace {

/// Surfaces that keep out of each other by virtual edges, with nothing else that acts on them.
struct Meeting {
  VirtualEdgeCrowd crowd;
  VirtualEdgeState state;
  std::vector<Particles> particles;

  void add(const TriangleMesh& mesh, const Eigen::VectorXd& inverse_masses) {
    crowd.stars.push_back(build_topology(mesh.faces, mesh.vertex_count()).stars);
    particles.push_back(make_particles(mesh.vertices, inverse_masses));
  }
  void add(const TriangleMesh& mesh) { add(mesh, Eigen::VectorXd::Ones(mesh.vertex_count())); }

  /// All may meet all.
  void start() {
    std::vector<std::array<Index, 2>> pairs;
    for (Index first = 0; first < static_cast<Index>(particles.size()); ++first)
      for (Index second = first + 1; second < static_cast<Index>(particles.size()); ++second) {
        crowd.pairs.push_back({first, second});
        pairs.push_back({first, second});
      }
    crowd.rounds = rounds_of(pairs);
    state = make_virtual_edge_state(crowd);
  }

  template <class Pointer>
  std::vector<Pointer> pointers() {
    std::vector<Pointer> result;
    for (Particles& each : particles) result.push_back(&each);
    return result;
  }

  /// Moves a surface as one, as a prediction does, and projects so many times.
  Index frame(std::size_t moved, const Vector3f& by, int iterations) {
    begin_edge_frame(crowd, pointers<const Particles*>(), state);
    remember_positions(pointers<const Particles*>(), state);
    for (Index p = 0; p < particles[moved].count(); ++p) particles[moved].position(p) += by;
    adapt_distances(crowd, pointers<const Particles*>(), state);
    Index pushes = 0;
    for (int i = 0; i < iterations; ++i) pushes = project_virtual_edges(crowd, pointers<Particles*>(), state);
    end_edge_frame(crowd, state);
    return pushes;
  }
};

/// Two balls of 10 mm, 1 mm apart, of particles with different masses.
Meeting two_balls() {
  Meeting meeting;
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

}  // namespace

TEST(VirtualEdgeSeeds, lead_from_every_particle_within_reach_to_the_nearest_of_the_other_surface) {
  Meeting meeting = two_balls();
  meeting.crowd.settings.reach = 0.005f;
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
  Meeting meeting = two_balls();
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

TEST(VirtualEdgeCrowd, two_balls_that_move_into_each_other_are_parted_to_the_contact_distance) {
  for (const auto resolution : {EdgeResolution::push, EdgeResolution::unit_sum, EdgeResolution::vector_sum}) {
    Meeting meeting = two_balls();
    meeting.crowd.settings.resolution = resolution;
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

TEST(VirtualEdgeCrowd, balls_farther_than_the_contact_distance_are_left_alone) {
  Meeting meeting = two_balls();
  meeting.crowd.settings.distance = 0.9f * mm;
  const std::vector<Particles> before = meeting.particles;
  EXPECT_EQ(meeting.frame(0, Vector3f::Zero(), 5), 0);
  EXPECT_EQ(meeting.particles[0].xyzw, before[0].xyzw);
}

TEST(VirtualEdgeCrowd, an_adaptive_contact_distance_is_what_the_ends_came_nearer) {
  Meeting meeting = two_balls();
  meeting.crowd.settings.adaptive = true;
  meeting.crowd.settings.distance = 0.1f * mm;
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

TEST(VirtualEdgeCrowd, edges_stay_where_they_ended_or_begin_at_their_seeds_in_every_iteration) {
  for (const bool reset : {false, true}) {
    Meeting meeting;
    meeting.add(straight_strip(31)), meeting.add(tetrahedron({0.03, 0, 0.001}));
    meeting.start();
    meeting.crowd.settings.reset = reset;
    meeting.crowd.settings.walk_steps = 5;
    meeting.crowd.settings.distance = 0.5f * mm;
    meeting.crowd.settings.reach = 0.1f;
    meeting.frame(0, Vector3f::Zero(), 3);
    ASSERT_EQ(meeting.state.pairs[0].edges.front().seed, (VirtualEdge{0, 0}));
    EXPECT_EQ(meeting.state.pairs[0].edges.front().now.a, reset ? 10 : 30) << "columns 5 and 15";
  }
}

namespace {

/// Seven edges, of which three end on (1, 1) and two on (2, 2).
Meeting with_coinciding_edges(CoincidingEdgeRule rule) {
  Meeting meeting = two_balls();
  meeting.crowd.settings.coinciding = rule;
  PairEdges& pair = meeting.state.pairs[0];
  const Index ends[] = {1, 2, 1, 3, 2, 1, 4};
  for (Index i = 0; i < 7; ++i) pair.edges.push_back({{10 + i, 20 + i}, {ends[i], ends[i]}, 0});
  end_edge_frame(meeting.crowd, meeting.state);
  return meeting;
}

}  // namespace

TEST(CoincidingVirtualEdges, are_counted_and_left) {
  const Meeting meeting = with_coinciding_edges(CoincidingEdgeRule::keep);
  EXPECT_EQ(meeting.state.pairs[0].coinciding, 3);
  EXPECT_EQ(meeting.state.pairs[0].edges.size(), 7u);
}

TEST(CoincidingVirtualEdges, are_dropped_but_for_the_first) {
  const Meeting meeting = with_coinciding_edges(CoincidingEdgeRule::drop);
  const auto& edges = meeting.state.pairs[0].edges;
  EXPECT_EQ(meeting.state.pairs[0].coinciding, 3);
  ASSERT_EQ(edges.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(edges[i].now.a, static_cast<Index>(i + 1));
}

TEST(CoincidingVirtualEdges, begin_again_between_ends_of_seeds_the_same_in_every_run) {
  const Meeting one = with_coinciding_edges(CoincidingEdgeRule::reseed);
  const Meeting other = with_coinciding_edges(CoincidingEdgeRule::reseed);
  const auto &edges = one.state.pairs[0].edges, &again = other.state.pairs[0].edges;
  ASSERT_EQ(edges.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(edges[i].now, again[i].now);
    const bool repeated = i == 2 || i == 4 || i == 5;
    EXPECT_EQ(edges[i].now.a >= 10, repeated);
    EXPECT_EQ(edges[i].now.b >= 20, repeated);
  }
}

TEST(VirtualEdgeCrowd, has_the_same_bits_for_any_number_of_threads) {
  for (const auto rule : {CoincidingEdgeRule::keep, CoincidingEdgeRule::reseed}) {
    std::set<std::uint64_t> hashes;
    for (const int threads : {1, 2, 2}) {
      const ThreadLimit limit(threads);
      Meeting meeting;
      for (const Real x : {0.0, 0.0195})
        for (const Real y : {0.0, 0.0195}) meeting.add(shapes::sphere({x, y, 0.1 * x + 0.05 * y}, 0.01, 3));
      meeting.start();
      meeting.crowd.settings.coinciding = rule;
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

}  // namespace gracilis
