#include <gracilis/io/run/frame_times.hpp>

#include "io/test_files.hpp"
#include "shapes.hpp"

#include <gtest/gtest.h>

namespace gracilis {

namespace {

Scene scene_of(std::initializer_list<int> subdivisions) {
  Scene scene;
  for (const int count : subdivisions) {
    Muscle muscle;
    muscle.surface = shapes::sphere({0, 0, 0}, 0.02, count);
    scene.muscles.push_back(muscle);
  }
  return scene;
}

}  // namespace

TEST(FrameTimes, of_a_scene_grow_with_its_vertices) {
  const TestFolder folder;
  const Scene small = scene_of({2}), large = scene_of({2, 1});
  remember_frame_time(folder.path(), {"xpbd", "physical", 2}, small, 0.01);
  EXPECT_NEAR(remembered_frame_time(folder.path(), {"xpbd", "physical", 2}, small).value_or(0), 0.01, 1e-5);
  const double ratio = 1 + static_cast<double>(large.muscles[1].surface.vertex_count()) /
                               static_cast<double>(small.muscles[0].surface.vertex_count());
  EXPECT_NEAR(remembered_frame_time(folder.path(), {"xpbd", "physical", 2}, large).value_or(0), 0.01 * ratio, 1e-4);
}

// What a frame takes whatever the scene holds would be multiplied.
TEST(FrameTimes, of_a_scene_many_times_smaller_or_larger_tell_nothing) {
  const TestFolder folder;
  const Scene tiny = scene_of({0}), large = scene_of({4});
  remember_frame_time(folder.path(), {"xpbd", "physical", 2}, tiny, 0.01);
  EXPECT_FALSE(remembered_frame_time(folder.path(), {"xpbd", "physical", 2}, large));
  remember_frame_time(folder.path(), {"xpbd", "physical", 2}, large, 1);
  EXPECT_NEAR(remembered_frame_time(folder.path(), {"xpbd", "physical", 2}, tiny).value_or(0), 0.01, 1e-5);
  EXPECT_NEAR(remembered_frame_time(folder.path(), {"xpbd", "physical", 2}, large).value_or(0), 1, 1e-3);
}

TEST(FrameTimes, are_known_by_method_preset_and_threads) {
  const TestFolder folder;
  const Scene scene = scene_of({1});
  remember_frame_time(folder.path(), {"xpbd", "physical", 2}, scene, 0.01);
  EXPECT_FALSE(remembered_frame_time(folder.path(), {"pbd", "physical", 2}, scene));
  EXPECT_FALSE(remembered_frame_time(folder.path(), {"xpbd", "fast", 2}, scene));
  EXPECT_FALSE(remembered_frame_time(folder.path(), {"xpbd", "physical", 1}, scene));
}

TEST(FrameTimes, that_are_damaged_are_not_known) {
  const TestFolder folder;
  const Scene scene = scene_of({1});
  remember_frame_time(folder.path(), {"xpbd", "physical", 2}, scene, 0.01);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
    if (entry.is_regular_file()) std::ofstream(entry.path(), std::ios::app) << "0";
  EXPECT_FALSE(remembered_frame_time(folder.path(), {"xpbd", "physical", 2}, scene));
}

TEST(FrameTimes, are_kept_nowhere_without_a_folder) {
  const Scene scene = scene_of({1});
  remember_frame_time("", {"xpbd", "physical", 2}, scene, 0.01);
  EXPECT_FALSE(remembered_frame_time("", {"xpbd", "physical", 2}, scene));
}

}  // namespace gracilis
