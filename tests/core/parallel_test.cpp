#include <gracilis/core/parallel.hpp>

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

namespace gracilis {
namespace {

TEST(Parallel, what_the_first_range_throws_is_heard_however_late_it_throws) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    std::atomic<bool> failed = false;
    try {
      parallel_for_each(64, [&](std::size_t i) {
        if (i != 3 && i != 40) return;
        // 3 waits for 40, as long as another thread may come to that.
        for (int wait = 0; i == 3 && wait < 20 && !failed; ++wait)
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        failed = true;
        throw std::runtime_error(std::to_string(i));
      });
      FAIL() << "no error";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "3");
    }
  }
}

TEST(Parallel, all_ranges_before_one_that_fails_are_done) {
  std::vector<char> done(1000, 0);
  EXPECT_THROW(parallel_for_each(done.size(),
                                 [&](std::size_t i) {
                                   if (i == 700) throw std::runtime_error("here");
                                   done[i] = 1;
                                 }),
               std::runtime_error);
  for (std::size_t i = 0; i < 700; ++i) EXPECT_TRUE(done[i]) << i;
}

}  // namespace
}  // namespace gracilis
