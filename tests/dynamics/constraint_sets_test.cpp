#include <gracilis/dynamics/constraints/dihedral.hpp>
#include <gracilis/dynamics/constraints/distance.hpp>
#include <gracilis/dynamics/constraints/volume.hpp>
#include <gracilis/geometry/topology.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace gracilis {
namespace {

const TriangleMesh& ball_surface() {
  static const TriangleMesh mesh = shapes::sphere(Vec3::Zero(), 0.05, 2);
  return mesh;
}

std::vector<DistanceConstraint> distances() {
  std::vector<DistanceConstraint> result;
  for (const MeshEdge& e : build_topology(ball_surface().faces, ball_surface().vertex_count()).edges)
    result.push_back({e.a, e.b, 0.001 * static_cast<Real>(result.size() + 1), 0.5 * static_cast<Real>(result.size())});
  return result;
}

std::vector<DihedralConstraint> dihedrals() {
  std::vector<DihedralConstraint> result;
  for (const MeshEdge& e : build_topology(ball_surface().faces, ball_surface().vertex_count()).edges) {
    const auto number = static_cast<Real>(result.size() + 1);
    result.push_back({{e.a, e.b, e.left_apex, e.right_apex}, 0.01 * number, 0.5 * number, 0.002 * number});
  }
  return result;
}

template <class Set>
void expect_whole_groups_that_follow_each_other(const Set& set, std::size_t size) {
  Index end = 0;
  for (const ColorRange& color : set.order.colors) {
    EXPECT_EQ(color.begin, end);
    EXPECT_GT(color.end, color.begin);
    EXPECT_EQ(color.end % group_width, 0);
    end = color.end;
  }
  EXPECT_EQ(static_cast<std::size_t>(end), size);
}

template <class Set>
std::set<Index> used_slots(const Set& set) {
  const std::set<Index> slots(set.slot.begin(), set.slot.end());
  EXPECT_EQ(slots.size(), set.slot.size()) << "two constraints went to one slot";
  return slots;
}

}  // namespace

TEST(DistanceSet, clusters_touch_no_particle_of_another_and_hold_most_constraints) {
  const TriangleMesh mesh = shapes::sphere(Vec3::Zero(), 0.05, 6);
  const std::vector<Index> order = breadth_first_order(build_topology(mesh.faces, mesh.vertex_count()).stars);
  std::vector<Index> number(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) number[static_cast<std::size_t>(order[i])] = static_cast<Index>(i);
  std::vector<DistanceConstraint> input;
  for (const MeshEdge& e : build_topology(mesh.faces, mesh.vertex_count()).edges)
    input.push_back({number[static_cast<std::size_t>(e.a)], number[static_cast<std::size_t>(e.b)], 1, 0});
  const DistanceSet set = build_distance_set(input, mesh.vertex_count());
  expect_whole_groups_that_follow_each_other(set, set.a.size());
  EXPECT_EQ(used_slots(set).size(), input.size());
  ASSERT_GT(set.order.cluster_count(), 1);
  std::map<Index, Index> cluster_of;  // particles
  Index inside = 0;
  for (Index cluster = 0; cluster < set.order.cluster_count(); ++cluster)
    for (Index color = set.order.clusters[static_cast<std::size_t>(cluster)];
         color < set.order.clusters[static_cast<std::size_t>(cluster) + 1]; ++color) {
      const ColorRange range = set.order.colors[static_cast<std::size_t>(color)];
      for (auto slot = static_cast<std::size_t>(range.begin); slot < static_cast<std::size_t>(range.end); ++slot) {
        inside += set.a[slot] < mesh.vertex_count();  // beyond: padding, which threads do not share either
        EXPECT_EQ(cluster_of.try_emplace(set.a[slot], cluster).first->second, cluster);
        EXPECT_EQ(cluster_of.try_emplace(set.b[slot], cluster).first->second, cluster);
      }
    }
  EXPECT_GT(inside, set.count * 3 / 4);
}

TEST(DistanceSet, puts_every_constraint_into_a_slot_of_its_own_with_its_numbers) {
  const std::vector<DistanceConstraint> input = distances();
  const DistanceSet set = build_distance_set(input, ball_surface().vertex_count());
  EXPECT_EQ(set.count, static_cast<Index>(input.size()));
  expect_whole_groups_that_follow_each_other(set, set.a.size());
  ASSERT_EQ(used_slots(set).size(), input.size());
  for (std::size_t i = 0; i < input.size(); ++i) {
    const auto at = static_cast<std::size_t>(set.slot[i]);
    EXPECT_EQ(set.a[at], input[i].a);
    EXPECT_EQ(set.b[at], input[i].b);
    EXPECT_EQ(set.rest_length[at], static_cast<float>(input[i].rest_length));
    EXPECT_EQ(set.compliance[at], static_cast<float>(input[i].compliance));
  }
}

TEST(DistanceSet, pads_with_the_idle_particle) {
  const DistanceSet set = build_distance_set(distances(), ball_surface().vertex_count());
  const std::set<Index> used = used_slots(set);
  Index padding = 0;
  for (std::size_t at = 0; at < set.a.size(); ++at) {
    if (used.contains(static_cast<Index>(at))) continue;
    ++padding;
    EXPECT_EQ(set.a[at], ball_surface().vertex_count());
    EXPECT_EQ(set.b[at], ball_surface().vertex_count());
    EXPECT_EQ(set.rest_length[at], 0);
  }
  EXPECT_GT(padding, 0);
}

TEST(DistanceSet, no_particle_but_the_idle_one_stands_twice_in_a_color) {
  const DistanceSet set = build_distance_set(distances(), ball_surface().vertex_count());
  for (const ColorRange& color : set.order.colors) {
    std::set<Index> seen;
    for (Index slot = color.begin; slot < color.end; ++slot)
      for (Index p : {set.a[static_cast<std::size_t>(slot)], set.b[static_cast<std::size_t>(slot)]})
        if (p != ball_surface().vertex_count()) {
          EXPECT_TRUE(seen.insert(p).second);
        }
  }
}

TEST(DihedralSet, puts_every_constraint_into_a_slot_of_its_own_with_its_numbers) {
  const std::vector<DihedralConstraint> input = dihedrals();
  const DihedralSet set = build_dihedral_set(input, ball_surface().vertex_count());
  EXPECT_EQ(set.count, static_cast<Index>(input.size()));
  expect_whole_groups_that_follow_each_other(set, set.rest_angle.size());
  std::map<Index, std::size_t> input_of;  // by the edge's ends
  const auto edge = [&](Index a, Index b) { return a * ball_surface().vertex_count() + b; };
  for (std::size_t i = 0; i < input.size(); ++i) input_of[edge(input[i].particles[0], input[i].particles[1])] = i;
  for (std::size_t at = 0; at < set.rest_angle.size(); ++at) {
    if (set.particles[0][at] == ball_surface().vertex_count()) {  // padding
      for (std::size_t k = 1; k < 4; ++k) EXPECT_EQ(set.particles[k][at], ball_surface().vertex_count());
      continue;
    }
    const auto found = input_of.find(edge(set.particles[0][at], set.particles[1][at]));
    ASSERT_NE(found, input_of.end()) << "not in the input, or twice in the set";
    const DihedralConstraint& dihedral = input[found->second];
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(set.particles[k][at], dihedral.particles[k]);
    EXPECT_EQ(set.rest_angle[at], static_cast<float>(dihedral.rest_angle));
    EXPECT_EQ(set.compliance[at], static_cast<float>(dihedral.compliance));
    EXPECT_EQ(set.edge_length[at], static_cast<float>(dihedral.edge_length));
    input_of.erase(found);
  }
  EXPECT_TRUE(input_of.empty());
}

TEST(ConstraintSets, of_nothing_are_empty) {
  const DistanceSet distance = build_distance_set({}, 5);
  EXPECT_TRUE(distance.a.empty());
  EXPECT_TRUE(distance.order.colors.empty());
  const DihedralSet dihedrals = build_dihedral_set({}, 5);
  EXPECT_TRUE(dihedrals.rest_angle.empty());
  EXPECT_TRUE(dihedrals.order.colors.empty());
}

/// The neighbors in a volume set's ring of every particle that has one, without repetition at the end.
std::map<Index, std::vector<Index>> rings_of(const VolumeSet& set, Index particle_count) {
  std::map<Index, std::vector<Index>> rings;
  for (Index group = 0; group < set.group_count(); ++group)
    for (Index lane = 0; lane < group_width; ++lane) {
      const Index particle = set.particles[static_cast<std::size_t>(group * group_width + lane)];
      if (particle == particle_count) continue;
      EXPECT_FALSE(rings.contains(particle));
      std::vector<Index>& ring = rings[particle];
      for (Index step = set.ring_offsets[static_cast<std::size_t>(group)];
           step < set.ring_offsets[static_cast<std::size_t>(group) + 1]; ++step)
        ring.push_back(set.ring[static_cast<std::size_t>(step * group_width + lane)]);
      while (ring.size() > 1 && ring[ring.size() - 1] == ring[ring.size() - 2]) ring.pop_back();
      EXPECT_EQ(ring.front(), ring.back());
      ring.pop_back();
    }
  return rings;
}

TEST(VolumeSet, rings_hold_every_neighbor_once_and_turn_with_the_faces) {
  const VolumeSet set = build_volume_set(ball_surface().faces, ball_surface().vertex_count(), 1, 0);
  const VertexStars stars = build_topology(ball_surface().faces, ball_surface().vertex_count()).stars;
  std::set<std::array<Index, 3>> corners;  // of every face, each corner first once
  for (Index f = 0; f < ball_surface().face_count(); ++f)
    for (int k = 0; k < 3; ++k)
      corners.insert(
          {ball_surface().faces(k, f), ball_surface().faces((k + 1) % 3, f), ball_surface().faces((k + 2) % 3, f)});
  const auto rings = rings_of(set, ball_surface().vertex_count());
  ASSERT_EQ(rings.size(), static_cast<std::size_t>(ball_surface().vertex_count()));
  for (const auto& [v, ring] : rings) {
    const auto at = static_cast<std::size_t>(v);
    const std::set<Index> expected(stars.neighbors.begin() + stars.offsets[at],
                                   stars.neighbors.begin() + stars.offsets[at + 1]);
    EXPECT_EQ(std::set<Index>(ring.begin(), ring.end()), expected);
    EXPECT_EQ(ring.size(), expected.size());
    for (std::size_t i = 0; i < ring.size(); ++i)
      EXPECT_TRUE(corners.contains({v, ring[i], ring[(i + 1) % ring.size()]}));
  }
}

TEST(VolumeSet, a_particle_without_faces_has_no_ring) {
  const Index count = ball_surface().vertex_count() + 1;
  const auto rings = rings_of(build_volume_set(ball_surface().faces, count, 1, 0), count);
  EXPECT_EQ(rings.size(), static_cast<std::size_t>(ball_surface().vertex_count()));
  EXPECT_FALSE(rings.contains(ball_surface().vertex_count()));
}

}  // namespace gracilis
