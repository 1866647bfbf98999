#include <gracilis/anatomy/fibers/fiber_containment.hpp>
#include <gracilis/anatomy/fibers/muscle_fibers.hpp>
#include <gracilis/io/scene/demo_scene.hpp>

#include "scenarios/scenario_runs.hpp"

#include <gtest/gtest.h>

namespace gracilis {
namespace {

/// Every fiber starts in the origin, ends in the insertion and stays inside.
void expect_fibers_in_place(const Muscle& muscle, const Polylines& fibers) {
  ASSERT_EQ(fibers.count(), muscle.fibers.count) << muscle.name;
  const Containment inside = containment(SignedDistance(muscle.surface), fibers);
  EXPECT_LE(inside.outside, 0.01 * inside.points) << muscle.name;
  EXPECT_LE(inside.farthest, 5e-4) << muscle.name;
  const NearestTriangle nearest(muscle.surface);
  for (const AttachmentEnd end : {AttachmentEnd::origin, AttachmentEnd::insertion}) {
    std::vector<char> held(static_cast<std::size_t>(muscle.surface.vertex_count()), 0);
    for (const Attachment& attachment : muscle.attachments)
      if (attachment.end == end)
        for (const Index v : attachment.vertices) held[static_cast<std::size_t>(v)] = 1;
    for (Index i = 0; i < fibers.count(); ++i) {
      const NearestPoint at =
          nearest.query(fibers.points.col(end == AttachmentEnd::origin ? fibers.begin(i) : fibers.end(i) - 1));
      EXPECT_LT(at.distance, 1e-4) << muscle.name << ", fiber " << i;
      bool attached = false;
      for (int k = 0; k < 3; ++k) attached |= held[static_cast<std::size_t>(muscle.surface.faces(k, at.face))] != 0;
      EXPECT_TRUE(attached) << muscle.name << ", fiber " << i;
    }
  }
}

void expect_independence_of_sampling(Muscle muscle) {
  const Real usual = mean_fiber_length(fibers_of(muscle));
  muscle.fibers.count *= 2;
  EXPECT_NEAR(mean_fiber_length(fibers_of(muscle)) / usual, 1, 0.01) << muscle.name << ", twice the fibers";
  muscle.fibers.count /= 2;
  muscle.fibers.segments *= 2;
  EXPECT_NEAR(mean_fiber_length(fibers_of(muscle)) / usual, 1, 0.01) << muscle.name << ", twice the segments";
}

}  // namespace

TEST(Fibers, of_the_cadaver_hip_run_from_origin_to_insertion_inside_their_muscles) {
  SKIP_WITHOUT_DATA();
  const Scene scene = cadaver_scene("flexion");
  ASSERT_EQ(scene.muscles.size(), 5u);
  for (const Muscle& muscle : scene.muscles) expect_fibers_in_place(muscle, fibers_of(muscle));
}

TEST(Fibers, of_the_cadaver_hip_keep_their_mean_length_when_count_or_resolution_double) {
  SKIP_WITHOUT_DATA();
  for (const Muscle& muscle : cadaver_scene("flexion").muscles) expect_independence_of_sampling(muscle);
}

TEST(Fibers, of_the_builtin_hip_run_from_origin_to_insertion_inside_their_muscles) {
  for (const Muscle& muscle : demo_scene("hip").muscles) {
    expect_fibers_in_place(muscle, fibers_of(muscle));
    expect_independence_of_sampling(muscle);
  }
}

}  // namespace gracilis
