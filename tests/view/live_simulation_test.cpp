#include <gracilis/methods/skinning/skinning_method.hpp>
#include <gracilis/view/window/live_simulation.hpp>

#include <scenes_for_tests.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <new>
#include <thread>

namespace gracilis {
namespace {

/// Follows the bones, until memory is short.
class ShortOfMemory : public DeformationMethod {
 public:
  ShortOfMemory(const Scene& scene, std::atomic<bool>& is_short)
      : skinning_(make_skinning_method(scene)), is_short_(is_short) {}
  void reset() override { skinning_->reset(); }
  StepReport advance(const Pose& pose, Real time_step) override {
    if (is_short_) throw std::bad_alloc();
    return skinning_->advance(pose, time_step);
  }
  void write(Frame& frame) const override { skinning_->write(frame); }
  void restore(const std::vector<Pose>& poses, const Frame& before, const Frame& last) override {
    skinning_->restore(poses, before, last);
  }

 private:
  std::unique_ptr<DeformationMethod> skinning_;
  std::atomic<bool>& is_short_;
};

struct LiveTube : testing::Test {
  LiveTube() : live(scene, history, [this] { return std::make_unique<ShortOfMemory>(scene, is_short); }) {}

  /// Waits for what the thread does, up to 20 s.
  void wait_for(const std::string& status) const {
    for (int i = 0; i < 4000 && live.status() != status; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_EQ(live.status(), status);
  }
  void flex(Real angle) {
    live.aim(0, angle);
    wait_for("ready");
  }
  ShownPoints shape(int frame) const { return history.at(frame)->muscles[0]; }

  Scene scene = [] {
    Scene tube = tube_scene();
    tube.method = {.name = "skinning"};
    return tube;
  }();
  std::atomic<bool> is_short = false;
  ShapeHistory history;
  LiveSimulation live;
};

TEST_F(LiveTube, goes_where_it_is_aimed_in_small_steps_each_a_frame) {
  wait_for("ready");
  ASSERT_EQ(history.end(), 1);
  flex(radians(5));
  EXPECT_EQ(history.end(), 5) << "four steps of 1.25 degrees";
  EXPECT_GT((shape(4) - shape(0)).colwise().norm().maxCoeff(), 1e-3f);
}

TEST_F(LiveTube, waits_while_it_is_paused_and_steps_once_when_asked) {
  wait_for("ready");
  live.pause(true);
  live.aim(0, radians(5));
  EXPECT_EQ(live.status(), "paused");
  live.step_once();
  for (int i = 0; i < 4000 && history.end() < 2; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(history.end(), 2);
  live.pause(false);
  wait_for("ready");
  EXPECT_EQ(history.end(), 5);
}

TEST_F(LiveTube, is_back_at_the_capture_pose_after_a_reset) {
  wait_for("ready");
  flex(radians(5));
  live.reset();
  wait_for("ready");
  EXPECT_EQ(live.aim_of(0), 0);
  EXPECT_LT((shape(history.end() - 1) - shape(0)).colwise().norm().maxCoeff(), 1e-7f);
}

TEST_F(LiveTube, says_what_stopped_it_whatever_it_was_and_goes_on_after_a_reset) {
  wait_for("ready");
  is_short = true;
  live.aim(0, radians(5));
  wait_for("stopped: out of memory");
  is_short = false;
  live.reset();
  wait_for("ready");
  flex(radians(2.5));
  EXPECT_GT((shape(history.end() - 1) - shape(0)).colwise().norm().maxCoeff(), 1e-4f);
}

}  // namespace
}  // namespace gracilis
