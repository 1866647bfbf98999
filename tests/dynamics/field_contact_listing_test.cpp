#include <gracilis/dynamics/contact/field/field_contact_listing.hpp>

#include "around_a_ball.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace gracilis {
namespace {

constexpr float kept_gap = 0.0005f;

/// Edges and faces of one corner each, at all heights above and below a ball's surface, some of them fixed.
Scenario scattered(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  const auto direction = [&]() -> Vec3 { return Vec3(uniform(random), uniform(random), uniform(random)).normalized(); };
  std::vector<Vec3> places;
  std::vector<Real> inverse_masses;
  std::vector<DistanceConstraint> edges;
  Eigen::Matrix3Xi faces(3, 300);
  for (Index i = 0; i < 300; ++i) {
    const Vec3 outward = direction(), along = outward.cross(direction()).normalized(), across = outward.cross(along);
    const Vec3 middle = (radius + 0.006 * (1 + uniform(random))) * outward;
    const Real size = 0.003 * (1.1 + uniform(random));
    for (const Vec3& way : {along, Vec3(-0.5 * along + 0.8 * across), Vec3(-0.5 * along - 0.8 * across)})
      places.push_back(middle + size * (way + 0.5 * uniform(random) * outward));
    for (int k = 0; k < 3; ++k) inverse_masses.push_back(i % 7 == 0 && k > i % 3 ? 0 : 1);
    edges.push_back({3 * i, 3 * i + 1, (places[static_cast<std::size_t>(3 * i)] - places.back()).norm(), 0});
    edges.back().rest_length =
        (places[static_cast<std::size_t>(3 * i)] - places[static_cast<std::size_t>(3 * i + 1)]).norm();
    faces.col(i) << 3 * i, 3 * i + 1, 3 * i + 2;
  }
  Scenario scenario = points_at(places, inverse_masses, kept_gap);
  scenario.distances = build_distance_set(edges, static_cast<Index>(places.size()));
  scenario.faces = build_face_set(faces, static_cast<Index>(places.size()));
  scenario.contact.captured.edge_sag.assign(scenario.distances.a.size(), 0);
  scenario.contact.captured.face_sag.assign(static_cast<std::size_t>(scenario.faces.count()), 0);
  scenario.contact.released = scenario.contact.captured;
  const float reach = listing_reach(scenario.distances, 0.006f);
  find_near(scenario.contact, scenario.distances, scenario.faces, scenario.placement, reach, scenario.particles,
            scenario.near);
  return scenario;
}

Vec3 place_of(const Scenario& scenario, Index p) { return scenario.particles.position(p).cast<Real>(); }

Real above_gap(const Vec3& p) { return p.norm() - radius - kept_gap; }

bool any_can_move(const Scenario& scenario, std::initializer_list<Index> particles) {
  return std::any_of(particles.begin(), particles.end(),
                     [&](Index p) { return scenario.particles.inverse_mass(p) > 0; });
}

}  // namespace

TEST(FieldContactListing, no_edge_that_may_touch_before_the_next_listing_is_left_out_and_few_others_are_listed) {
  const Scenario scenario = scattered(5);
  std::set<Index> listed;
  for (Index i = 0; i < scenario.near.edges.count(); ++i)
    if (const Index a = scenario.near.edges.a[static_cast<std::size_t>(i)]; a < scenario.particles.count())
      listed.insert(a / 3);
  Index left_out = 0;
  for (Index i = 0; i < 300; ++i) {
    const Vec3 a = place_of(scenario, 3 * i), b = place_of(scenario, 3 * i + 1);
    Real lowest = 1;
    for (int k = 0; k <= 20; ++k) lowest = std::min(lowest, above_gap(a + k / 20.0 * (b - a)));
    if (!any_can_move(scenario, {3 * i, 3 * i + 1})) {
      EXPECT_FALSE(listed.contains(i)) << "nothing of it moves";
    } else if (lowest < element_reach) {
      EXPECT_TRUE(listed.contains(i)) << i << ": " << lowest;
    } else if ((above_gap(a) + above_gap(b) - 1.11 * (b - a).norm()) / 2 > element_reach + 2e-4) {
      EXPECT_FALSE(listed.contains(i)) << i << ": " << lowest << " both ends are far away for its length";
      ++left_out;
    }
  }
  EXPECT_GT(left_out, 50);
  EXPECT_GT(listed.size(), 50u);
}

TEST(FieldContactListing, no_face_that_may_touch_before_the_next_listing_is_left_out_and_few_others_are_listed) {
  const Scenario scenario = scattered(6);
  std::set<Index> listed;
  for (const Index slot : scenario.near.faces.slots)
    listed.insert(scenario.faces.particles[0][static_cast<std::size_t>(slot)] / 3);
  Index left_out = 0;
  for (Index i = 0; i < 300; ++i) {
    const Vec3 a = place_of(scenario, 3 * i), b = place_of(scenario, 3 * i + 1), c = place_of(scenario, 3 * i + 2);
    Real lowest = 1;
    for (int k = 0; k <= 12; ++k)
      for (int l = 0; l + k <= 12; ++l)
        lowest = std::min(lowest, above_gap(a + k / 12.0 * (b - a) + l / 12.0 * (c - a)));
    const Real longest = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
    const Real of_corners = std::min({above_gap(a), above_gap(b), above_gap(c)});
    if (!any_can_move(scenario, {3 * i, 3 * i + 1, 3 * i + 2})) {
      EXPECT_FALSE(listed.contains(i));
    } else if (lowest < element_reach) {
      EXPECT_TRUE(listed.contains(i)) << i << ": " << lowest;
    } else if (of_corners > element_reach + 0.64 * longest + 2e-4) {
      EXPECT_FALSE(listed.contains(i)) << i << ": " << lowest;
      ++left_out;
    }
  }
  EXPECT_GT(left_out, 20);
  EXPECT_GT(listed.size(), 50u);
}

TEST(FieldContactListing, of_a_face_the_lowest_point_is_told_and_the_gap_there) {
  Scenario scenario = scattered(7);
  // Corners keep gaps of their own, and the face sags besides.
  for (std::size_t p = 0; p < scenario.contact.captured.particle.size(); ++p)
    scenario.contact.captured.particle[p] = 1e-6f * static_cast<float>(p % 3);
  scenario.contact.captured.face_sag.assign(static_cast<std::size_t>(scenario.faces.count()), -3e-4f);
  scenario.contact.released = scenario.contact.captured;
  scenario.look();
  ASSERT_GT(scenario.near.faces.count(), 30);
  for (Index i = 0; i < scenario.near.faces.count(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Eigen::Vector3f where = scenario.near.faces.where[at];
    const auto slot = static_cast<std::size_t>(scenario.near.faces.slots[at]);
    float gap = -3e-4f;
    bool all_move = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index p = scenario.faces.particles[k][slot];
      gap += where[static_cast<Index>(k)] * 1e-6f * static_cast<float>(p % 3);
      all_move = all_move && scenario.particles.inverse_mass(p) > 0;
    }
    if (!all_move) continue;
    EXPECT_NEAR(scenario.near.faces.gap[at], gap, 1e-9f);
  }
}

TEST(FieldContactListing, of_an_edge_the_gaps_at_its_ends_its_sag_and_its_middle_are_told) {
  Scenario scenario = points_at({{-0.002, 0.031, 0}, {0.004, 0.032, 0}}, {1, 0}, 0);
  scenario.distances = build_distance_set({{0, 1, 0.006, 0}}, 2);
  scenario.contact.captured.particle = {1e-4f, 3e-4f};
  scenario.contact.released.particle = {2e-4f, 5e-4f};
  scenario.contact.captured.edge_sag.assign(scenario.distances.a.size(), -2e-4f);
  scenario.contact.released.edge_sag.assign(scenario.distances.a.size(), -4e-4f);
  scenario.placement.release = 0.25f;
  scenario.look();
  const NearEdges& edges = scenario.near.edges;
  const auto at = static_cast<std::size_t>(std::find_if(edges.a.begin(), edges.a.end(), [](Index a) { return a < 2; }) -
                                           edges.a.begin());
  ASSERT_LT(at, edges.a.size());
  const bool swapped = edges.a[at] == 1;
  const float sag = -2.5e-4f, of_first = 1.25e-4f + sag, of_second = 3.5e-4f + sag;
  EXPECT_NEAR(swapped ? edges.gap_b[at] : edges.gap_a[at], of_first, 1e-9f);
  EXPECT_NEAR(swapped ? edges.gap_a[at] : edges.gap_b[at], of_second, 1e-9f);
  EXPECT_NEAR(swapped ? edges.low[at] : 1 - edges.high[at], 0.2f, 1e-6f) << "at the end that cannot move";
  EXPECT_EQ(swapped ? edges.high[at] : 1 - edges.low[at], 1);
  EXPECT_NEAR(edges.seen_x[at], 0.001f, 1e-8f);
  EXPECT_NEAR(edges.seen_y[at], 0.0315f, 1e-8f);
}

TEST(FieldContactListing, the_reach_follows_from_the_longest_edge) {
  const DistanceSet edges = build_distance_set({{0, 1, 0.002, 0}, {1, 2, 0.005, 0}}, 3);
  EXPECT_NEAR(listing_reach(edges, 0.006f), 0.002 + 4 * 1.1 * 0.005, 1e-7);
  EXPECT_NEAR(listing_reach(edges, 0.05f), 0.05, 1e-7);
  EXPECT_NEAR(listing_reach(DistanceSet(), 0.001f), 0.002, 1e-9);
}

}  // namespace gracilis
