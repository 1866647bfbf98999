#include "study/snakemake_study.hpp"

namespace gracilis {

TEST(Snakemake, a_study_by_two_jobs_that_is_killed_and_started_again_is_complete) {
  if (!has_snakemake()) GTEST_SKIP() << "skipped: no snakemake";
  expect_snakemake_completes(6, 3, 1);
}

}  // namespace gracilis
