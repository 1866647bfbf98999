#include <gracilis/core/parallel.hpp>
#include <gracilis/core/stop.hpp>

#include <gtest/gtest.h>

#include <atomic>

namespace gracilis {

TEST(Stop, without_a_scope_nothing_stops) {
  EXPECT_NO_THROW(throw_if_stopped());
  EXPECT_EQ(stop_flag(), nullptr);
}

TEST(Stop, work_in_a_scope_is_interrupted_once_its_flag_is_set) {
  std::atomic<bool> flag = false;
  const StopScope scope(&flag);
  EXPECT_NO_THROW(throw_if_stopped());
  flag = true;
  EXPECT_THROW(throw_if_stopped(), Interrupted);
  EXPECT_THROW(parallel_for(1, 1, [](Index, Index) { FAIL() << "does not begin"; }), Interrupted);
}

TEST(Stop, the_innermost_scope_counts_and_ends_with_its_block) {
  std::atomic<bool> flag = true;
  const StopScope scope(&flag);
  {
    const StopScope sheltered(nullptr);
    EXPECT_NO_THROW(throw_if_stopped());
  }
  EXPECT_THROW(throw_if_stopped(), Interrupted);
}

TEST(Stop, tasks_of_tasks_stop_on_whichever_thread_they_run) {
  std::atomic<bool> flag = false;
  std::atomic<int> begun = 0;
  const StopScope scope(&flag);
  const auto work = [&] {
    parallel_for_each(1000, [&](std::size_t) {
      parallel_for_each(1000, [&](std::size_t) {
        if (++begun == 5000) flag = true;
      });
    });
  };
  EXPECT_THROW(work(), Interrupted);
  EXPECT_LT(begun, 6000) << "each thread finishes what it has begun and no more";
}

TEST(Stop, the_error_leads_to_the_documented_exit_code) { EXPECT_EQ(static_cast<int>(Interrupted().code()), 130); }

}  // namespace gracilis
