#include "study/snakemake_study.hpp"

namespace gracilis {

TEST(SnakemakeLong, two_hundred_runs_by_two_jobs_killed_six_times_are_complete) {
  if (!has_snakemake()) GTEST_SKIP() << "skipped: no snakemake";
  expect_snakemake_completes(200, 20, 6);
}

}  // namespace gracilis
