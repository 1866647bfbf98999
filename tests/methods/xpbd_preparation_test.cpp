#include <gracilis/anatomy/fibers/muscle_fibers.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/xpbd/fiber_directions.hpp>
#include <gracilis/methods/xpbd/preparation.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

namespace gracilis {

TEST(XpbdPreparation, masses_sum_to_density_times_volume_and_attached_ones_cannot_move) {
  Scene scene = tube_scene();
  const Muscle& muscle = scene.muscles[0];
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, muscle, tube_fields());
  const Eigen::VectorXd areas = vertex_areas(muscle.surface.vertices, muscle.surface.faces);
  const Real mass = 1060 * enclosed_volume(muscle.surface.vertices, muscle.surface.faces);
  Index fixed = 0;
  for (Index p = 0; p < prepared.system.rest.count(); ++p) {
    const Real w = prepared.system.rest.inverse_mass(p);
    const Index v = prepared.order[static_cast<std::size_t>(p)];
    EXPECT_EQ(w == 0, prepared.fixed_body[static_cast<std::size_t>(p)] >= 0);
    fixed += w == 0;
    if (w > 0) {
      EXPECT_NEAR(1 / w, mass * areas[v] / areas.sum(), 1e-4 * mass / static_cast<Real>(areas.size()));
    }
  }
  EXPECT_EQ(static_cast<std::size_t>(fixed),
            muscle.attachments[0].vertices.size() + muscle.attachments[1].vertices.size());
}

TEST(XpbdPreparation, skinning_weights_sum_to_one_and_are_whole_at_attachments) {
  const Scene scene = tube_scene();
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  ASSERT_EQ(prepared.carriers, (std::vector<Index>{0, 1}));
  for (Index p = 0; p < prepared.rest.cols(); ++p) {
    EXPECT_NEAR(prepared.skinning_weights.col(p).sum(), 1, 1e-5);
    EXPECT_GE(prepared.skinning_weights.col(p).minCoeff(), -1e-5);
    const Index body = prepared.fixed_body[static_cast<std::size_t>(p)];
    if (body >= 0) {
      EXPECT_NEAR(prepared.skinning_weights(body, p), 1, 1e-6);
    }
  }
}

TEST(XpbdPreparation, fibers_run_from_origin_to_insertion) {
  const Scene scene = tube_scene();
  const Muscle& muscle = scene.muscles[0];
  const MeshTopology topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  const Points directions =
      xpbd::fiber_directions(muscle.surface.vertices, muscle.surface.faces, topology, muscle.attachments);
  Index free = 0;
  for (Index f = 0; f < directions.cols(); ++f) {
    Vec3 middle = Vec3::Zero();
    for (int k = 0; k < 3; ++k) middle += muscle.surface.vertices.col(muscle.surface.faces(k, f)) / 3;
    if (std::abs(middle.z()) > 0.065) continue;
    ++free;
    EXPECT_GT(directions.col(f).dot(-Vec3::UnitZ()), 0.99);
  }
  EXPECT_GT(free, 500);
}

TEST(XpbdPreparation, anisotropy_takes_the_nearest_fiber_where_it_is_asked_to_and_there_is_one) {
  Scene scene = tube_scene();
  scene.method.settings = {{"distance_shape_scaling", false}, {"anisotropy_floor", 0.0}};
  const auto compliances = [&] {
    const DistanceSet& set = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields()).system.distances;
    std::vector<float> found;
    for (const Index slot : set.slot) found.push_back(set.compliance[static_cast<std::size_t>(slot)]);
    return found;
  };
  const std::vector<float> harmonic = compliances();
  scene.method.settings["fiber_direction"] = "nearest_fiber";
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  const DistanceSet& set = prepared.system.distances;
  const NearestFiber fibers(fibers_of(scene.muscles[0]));
  for (const Index slot : set.slot) {
    const auto at = static_cast<std::size_t>(slot);
    const Vec3 a = prepared.rest.col(set.a[at]), b = prepared.rest.col(set.b[at]);
    const Real factor = 1 - std::abs((b - a).normalized().dot(fibers.direction((a + b) / 2)));
    const Real stiffness = prepared.settings.distance_stiffness * std::max(factor, 1e-6);
    EXPECT_NEAR(set.compliance[at] * stiffness, 1, 1e-3);
  }
  EXPECT_NE(compliances(), harmonic);
  scene.muscles[0].fibers.count = 0;
  EXPECT_EQ(compliances(), harmonic);
}

}  // namespace gracilis
