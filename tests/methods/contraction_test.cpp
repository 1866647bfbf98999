#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/methods/xpbd/contraction.hpp>
#include <gracilis/simulate/fiber_tracker.hpp>
#include <gracilis/simulate/run.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

Scene active_tube(Real activation, const ContractionSettings& settings = {}, int fibers = 100) {
  Scene scene = tube_scene();
  scene.muscles[0].contraction = settings;
  scene.muscles[0].fibers.count = fibers;
  scene.activation.signals = {{"tube", {0}, {activation}}};
  return scene;
}

/// The tube after flexion to `degrees`, a degree per frame, with the activation that its scene's signal says.
Frame flexed_frame(const Scene& scene, int degrees) {
  const auto method = xpbd_on_tube(scene);
  Pose pose;
  for (int degree = 1; degree <= degrees; ++degree) {
    pose = flexed(scene, radians(degree));
    pose.activations = scene.activation.signals.empty() ? std::vector<Real>{}
                                                        : std::vector<Real>{scene.activation.signals[0].values[0]};
    method->advance(pose, usual_time_step);
  }
  return frame_of(*method, pose, degrees);
}

Real volume_of(const Scene& scene, const Frame& frame) {
  return enclosed_volume(frame.muscles[0].points, scene.muscles[0].surface.faces);
}

}  // namespace

TEST(Contraction, up_to_the_threshold_nothing_pulls) {
  const Frame relaxed = flexed_frame(tube_scene(), 20);
  EXPECT_EQ(farthest(relaxed, flexed_frame(active_tube(0.02), 20)), 0);
  EXPECT_GT(farthest(relaxed, flexed_frame(active_tube(0.03), 20)), 0);
}

TEST(Contraction, strength_grows_from_nothing_at_the_threshold_to_all_at_the_shortest) {
  const ContractionSettings settings;
  EXPECT_EQ(xpbd::contraction_strength(settings, 0), 0);
  EXPECT_EQ(xpbd::contraction_strength(settings, 0.02), 0);
  EXPECT_NEAR(xpbd::contraction_strength(settings, 0.15), 0.5, 1e-12);
  EXPECT_EQ(xpbd::contraction_strength(settings, 0.3), 1);
  EXPECT_EQ(xpbd::contraction_strength(settings, 1), 1);
  EXPECT_EQ(contracted_share(settings, 0.2), 0.8);
  EXPECT_EQ(contracted_share(settings, 0.9), 0.7);
}

TEST(Contraction, without_ramp_is_at_its_full_strength_above_the_threshold_and_without_that_always) {
  ContractionSettings settings;
  settings.ramp = false;
  EXPECT_EQ(xpbd::contraction_strength(settings, 0.02), 0);
  EXPECT_EQ(xpbd::contraction_strength(settings, 0.03), 1);
  settings.threshold = 0;
  EXPECT_EQ(xpbd::contraction_strength(settings, 0), 1);
  settings.ramp = true;
  EXPECT_EQ(xpbd::contraction_strength(settings, 0), 0);
}

TEST(Contraction, an_active_muscle_has_shorter_fibers_and_its_volume) {
  const Scene relaxed = tube_scene(), active = active_tube(0.3);
  const Frame slack = flexed_frame(relaxed, 60), taut = flexed_frame(active, 60);
  const FiberTracker tracker(relaxed);
  EXPECT_LT(tracker.follow(taut)[0].mean_length, tracker.follow(slack)[0].mean_length - 0.001);
  const Real rest = volume_of(relaxed, capture_frame(relaxed, flexed(relaxed, 0)));
  EXPECT_NEAR(volume_of(relaxed, slack) / rest, 1, 0.005);
  EXPECT_NEAR(volume_of(active, taut) / rest, 1, 0.005);
}

TEST(Contraction, sixteen_fibers_give_nearly_the_shape_that_a_hundred_give) {
  // A relaxed muscle that a blend of bodies carries is slack, so that contraction has the more to move.
  const auto blended = [](Scene scene) {
    scene.method.settings["skinning"] = "bodies";
    return flexed_frame(scene, 20);
  };
  const Frame relaxed = blended(tube_scene()), many = blended(active_tube(0.3)),
              few = blended(active_tube(0.3, {}, 16));
  const auto distance = [](const Frame& one, const Frame& other) {
    return std::sqrt((one.muscles[0].points - other.muscles[0].points).colwise().squaredNorm().mean());
  };
  EXPECT_GT(distance(relaxed, many), 0.002) << "it never contracted";
  EXPECT_LT(distance(few, many), 0.4 * distance(relaxed, many));
}

TEST(Contraction, along_segments_of_surface_fibers_pulls_too) {
  ContractionSettings settings;
  settings.spread = false;
  const Scene scene = tube_scene();
  const Frame relaxed = flexed_frame(scene, 60);
  const FiberTracker tracker(scene);
  for (const SurfacePaths paths : {SurfacePaths::along_fibers, SurfacePaths::nearest_joined}) {
    settings.paths = paths;
    const Frame taut = flexed_frame(active_tube(0.3, settings), 60);
    EXPECT_LT(tracker.follow(taut)[0].mean_length, tracker.follow(relaxed)[0].mean_length - 0.001);
  }
}

TEST(Contraction, has_the_same_tension_for_any_number_of_fibers) {
  // What crosses the middle of the tube pulls along it with stiffness times length, N per relative excess length.
  const auto tension = [](bool spread, int fibers) {
    ContractionSettings settings;
    settings.spread = spread;
    const Scene scene = active_tube(1, settings, fibers);
    const xpbd::PreparedMuscle muscle = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
    const DistanceSet& set = muscle.system.tensions;
    Real sum = 0;
    for (const Index slot : set.slot) {
      const auto at = static_cast<std::size_t>(slot);
      const Real za = muscle.rest(2, set.a[at]) - 0.001, zb = muscle.rest(2, set.b[at]) - 0.001;
      if (za * zb < 0) sum += static_cast<Real>(muscle.along_fibers[at] * set.rest_length[at] / set.compliance[at]);
    }
    return sum;
  };
  const Real around = 2 * pi * 0.01 * ContractionSettings{}.stiffness;
  for (const int fibers : {16, 40, 100}) EXPECT_NEAR(tension(false, fibers) / around, 1, 0.15) << fibers << " fibers";
  for (const int fibers : {16, 40}) EXPECT_NEAR(tension(true, fibers) / tension(true, 100), 1, 0.02) << fibers;
}

TEST(Contraction, follows_lines_drawn_by_hand) {
  Scene scene = active_tube(1);
  scene.muscles[0].contraction.spread = false;
  Points line(3, 2);
  line << 0.0355, 0.0355, 0, 0, 0.075, -0.075;
  scene.muscles[0].given_surface_fibers = join({line});
  const xpbd::PreparedMuscle muscle = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  const DistanceSet& set = muscle.system.tensions;
  ASSERT_GT(set.count, 10);
  for (const Index slot : set.slot)
    for (const Index p : {set.a[static_cast<std::size_t>(slot)], set.b[static_cast<std::size_t>(slot)]})
      EXPECT_LT((muscle.rest.col(p).head(2) - line.col(0).head(2)).norm(), 0.004);
}

TEST(Contraction, without_area_scaling_acts_once_for_every_fiber_with_the_stiffness_itself) {
  Scene scene = active_tube(1);
  scene.muscles[0].contraction.spread = false;
  scene.muscles[0].contraction.area_scaling = false;
  Points line(3, 2), half(3, 2);
  line << 0.0355, 0.0355, 0, 0, 0.075, -0.075;
  half << 0.0355, 0.0355, 0, 0, 0.075, 0;
  const auto tensions = [&](const std::vector<Points>& lines) {
    scene.muscles[0].given_surface_fibers = join(lines);
    return xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields()).system.tensions;
  };
  const Index whole = tensions({line}).count, upper = tensions({half}).count;
  ASSERT_GT(upper, 5);
  const DistanceSet all = tensions({line, line, half});
  EXPECT_EQ(all.count, 2 * whole + upper);
  // In a tendon less: the tube is all tendon and border but for its middle.
  scene.method.settings["tendon_length"] = 0.0;
  const DistanceSet full = tensions({line, line, half});
  for (const Index slot : full.slot)
    EXPECT_NEAR(full.compliance[static_cast<std::size_t>(slot)], 1 / scene.muscles[0].contraction.stiffness, 1e-8);
}

TEST(Contraction, as_published_stiffens_a_relaxed_muscle_and_shortens_an_active_one_more) {
  const Preset thesis = *find_preset("thesis-2024");
  const auto published = [&](Scene scene) {
    scene.method = thesis.method;
    scene.muscles[0].contraction = thesis.contraction;
    return scene;
  };
  const Scene passive = published(tube_scene());
  // The tube runs taut over the bone, so that its fibers can only press it there.
  const Frame undriven = flexed_frame(passive, 60), relaxed = flexed_frame(published(active_tube(0)), 60),
              active = flexed_frame(published(active_tube(0.3)), 60);
  const FiberTracker tracker(passive);
  const auto length = [&](const Frame& frame) { return tracker.follow(frame)[0].mean_length; };
  EXPECT_LT(length(relaxed), length(undriven) - 0.002) << "edges that contract by nothing still hold";
  EXPECT_LT(length(active), length(relaxed) - 0.0004);
  const Real rest = volume_of(passive, capture_frame(passive, flexed(passive, 0)));
  // After the last iteration bones push and nothing settles.
  for (const Frame& frame : {undriven, relaxed, active}) EXPECT_NEAR(volume_of(passive, frame) / rest, 1, 0.02);
}

TEST(Contraction, of_a_muscle_that_no_plan_drives_is_an_error_and_no_silence) {
  const Scene scene = tube_scene();
  const auto method = xpbd_on_tube(scene);
  Pose pose = flexed(scene, radians(1));
  pose.activations = {0.5};
  EXPECT_THROW(method->advance(pose, usual_time_step), ConfigurationError);
}

TEST(Contraction, a_muscle_without_fibers_stays_relaxed) {
  EXPECT_EQ(farthest(flexed_frame(tube_scene(), 10), flexed_frame(active_tube(1, {}, 0), 10)), 0);
}

}  // namespace gracilis
