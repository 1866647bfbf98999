#include <gracilis/view/session/session.hpp>

#include "io/scene_folder.hpp"
#include "io/test_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace gracilis {

namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// What a run through 10 degrees says until it is stopped, when each frame takes some time more.
std::vector<std::string> said_by_run(const std::string& step_deg, int stopped_after,
                                     const std::function<std::chrono::milliseconds(int)>& pause) {
  const SceneFolder folder;
  SceneOptions scene;
  scene.set = {"motion.step_deg=" + step_deg};
  folder.write("boxes.toml", good_scene());
  const LoadedScene loaded = read_scene(folder.path("boxes.toml"), scene);
  SessionOptions options;
  options.out = folder.path("run");
  options.pictures = options.print_folder = false;
  std::vector<std::string> said;
  std::atomic<bool> stop{false};
  SessionListener listener;
  listener.stop = &stop;
  listener.say = [&](MessageKind, const std::string& text) { said.push_back(text); };
  listener.progress = [&](int done, int) {
    std::this_thread::sleep_for(pause(done));
    if (done == stopped_after) stop = true;
  };
  record_session(loaded, options, plan_run(loaded, options), listener);
  return said;
}

}  // namespace

TEST(SessionTime, of_a_run_before_is_told_at_once) {
  const TestFolder cache;
  setenv("XDG_CACHE_HOME", cache.path().c_str(), 1);
  const auto slow = [](int) { return std::chrono::milliseconds(250); };
  const auto first = said_by_run("2", -1, slow), second = said_by_run("2", -1, slow);
  unsetenv("XDG_CACHE_HOME");
  EXPECT_THAT(first, Not(Contains(HasSubstr("files, in about"))));
  EXPECT_THAT(second, Contains(HasSubstr("files, in about ")));
}

TEST(SessionTime, is_told_after_the_first_frame) {
  const auto said = said_by_run("0.1", 1, [](int frame) { return std::chrono::milliseconds(frame == 1 ? 600 : 0); });
  EXPECT_THAT(said, Contains(HasSubstr("by the first one: about")));
}

TEST(SessionTime, is_told_again_where_the_first_frame_was_no_good_guide) {
  const auto said = said_by_run("0.1", 10, [](int frame) { return std::chrono::milliseconds(frame == 1 ? 600 : 5); });
  EXPECT_THAT(said, Contains(HasSubstr("by the first one: about")));
  EXPECT_THAT(said, Contains(HasSubstr("by the first 10: about")));
}

TEST(SessionTime, is_not_told_of_a_short_run) {
  const auto said = said_by_run("2", 10, [](int) { return std::chrono::milliseconds(0); });
  EXPECT_THAT(said, Not(Contains(HasSubstr("frames to come"))));
}

}  // namespace gracilis
