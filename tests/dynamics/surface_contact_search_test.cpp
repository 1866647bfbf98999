#include <gracilis/dynamics/contact/surface/surface_contact.hpp>

#include <shapes.hpp>

#include "meeting_surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis {

TEST(SurfaceContact, what_was_found_is_trusted_until_something_has_drifted_by_two_fifths_of_the_reach) {
  Meeting meeting = pressed_balls(-0.001);
  meeting.prepare();
  meeting.find();
  const PairCandidates& candidates = meeting.state.candidates[0];
  const std::size_t found = candidates.near_second.size();
  EXPECT_GT(found, 10u);
  meeting.move(1, {-0.0023f, 0, 0});
  meeting.find();
  EXPECT_EQ(candidates.near_second.size(), found);
  meeting.move(1, {-0.0002f, 0, 0});
  meeting.find();
  EXPECT_GT(candidates.near_second.size(), found) << "what came near is found";
  EXPECT_EQ(candidates.drift, 0);
}

TEST(SurfaceContact, drifts_there_and_back_add_up) {
  Meeting meeting = pressed_balls(-0.001);
  meeting.prepare();
  meeting.find();
  for (const float way : {0.0013f, -0.0013f}) {
    meeting.move(1, {0, way, 0});
    meeting.follow();
  }
  EXPECT_NEAR(meeting.state.candidates[0].drift, 0.0026, 1e-6);
  meeting.find();
  EXPECT_EQ(meeting.state.candidates[0].drift, 0) << "it was searched again";
}

TEST(SurfaceContact, every_update_period_th_frame_searches_everything) {
  Meeting meeting = pressed_balls(-0.001);
  meeting.world.settings.update_period = 2;
  meeting.prepare();
  const auto found = [&] {
    begin_contact_frame(meeting.world, meeting.state);
    meeting.find();
    return meeting.state.candidates[0].near_second.size();
  };
  const std::size_t first = found();
  meeting.move(1, {-0.001f, 0, 0});
  EXPECT_EQ(found(), first) << "nothing drifted far";
  EXPECT_GT(found(), first);
}

TEST(SurfaceContact, within_a_step_lists_stay_where_hardly_anything_moves) {
  Meeting meeting = pressed_balls(-0.001);
  meeting.prepare();
  meeting.find();
  meeting.follow();
  const std::vector<VertexFaceCandidate>& listed = meeting.state.candidates[0].on_second;
  const auto nearest = [&] {
    float least = 1;
    for (const VertexFaceCandidate& candidate : listed) least = std::min(least, candidate.distance);
    return least;
  };
  EXPECT_NEAR(nearest(), 0.001, 1e-4);
  meeting.move(1, {-0.0004f, 0, 0});
  meeting.follow();
  EXPECT_NEAR(nearest(), 0.001, 1e-4);
  meeting.move(1, {-0.0004f, 0, 0});
  meeting.follow();
  EXPECT_NEAR(nearest(), 0.0002, 1e-4) << "0.8 mm in all";
  meeting.move(1, {0.0004f, 0, 0});
  meeting.find();
  meeting.follow();
  EXPECT_NEAR(nearest(), 0.0006, 1e-4) << "a new step looks again";
}

TEST(SurfaceContact, what_is_within_a_millimeter_and_a_half_is_listed_and_with_cohesion_what_is_within_reach) {
  for (const float cohesion : {0.0f, 0.001f}) {
    Meeting meeting = pressed_balls(-0.001);
    meeting.world.settings.cohesion = cohesion;
    meeting.prepare();
    meeting.find();
    meeting.follow();
    const PairCandidates& candidates = meeting.state.candidates[0];
    Index beyond = 0, expected = 0;
    const float within = 0.0015f + (cohesion > 0 ? meeting.world.pairs[0].reach : 0);
    for (const VertexFaceCandidate& candidate : candidates.near_second) expected += candidate.distance < within;
    for (const VertexFaceCandidate& candidate : candidates.on_second) beyond += candidate.distance >= 0.0015f;
    EXPECT_EQ(static_cast<Index>(candidates.on_second.size()), expected);
    EXPECT_GT(expected, 3);
    EXPECT_EQ(beyond > 0, cohesion > 0);
  }
}

TEST(SurfaceContact, normals_from_before_are_not_used) {
  Meeting fresh, stale;
  for (Meeting* meeting : {&fresh, &stale}) {
    // Vertex against vertex, where normals alone tell the sides.
    meeting->add(shapes::sphere(Vec3::Zero(), 0.01, 4));
    meeting->add(shapes::sphere({0.0197, 0, 0}, 0.01, 4));
    meeting->pair(0, 1, 0.0003f);
    meeting->prepare();
    meeting->start = meeting->particles;
    meeting->find();
    if (meeting == &stale)
      for (Eigen::Matrix3Xf& normals : meeting->state.normals) normals *= -1;
    meeting->follow();
    project_candidates(meeting->world, meeting->state, meeting->pointers<const Particles*>(meeting->start),
                       meeting->pointers<Particles*>(meeting->particles));
  }
  for (std::size_t s = 0; s < 2; ++s) EXPECT_EQ(stale.particles[s].xyzw, fresh.particles[s].xyzw);
  EXPECT_NE(fresh.particles[0].xyzw, fresh.start[0].xyzw);
}

TEST(SurfaceContact, rounds_hold_no_surface_twice) {
  Meeting meeting;
  for (int i = 0; i < 4; ++i) meeting.add(shapes::sphere({0.1 * i, 0, 0}, 0.01, 2));
  for (Index a = 0; a < 4; ++a)
    for (Index b = a; b < 4; ++b) meeting.pair(a, b, 0);
  arrange_rounds(meeting.world);
  std::size_t listed = 0;
  for (const std::vector<Index>& round : meeting.world.rounds) {
    std::vector<int> used(4, 0);
    for (Index i : round) {
      const SurfacePair& pair = meeting.world.pairs[static_cast<std::size_t>(i)];
      ++used[static_cast<std::size_t>(pair.first)];
      if (!pair.is_self()) ++used[static_cast<std::size_t>(pair.second)];
      ++listed;
    }
    for (int count : used) EXPECT_LE(count, 1);
  }
  EXPECT_EQ(listed, 10u);
}

}  // namespace gracilis
