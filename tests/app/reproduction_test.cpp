#include "app/reproduction.hpp"

#include <gtest/gtest.h>

/// What the reproduction of moment arms leaves behind, of one method and few angles.
namespace gracilis {
namespace {

TEST(Reproduction, the_hip_in_large_steps_has_a_row_for_every_published_curve) {
  if (!Reproduction::has_data()) GTEST_SKIP() << "the published curves are not here: set GRACILIS_DATA";
  const Reproduction made("--methods skinning --thin");
  ASSERT_EQ(made.exit_code, 0);
  // Published fibers and bounds of four muscles about two coordinates; three subjects' psoas; both gluteal muscles.
  EXPECT_EQ(made.rows_of("skinning").size(), 4U * 2 * 2 + 3 + 2);
  for (const Reproduction::Row& row : made.rows_of("skinning")) {
    EXPECT_GE(row.number("angles"), 4);
    EXPECT_GT(row.number("rms_mm") + row.number("coverage_percent"), 0) << row.text("muscle") << row.text("source");
    EXPECT_LE(row.number("rms_mm"), row.number("largest_mm"));
  }
  // What the published fibers themselves cover of the band in flexion (Modenese and Kohout 2020 say 65, 82, 72, 62 %).
  const std::map<std::string, Real> published = {
      {"gluteus_maximus_r", 65}, {"gluteus_medius_r", 82}, {"iliacus_r", 72}, {"psoas_major_r", 62}};
  int found = 0;
  for (const Reproduction::Row& row : made.rows_of("Modenese 2020, same cadaver"))
    if (row.text("coordinate") == "hip_flexion_r" && !row.text("coverage_percent").empty()) {
      EXPECT_NEAR(row.number("coverage_percent"), published.at(row.text("muscle")), 3);
      ++found;
    }
  EXPECT_EQ(found, 4);
  EXPECT_NE(made.page().find("<svg"), std::string::npos);
}

}  // namespace
}  // namespace gracilis
