#include "app/failing_allocations.hpp"

namespace gracilis {
namespace {

using SomeFailingAllocations = FailingAllocations;

TEST_F(SomeFailingAllocations, each_is_one_message_leaves_nothing_half_written_and_can_be_resumed) {
  expect_one_message_each(16384, 12);
}

TEST_F(SomeFailingAllocations, while_it_is_drawn_leave_a_run_whole) { expect_whole_runs_without_pictures(65536, 3); }

}  // namespace
}  // namespace gracilis
