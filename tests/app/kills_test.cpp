#include "app/killed_runs.hpp"

namespace gracilis {
namespace {

using FewKilledRuns = KilledRuns;

TEST_F(FewKilledRuns, of_boxes_end_as_if_nobody_had_killed_them) {
  expect_nothing_lost("run " + folder.write("scene.toml", good_scene()).string() + " --set fibers.count=3", 10);
}

}  // namespace
}  // namespace gracilis
