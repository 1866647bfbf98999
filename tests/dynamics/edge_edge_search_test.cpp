#include <gracilis/dynamics/contact/surface/edge_edge_search.hpp>
#include <gracilis/dynamics/contact/surface/overlap_release.hpp>

#include "meeting_surfaces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

namespace gracilis {
namespace {

using Pairs = std::map<std::pair<Index, Index>, EdgeEdgeCandidate>;

/// How near edges are when they are listed, m.
constexpr float listed_within = 0.0008f;

Eigen::Vector3f normal_of(const ContactSurface& surface, Index edge, const Particles& particles) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const Index face : surface.edges[static_cast<std::size_t>(edge)].faces)
    sum += face_area(surface, face, particles).normalized();
  return sum;
}

EdgeGap gap_between(const Meeting& meeting, Index edge, Index other) {
  const SurfacePair& pair = meeting.world.pairs[0];
  const ContactSurface &first = meeting.world.surfaces[0], &second = meeting.world.surfaces[1];
  const auto& a = first.edges[static_cast<std::size_t>(edge)].ends;
  const auto& b = second.edges[static_cast<std::size_t>(other)].ends;
  const Particles &of_first = meeting.particles[0], &of_second = meeting.particles[1];
  return edge_gap(of_first.position(a[0]) + pair.shift, of_first.position(a[1]) + pair.shift, of_second.position(b[0]),
                  of_second.position(b[1]), normal_of(second, other, of_second) - normal_of(first, edge, of_first));
}

Pairs found_in(Meeting& meeting) {
  meeting.find();
  meeting.follow();
  std::vector<EdgeEdgeCandidate> found;
  find_edges(meeting.world, meeting.world.pairs[0], meeting.pointers<const Particles*>(meeting.particles),
             meeting.state.before, meeting.state.candidates[0].near_second, nullptr, found);
  Pairs pairs;
  for (const EdgeEdgeCandidate& each : found)
    EXPECT_TRUE(pairs.emplace(std::pair(each.first, each.second), each).second) << "listed twice";
  return pairs;
}

/// By trying all.
std::map<std::pair<Index, Index>, float> crossing_in(const Meeting& meeting, float within) {
  std::map<std::pair<Index, Index>, float> crossing;
  for (Index e = 0; e < static_cast<Index>(meeting.world.surfaces[0].edges.size()); ++e)
    for (Index o = 0; o < static_cast<Index>(meeting.world.surfaces[1].edges.size()); ++o)
      if (const EdgeGap gap = gap_between(meeting, e, o); gap.crossing && std::abs(gap.distance) < within)
        crossing.emplace(std::pair(e, o), gap.distance);
  return crossing;
}

/// Two balls of 10 mm in coordinates that are shifted against each other, so far in each other.
Meeting balls(Real too_near) {
  Meeting meeting;
  meeting.add(shapes::sphere({-0.5, 0, 0}, 0.01, 3));
  meeting.add(shapes::sphere({0.02 - too_near, 0.0003, 0.0002}, 0.01, 3));
  meeting.pair(0, 1, 0.0003f).shift = Eigen::Vector3f(0.5f, 0, 0);
  meeting.prepare();
  remember_places(meeting.pointers<const Particles*>(meeting.particles), meeting.state);
  return meeting;
}

}  // namespace

TEST(EdgeEdgeSearch, finds_every_two_edges_that_cross_closely_and_no_others) {
  for (const Real too_near : {-0.0003, 0.0002}) {
    Meeting meeting = balls(too_near);
    const auto expected = crossing_in(meeting, listed_within);
    const Pairs found = found_in(meeting);
    EXPECT_GT(expected.size(), 10u);
    for (const auto& [edges, distance] : expected) EXPECT_TRUE(found.contains(edges)) << distance;
    EXPECT_EQ(found.size(), expected.size());
  }
}

TEST(EdgeEdgeSearch, what_has_not_passed_is_asked_to_keep_the_gap_and_what_has_to_come_back_bit_by_bit) {
  for (const auto& [too_near, way] : {std::pair(-0.0001, -0.0006f), std::pair(0.0006, 0.0001f)}) {
    Meeting meeting = balls(too_near);
    const std::map<std::pair<Index, Index>, float> before = crossing_in(meeting, 1);
    meeting.move(1, {way, 0, 0});
    Index passed = 0;
    const auto now = crossing_in(meeting, 1);
    for (const auto& [edges, candidate] : found_in(meeting)) {
      const bool has_passed = now.at(edges) < 0;
      if (has_passed) ++passed;
      const float most =
          has_passed && before.contains(edges) ? std::min(0.0003f, before.at(edges) + asked_at_once) : 0.0003f;
      EXPECT_NEAR(candidate.most_gap, most, 1e-6f) << now.at(edges);
      EXPECT_EQ(candidate.side, 1);
    }
    EXPECT_GT(passed, 3);
  }
}

TEST(EdgeEdgeSearch, of_edges_with_different_gaps_the_largest_counts) {
  Meeting meeting = balls(-0.0001);
  SurfacePair& pair = meeting.world.pairs[0];
  for (std::size_t p = 0; p < pair.first_gap.size(); ++p) pair.first_gap[p] = 1e-6f * static_cast<float>(p);
  for (std::size_t p = 0; p < pair.second_gap.size(); ++p) pair.second_gap[p] = 2e-6f * static_cast<float>(p);
  const Pairs found = found_in(meeting);
  ASSERT_GT(found.size(), 3u);
  for (const auto& [edges, candidate] : found) {
    const auto& a = meeting.world.surfaces[0].edges[static_cast<std::size_t>(edges.first)].ends;
    const auto& b = meeting.world.surfaces[1].edges[static_cast<std::size_t>(edges.second)].ends;
    // Ends are in ascending order. Of both edges' largest gaps the smaller one is kept.
    EXPECT_NEAR(candidate.most_gap, std::min(1e-6f * static_cast<float>(a[1]), 2e-6f * static_cast<float>(b[1])),
                1e-9f);
  }
}

TEST(EdgeEdgeSearch, what_overlaps_at_rest_comes_out_at_the_pace_of_the_pair) {
  Meeting meeting = balls(0.0002);
  SurfacePair& pair = meeting.world.pairs[0];
  pair.first_overlaps.assign(pair.first_gap.size(), 1);
  pair.release = 0.00002f;
  const auto before = crossing_in(meeting, 1);
  const Pairs found = found_in(meeting);
  EXPECT_GT(found.size(), 3u);
  for (const auto& [edges, candidate] : found)
    EXPECT_NEAR(candidate.most_gap, std::min(0.0003f, before.at(edges) + 0.00002f), 1e-7f);
}

TEST(EdgeEdgeSearch, finds_nothing_where_nothing_is_near) {
  Meeting meeting = balls(-0.02);
  EXPECT_TRUE(found_in(meeting).empty());
}

}  // namespace gracilis
