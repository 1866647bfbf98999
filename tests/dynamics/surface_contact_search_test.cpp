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
  const PairTouches& touches = meeting.state.touches[0];
  const std::size_t found = touches.near_second.size();
  EXPECT_GT(found, 10u);
  meeting.move(1, {-0.0023f, 0, 0});
  meeting.find();
  EXPECT_EQ(touches.near_second.size(), found);
  meeting.move(1, {-0.0002f, 0, 0});
  meeting.find();
  EXPECT_GT(touches.near_second.size(), found) << "what came near is found";
  EXPECT_EQ(touches.drift, 0);
}

TEST(SurfaceContact, drifts_there_and_back_add_up) {
  Meeting meeting = pressed_balls(-0.001);
  meeting.prepare();
  meeting.find();
  for (const float way : {0.0013f, -0.0013f}) {
    meeting.move(1, {0, way, 0});
    meeting.follow();
  }
  EXPECT_NEAR(meeting.state.touches[0].drift, 0.0026, 1e-6);
  meeting.find();
  EXPECT_EQ(meeting.state.touches[0].drift, 0) << "it was searched again";
}

TEST(SurfaceContact, every_update_period_th_frame_searches_everything) {
  Meeting meeting = pressed_balls(-0.001);
  meeting.crowd.settings.update_period = 2;
  meeting.prepare();
  const auto found = [&] {
    begin_touch_frame(meeting.crowd, meeting.state);
    meeting.find();
    return meeting.state.touches[0].near_second.size();
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
  const std::vector<PointTouch>& listed = meeting.state.touches[0].on_second;
  const auto nearest = [&] {
    float least = 1;
    for (const PointTouch& touch : listed) least = std::min(least, touch.distance);
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

TEST(SurfaceContact, rounds_hold_no_surface_twice) {
  Meeting meeting;
  for (int i = 0; i < 4; ++i) meeting.add(shapes::sphere({0.1 * i, 0, 0}, 0.01, 2));
  for (Index a = 0; a < 4; ++a)
    for (Index b = a; b < 4; ++b) meeting.pair(a, b, 0);
  arrange_rounds(meeting.crowd);
  std::size_t listed = 0;
  for (const std::vector<Index>& round : meeting.crowd.rounds) {
    std::vector<int> used(4, 0);
    for (Index i : round) {
      const SurfacePair& pair = meeting.crowd.pairs[static_cast<std::size_t>(i)];
      ++used[static_cast<std::size_t>(pair.first)];
      if (!pair.is_self()) ++used[static_cast<std::size_t>(pair.second)];
      ++listed;
    }
    for (int count : used) EXPECT_LE(count, 1);
  }
  EXPECT_EQ(listed, 10u);
}

}  // namespace gracilis
