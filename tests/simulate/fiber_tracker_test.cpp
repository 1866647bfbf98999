#include <gracilis/simulate/fiber_tracker.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/cross_section.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/simulate/run.hpp>

#include "scenes_for_tests.hpp"

#include <gtest/gtest.h>

namespace gracilis {
namespace {

Frame rest_frame(const Scene& scene) { return capture_frame(scene, flexed(scene, 0)); }

}  // namespace

TEST(FiberTracker, says_at_rest_what_the_fibers_are) {
  const Scene scene = tube_scene();
  const FiberTracker tracker(scene);
  const MuscleFibers fibers = tracker.follow(rest_frame(scene))[0];
  EXPECT_EQ(fibers.lengths.size(), 100u);
  EXPECT_NEAR(fibers.mean_strain, 0, 1e-9);
  const Real volume = enclosed_volume(scene.muscles[0].surface.vertices, scene.muscles[0].surface.faces);
  EXPECT_NEAR(fibers.physiological_cross_section * fibers.mean_length, volume, 1e-12);
  EXPECT_NEAR(fibers.cross_section, 20 * 0.01 * 0.01 / 2 * std::sin(2 * pi / 20), 2e-6) << "a regular polygon";
}

TEST(FiberTracker, follows_a_stretched_muscle) {
  const Scene scene = tube_scene();
  const FiberTracker tracker(scene);
  Frame frame = rest_frame(scene);
  frame.muscles[0].points.row(2) *= 1.21;  // as long again as 21 %, at constant volume
  frame.muscles[0].points.topRows(2) /= 1.1;
  const MuscleFibers rest = tracker.follow(rest_frame(scene))[0], now = tracker.follow(frame)[0];
  EXPECT_NEAR(now.mean_strain, 0.21, 0.02);
  EXPECT_NEAR(now.cross_section / rest.cross_section, 1 / 1.21, 1e-3);
  EXPECT_NEAR(now.physiological_cross_section / rest.physiological_cross_section, 1 / 1.21, 0.02);
}

TEST(FiberTracker, has_the_same_bits_for_any_number_of_threads_and_nothing_for_muscles_without_fibers) {
  Scene scene = tube_scene();
  const FiberTracker tracker(scene);
  const MuscleFibers several = tracker.follow(rest_frame(scene))[0];
  const ThreadLimit one(1);
  EXPECT_TRUE(FiberTracker(scene).follow(rest_frame(scene))[0].lines.points == several.lines.points);
  scene.muscles[0].fibers.count = 0;
  EXPECT_TRUE(FiberTracker(scene).follow(rest_frame(scene))[0].lengths.empty());
}

TEST(FiberTracker, follows_the_fibers_of_a_method_that_knows_them) {
  Scene scene = tube_scene();
  Frame frame = rest_frame(scene);
  Points line(3, 3);
  line << 0, 0, 0, 0, 0, 0, 0.07, 0, -0.07;
  frame.muscles[0].fibers.append(line);
  const FiberTracker tracker(scene, &frame);
  EXPECT_EQ(tracker.rest(0).points, line);
  EXPECT_NEAR(tracker.follow(frame)[0].mean_length, 0.14, 1e-12);
  frame.muscles[0].fibers.points *= 1.5;
  const MuscleFibers fibers = tracker.follow(frame)[0];
  EXPECT_EQ(fibers.lines.points, 1.5 * line);
  EXPECT_NEAR(fibers.mean_length, 0.21, 1e-12);
  EXPECT_NEAR(fibers.mean_strain, 0.5, 1e-12) << "the surface stays";
  EXPECT_GT(fibers.cross_section, 2e-4);
  scene.muscles[0].fibers.count = 0;
  EXPECT_TRUE(FiberTracker(scene, &frame).follow(frame)[0].lengths.empty()) << "none are wanted";
}

TEST(CrossSection, counts_the_piece_around_the_point_only) {
  // A plane through both ends of a bent tube.
  TriangleMesh bent = shapes::cylinder(0.01, 0.3, 40, 100);
  for (Index v = 0; v < bent.vertex_count(); ++v) {
    const Vec3 p = bent.vertices.col(v);
    const Real angle = p.z() / 0.1;
    bent.vertices.col(v) = Vec3((0.1 + p.x()) * std::cos(angle), p.y(), (0.1 + p.x()) * std::sin(angle));
  }
  const MeshTopology topology = build_topology(bent.faces, bent.vertex_count());
  const Real area = cross_section_area(bent, topology, Vec3(0.1, 0, 0.001), Vec3::UnitZ());
  EXPECT_NEAR(area, pi * 1e-4, 5e-6);
  EXPECT_EQ(cross_section_area(bent, topology, Vec3(0, 0, 1), Vec3::UnitZ()), 0) << "beyond it";
}

}  // namespace gracilis
