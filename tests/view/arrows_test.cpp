#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/view/pictures/run_picture.hpp>

#include "view/recorded_runs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>

using namespace gracilis;

namespace {

/// A run in which a muscle pulls at its origin on the pelvis and, up to 320 N in frame 5, at its insertion.
RecordedRun pulling_run(const std::filesystem::path& folder) {
  FlexingLeg leg(6);
  leg.knows_forces = true;
  leg.scene.muscles[0].attachments = {{"o", AttachmentEnd::origin, 0, {0, 1, 2}},
                                      {"i", AttachmentEnd::insertion, 1, {10, 11}}};
  leg.pull = true;
  return leg.written(folder);
}

TEST(Arrows, are_as_long_as_forces_are_large_and_the_legend_tells_their_scale) {
  const TestFolder folder;
  const std::vector<RecordedRun> runs = {pulling_run(folder.path() / "run")};
  RunPictureOptions options;
  options.arrow_scale = force_arrow_scale(runs);
  EXPECT_NEAR(options.arrow_scale, 1e-4, 1e-12);  // 320 N are 32 mm; at 2e-4 they would be 64
  const RunPainter painter(runs[0], options);
  const Panel panel = painter.panel(5);
  // A bone, a muscle with its two arrows, and one without forces.
  ASSERT_EQ(panel.surfaces.size(), 5u);
  const PaintedSurface& origin = panel.surfaces[2];
  const PaintedSurface& insertion = panel.surfaces[3];
  EXPECT_EQ(origin.name, "force on origins, 1 cm for 100 N");
  EXPECT_EQ(insertion.name, "force on insertions, 1 cm for 100 N");
  const Points& muscle = panel.surfaces[1].mesh.vertices;
  const Vec3 root = (muscle.col(0) + muscle.col(1) + muscle.col(2)) / 3;
  // The last two vertices close its ends.
  const Points& arrow = origin.mesh.vertices;
  EXPECT_TRUE(Vec3(arrow.col(arrow.cols() - 2)).isApprox(root, 1e-5));
  EXPECT_TRUE(Vec3(arrow.col(arrow.cols() - 1) - arrow.col(arrow.cols() - 2)).isApprox(Vec3(0, -0.032, 0), 1e-5));
  EXPECT_GT(enclosed_volume(origin.mesh.vertices, origin.mesh.faces), 0);
  EXPECT_LE(panel.surfaces[1].opacity, 0.3);
  // A sixteenth of that in frame 1.
  const Points& weak = painter.panel(1).surfaces[2].mesh.vertices;
  EXPECT_NEAR((weak.col(weak.cols() - 1) - weak.col(weak.cols() - 2)).norm(), 0.002, 1e-6);
}

TEST(Arrows, tell_what_each_kind_of_constraint_moved_and_how_much_longer_they_are_than_that) {
  const TestFolder folder;
  FlexingLeg leg(6);
  leg.corrects = true;
  const RecordedRun run = leg.written(folder.path() / "run");
  RunPictureOptions options;
  options.focus = "gluteus_maximus_r";
  const Real extent = RunPainter(run, options).extent();
  EXPECT_NEAR(extent, 0.08 * std::sqrt(3), 0.001);  // the diagonal of a sphere's box
  options.corrections = correction_arrow_size(run, run.muscles, {5}, extent);
  // 1 mm ten times as long is 10 mm; twenty times would be more than a twelfth of the extent, 11.5 mm.
  EXPECT_EQ(options.corrections.times, 10);
  const Panel panel = RunPainter(run, options).panel(5);
  ASSERT_EQ(panel.surfaces.size(), 5u);  // a bone, a muscle with two kinds, and one that nothing moved
  EXPECT_EQ(panel.surfaces[2].name, "moved by distance (×10)");
  const PaintedSurface& bones = panel.surfaces[3];
  EXPECT_EQ(bones.name, "moved by bone contact (×10)");
  EXPECT_NE(bones.color, panel.surfaces[2].color);
  const Points& muscle = panel.surfaces[1].mesh.vertices;
  // Up from the muscle's lowest vertex to 10 mm above its highest.
  EXPECT_NEAR(bones.mesh.vertices.row(1).maxCoeff(), muscle.row(1).maxCoeff() + 0.01, 1e-3);
  EXPECT_NEAR(bones.mesh.vertices.row(1).minCoeff(), muscle.row(1).minCoeff(), 1e-3);
  EXPECT_TRUE(RunPainter(run, options).panel(0).surfaces.size() == 3) << "nothing has moved yet";
}

TEST(Arrows, of_a_run_without_forces_are_refused) {
  const TestFolder folder;
  const auto refused = [&](const RecordedRun& run, const char* why) {
    try {
      force_arrow_scale({run});
      ADD_FAILURE() << why;
    } catch (const ConfigurationError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(why));
    }
  };
  FlexingLeg leg(2);
  refused(leg.written(folder.path() / "without"), "the run knows no forces");
  leg.knows_forces = true;
  refused(leg.written(folder.path() / "no_ends"), "holds no force at a muscle's attachment");
}

}  // namespace
