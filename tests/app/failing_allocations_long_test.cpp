#include "app/failing_allocations.hpp"

namespace gracilis {
namespace {

using AllFailingAllocations = FailingAllocations;

TEST_F(AllFailingAllocations, each_is_one_message_leaves_nothing_half_written_and_can_be_resumed) {
  expect_one_message_each(1024, 1'000'000);
}

TEST_F(AllFailingAllocations, while_it_is_drawn_leave_a_run_whole) { expect_whole_runs_without_pictures(16384, 40); }

}  // namespace
}  // namespace gracilis
