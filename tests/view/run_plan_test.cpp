#include <gracilis/view/session/run_plan.hpp>

#include "io/scene_folder.hpp"

#include <gtest/gtest.h>

namespace gracilis {

TEST(RunPlan, of_a_run_of_many_files_has_a_file_for_each_frame) {
  const SceneFolder folder;
  folder.write("boxes.toml", good_scene());
  const auto plan = [&](const std::string& step_deg, std::optional<RunLayout> layout = {}) {
    SceneOptions scene;
    scene.set = {"motion.step_deg=" + step_deg};
    SessionOptions options;
    options.layout = layout;
    return plan_run(read_scene(folder.path("boxes.toml"), scene), options);
  };
  const RunPlan few = plan("0.01"), many = plan("0.001"), asked_for = plan("0.001", RunLayout::surfaces);
  EXPECT_EQ(few.layout, RunLayout::surfaces);
  EXPECT_LT(few.size.files, 20'000);
  EXPECT_EQ(many.layout, RunLayout::compact);
  EXPECT_EQ(asked_for.layout, RunLayout::surfaces);
  EXPECT_GT(asked_for.size.files, 20'000);
  EXPECT_LT(asked_for.size.bytes, 1e9) << "it is not the bytes";
  EXPECT_LT(many.size.files, asked_for.size.files / 2);
}

}  // namespace gracilis
