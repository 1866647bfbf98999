#include "study/study_scenes.hpp"

#include <gracilis/study/child_process.hpp>
#include <gracilis/study/run_claim.hpp>

#include <gtest/gtest.h>

#include <chrono>

namespace gracilis {

namespace {

namespace fs = std::filesystem;

/// A claim that a process of another machine renewed so long ago.
fs::path claimed_elsewhere(const StudyFolder& folder, int seconds_ago) {
  const fs::path lock = folder.write("0001/run.lock", "node7 4711 99\n");
  fs::last_write_time(lock, fs::file_time_type::clock::now() - std::chrono::seconds(seconds_ago));
  return folder.path("0001");
}

}  // namespace

TEST(RunClaim, one_at_a_time_and_nothing_stays) {
  const StudyFolder folder;
  {
    const std::optional<RunClaim> claim = RunClaim::take(folder.path("0001"));
    ASSERT_TRUE(claim);
    EXPECT_FALSE(RunClaim::take(folder.path("0001")));
    EXPECT_NE(who_claims(folder.path("0001")), "");
    EXPECT_TRUE(RunClaim::take(folder.path("0002")));
  }
  EXPECT_FALSE(fs::exists(folder.path("0001")));
  EXPECT_TRUE(RunClaim::take(folder.path("0001")));
}

TEST(RunClaim, that_of_another_machine_is_respected_while_it_is_renewed) {
  const StudyFolder folder;
  const fs::path claimed = claimed_elsewhere(folder, RunClaim::abandoned_after / 2);
  EXPECT_FALSE(RunClaim::take(claimed));
  EXPECT_EQ(read_text(claimed / "run.lock"), "node7 4711 99\n");
}

TEST(RunClaim, that_of_a_machine_that_died_is_taken_over_with_what_it_left) {
  const StudyFolder folder;
  const fs::path claimed = claimed_elsewhere(folder, RunClaim::abandoned_after + 60);
  folder.write("0001/run/run.lock", "node7 4712 99\n");
  folder.write("0001/run/run.json", "{}");
  {
    const std::optional<RunClaim> claim = RunClaim::take(claimed);
    ASSERT_TRUE(claim);
    EXPECT_FALSE(RunClaim::take(claimed)) << "it is ours now";
    EXPECT_TRUE(fs::exists(claimed / "run/run.json"));
    EXPECT_FALSE(fs::exists(claimed / "run/run.lock"));
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(claimed), fs::directory_iterator()), 1) << "the run alone";
}

TEST(RunClaim, renewing_makes_it_young) {
  const StudyFolder folder;
  const std::optional<RunClaim> claim = RunClaim::take(folder.path("0001"));
  const fs::path lock = folder.path("0001") / "run.lock";
  fs::last_write_time(lock, fs::file_time_type::clock::now() - std::chrono::hours(1));
  claim->renew();
  EXPECT_LT(fs::file_time_type::clock::now() - fs::last_write_time(lock), std::chrono::minutes(1));
}

TEST(ChildProcess, tells_what_became_of_it) {
  ChildOptions silent;
  silent.log = "/dev/null";
  EXPECT_EQ(run_in_child([] { return 7; }, {}).code, 7);
  const ChildOutcome refused = run_in_child(
      []() -> int {
        throw ConfigurationError({"file", "", "is wrong", ""});
      },
      silent);
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.reason, "file: is wrong");
  const ChildOutcome crashed = run_in_child(
      []() -> int {
        std::raise(SIGKILL);
        return 0;
      },
      {});
  EXPECT_EQ(crashed.code, 1);
  EXPECT_NE(crashed.reason.find("signal 9"), std::string::npos);
  EXPECT_NE(crashed.reason.find("memory"), std::string::npos);
}

}  // namespace gracilis
