#include "view/guide_blocks.hpp"

#include <gtest/gtest.h>

/// Commands of the manual that take minutes, and those that need the cadaver's hip.
namespace gracilis {

TEST(GuideWalk, commands_that_take_long_work) {
  const TestFolder folder;
  EXPECT_GT(walk_manual(folder, [](const CommandBlock& block) { return block.says("long") && !block.says("data"); }),
            0);
}

TEST(GuideWalk, commands_on_the_cadaver_hip_work) {
  GRACILIS_NEEDS_DATA("lhdl-hip");
  setenv("GRACILIS_DATA", data_root().c_str(), 1);
  const TestFolder folder;
  EXPECT_GT(walk_manual(folder, [](const CommandBlock& block) { return block.says("data"); }), 0);
}

}  // namespace gracilis
