#include <gracilis/simulate/simulation.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/state_hash.hpp>
#include <gracilis/core/stop.hpp>
#include <gracilis/methods/registry.hpp>
#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <atomic>

namespace gracilis {
namespace {

std::uint64_t hash_of_shapes(const Frame& frame) {
  std::uint64_t hash = hash_seed;
  for (const MuscleShape& shape : frame.muscles) hash = hash_of(shape.points, hash);
  return hash;
}

Simulation simulation_of(const Scene& scene, Simulation::Keeps keeps = Simulation::Keeps::all_steps) {
  const auto fields = [&](const DistanceFieldSettings& settings) {
    std::vector<DistanceField> built;
    for (const Bone& bone : scene.bones) built.push_back(build_bone_field(bone, settings));
    return built;
  };
  return {scene, make_method(scene, fields), keeps};
}

/// Two muscles that keep apart: contact remembers more than shapes tell.
Scene remembering_scene() {
  Scene scene = end_on_muscle_scene();
  scene.method.settings["iterations"] = 3;
  return scene;
}

TEST(Simulation, goes_on_from_a_checkpoint_to_the_same_bits) {
  const Scene scene = remembering_scene();
  ASSERT_GT(resume_period(scene), 1);
  Simulation simulation = simulation_of(scene);
  for (int frame = 1; frame <= 3 * resume_period(scene) / 2; ++frame)
    simulation.advance(flexed(scene, radians(frame)), usual_time_step);
  const Checkpoint checkpoint = simulation.checkpoint();
  const std::uint64_t there = hash_of_shapes(*simulation.frame());
  const int number = simulation.frame()->number;
  const auto go_on = [&] {
    for (int more = 1; more <= 3; ++more) simulation.advance(flexed(scene, radians(number + more)), usual_time_step);
    return hash_of_shapes(*simulation.frame());
  };
  const std::uint64_t end = go_on();
  EXPECT_NE(end, there);
  simulation.restore(checkpoint);
  EXPECT_EQ(simulation.frame()->number, number);
  EXPECT_EQ(hash_of_shapes(*simulation.frame()), there);
  EXPECT_EQ(go_on(), end);
}

TEST(Simulation, leaves_frames_alone_that_somebody_holds) {
  const Scene scene = tube_scene();
  Simulation simulation = simulation_of(scene, Simulation::Keeps::last_frame);
  const std::shared_ptr<const Frame> first = simulation.frame();
  const std::uint64_t before = hash_of_shapes(*first);
  simulation.advance(flexed(scene, radians(10)), usual_time_step);
  EXPECT_NE(simulation.frame(), first);
  EXPECT_NE(hash_of_shapes(*simulation.frame()), before);
  EXPECT_EQ(hash_of_shapes(*first), before);
  EXPECT_EQ(first->muscles[0].points, scene.muscles[0].surface.vertices);
}

TEST(Simulation, stopped_within_a_frame_goes_on_after_a_reset_only) {
  const Scene scene = tube_scene();
  Simulation simulation = simulation_of(scene);
  const std::atomic<bool> stop = true;
  {
    const StopScope scope(&stop);
    EXPECT_THROW(simulation.advance(flexed(scene, radians(10)), usual_time_step), Interrupted);
  }
  EXPECT_TRUE(simulation.is_broken());
  EXPECT_EQ(simulation.frame()->number, 0);
  simulation.reset();
  EXPECT_FALSE(simulation.is_broken());
  simulation.advance(flexed(scene, radians(10)), usual_time_step);
  EXPECT_EQ(simulation.frame()->number, 1);
}

TEST(Simulation, lets_every_muscle_contract_where_the_scene_drives_some) {
  Scene scene = end_on_muscle_scene();
  scene.activation.signals.push_back({"tube", {0}, {0.3}});
  drive_all(scene);
  ASSERT_EQ(scene.activation.signals.size(), 2u);
  EXPECT_EQ(scene.activation.signals[0].values, std::vector<Real>{0.3});
  EXPECT_EQ(scene.activation.signals[1].muscle, "rider");
  EXPECT_EQ(scene.activation.signals[1].values, std::vector<Real>{0});
}

}  // namespace
}  // namespace gracilis
