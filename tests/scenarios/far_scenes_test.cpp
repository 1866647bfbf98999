#include <gracilis/anatomy/overlap/bone_field.hpp>
#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/anatomy/sections/cylinder_surface.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/section_frames.hpp>
#include <gracilis/io/scene/demo_scene.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/simulate/run.hpp>

#include <moved_scenes.hpp>
#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

/// Where a scene stands in its frame says nothing about its muscles: kilometres away they deform as at the origin.
namespace gracilis {
namespace {

const Vec3 kilometres_away(5000.3, -3000.7, 8000.1);

std::unique_ptr<DeformationMethod> method_made_for(const Scene& scene) {
  return make_method(scene, [&](const DistanceFieldSettings& settings) {
    std::vector<DistanceField> fields(scene.bones.size());
    parallel_for_each(fields.size(), [&](std::size_t b) { fields[b] = build_bone_field(scene.bones[b], settings); });
    return fields;
  });
}

std::vector<FrameRecord> run(const Scene& scene) {
  const auto method = method_made_for(scene);
  const FiberTracker tracker(scene);
  std::vector<FrameRecord> records;
  run_scene(
      scene, pose_sequence(scene), *method, nullptr, false,
      [&](const FrameRecord& record) { records.push_back(record); }, &tracker);
  return records;
}

Scene flexing(Scene scene, Real last, Real step) {
  scene.motion.name = "flexion";
  scene.motion.coordinates = {scene.joints[0].axes[0].coordinate};
  const auto rows = static_cast<Index>(std::round(last / step)) + 1;
  scene.motion.values = Eigen::VectorXd::LinSpaced(rows, 0, last);
  for (Index i = 0; i < rows; ++i) scene.motion.times.push_back(i / 60.0);
  return scene;
}

Real largest_difference(const Points& one, const Points& other) {
  return one.cols() == 0 ? 0 : (one - other).colwise().norm().maxCoeff();
}

/// How far frames of a scene are from those of the same scene elsewhere.
struct Difference {
  Real shape = 0, mean = 0, fibers = 0, lengths = 0, volume = 0, depth = 0, belly = 0, ways = 0;
  bool same_gates = true;
};

Difference difference(const std::vector<FrameRecord>& here, const std::vector<FrameRecord>& there,
                      const RigidTransform& by) {
  Difference d;
  const auto keep = [](Real value, Real& largest) { largest = std::max(largest, std::abs(value)); };
  for (std::size_t f = 0; f < here.size(); ++f)
    for (std::size_t m = 0; m < here[f].measures.size(); ++m) {
      const MuscleMeasures &a = here[f].measures[m], &b = there[f].measures[m];
      const Points apart = moved(by, here[f].frame.muscles[m].points) - there[f].frame.muscles[m].points;
      keep(apart.colwise().norm().maxCoeff(), d.shape);
      keep(apart.colwise().norm().mean(), d.mean);
      const MuscleFibers &near = here[f].fibers[m], &away = there[f].fibers[m];
      keep(largest_difference(moved(by, near.lines.points), away.lines.points), d.fibers);
      keep(near.mean_length - away.mean_length, d.lengths);
      keep(a.volume_ratio - b.volume_ratio, d.volume);
      keep(a.vertex_depth_beyond_rest - b.vertex_depth_beyond_rest, d.depth);
      keep(a.midpoint_depth_beyond_rest - b.midpoint_depth_beyond_rest, d.depth);
      keep(a.belly_off_place - b.belly_off_place, d.belly);
      keep(a.slack - b.slack, d.ways);
      keep(a.wrong_side - b.wrong_side, d.ways);
      d.same_gates &= missed_gates(a, {}).size() == missed_gates(b, {}).size();
    }
  return d;
}

/// 1e-5 m is what the solver's single precision leaves of a run at the origin, and less than anything that is measured.
void expect_same(const Scene& scene,
                 const RigidTransform& by = Eigen::Translation3d(kilometres_away) * RigidTransform::Identity()) {
  const std::vector<FrameRecord> here = run(scene), there = run(moved(by, scene));
  ASSERT_EQ(here.size(), there.size());
  ASSERT_GT(largest_difference(here.back().frame.muscles[0].points, here[0].frame.muscles[0].points), 0.003)
      << "nothing moved";
  const Difference d = difference(here, there, by);
  EXPECT_LT(d.shape, 1e-5);
  EXPECT_LT(d.fibers, 1e-5);
  EXPECT_LT(d.lengths, 1e-5);
  EXPECT_LT(d.volume, 1e-5);
  EXPECT_LT(d.depth, 1e-5);
  EXPECT_LT(d.belly, 1e-4);
  EXPECT_LT(d.ways, 1e-3);
  EXPECT_TRUE(d.same_gates);
}

/// A muscle wider than thick and not quite even: of a round and even one rounding decides which way is which.
Scene flexing_tube(const XpbdSettings& settings = {}) {
  Scene scene = flexing(tube_scene(settings), radians(24), radians(2));
  Points& vertices = scene.muscles[0].surface.vertices;
  for (Index v = 0; v < vertices.cols(); ++v) {
    auto vertex = vertices.col(v);
    vertex.x() = 0.0258 + (vertex.x() - 0.0255) * (0.9 + vertex.z());
    vertex.y() *= 1.5;
    vertex += 0.0002 * Vec3(std::sin(1.7 * v), std::sin(2.3 * v), std::sin(3.1 * v));
  }
  scene.muscles[0].fibers.count = 20;
  return scene;
}

/// The tube and another in front of it.
Scene two_tubes(const std::string& contact) {
  Scene scene = flexing_tube();
  Muscle other = scene.muscles[0];
  other.name = "other";
  other.surface.vertices.colwise() += Vec3(0.0205, 0.004, 0);
  scene.muscles.push_back(other);
  scene.method.contact["muscle"] = contact;
  return scene;
}

/// Sections across a line in front of a hinge, one of which keeps out of the bones.
Scene line_scene() {
  Scene scene = tube_scene();
  scene.method.name = "cylinder";
  Muscle& muscle = scene.muscles[0];
  ActionLine& line = muscle.action_line;
  line.points = Points{{0.02, 0.022, 0.02}, {0, 0, 0}, {0.1, 0.02, -0.1}};
  line.bodies = {0, 0, 1};
  line.rays = 8;
  line.scaling = 3;
  line.tendon = 0.03;
  const Points centers = subdivide_line(line.points, line.scaling);
  const auto count = static_cast<Index>(centers.cols());
  Eigen::MatrixXd radii(8, count);
  for (Index k = 0; k < count; ++k)
    for (Index i = 0; i < 8; ++i) radii(i, k) = 0.004 + 0.001 * (i % 4) + 0.0003 * std::sin(1.7 * i + 2.3 * k);
  muscle.surface = {section_vertices(centers, section_frames(centers, Vec3::UnitY()), radii), section_faces(count, 8)};
  muscle.attachments = {{"o", AttachmentEnd::origin, 0, {0, 1, 2}},
                        {"i", AttachmentEnd::insertion, 1, {8 * count, 8 * count + 1}}};
  scene.transversals = {{{0, 8, 0}, {}, {0, 1}}};
  return flexing(scene, radians(60), radians(2));
}

}  // namespace

TEST(FarScenes, a_muscle_on_strings_deforms_as_at_the_origin) { expect_same(flexing_tube()); }

TEST(FarScenes, a_muscle_on_bodies_deforms_as_at_the_origin) {
  XpbdSettings settings;
  settings.skinning = Skinning::bodies;
  expect_same(flexing_tube(settings));
}

TEST(FarScenes, a_coarser_copy_with_inertia_deforms_as_at_the_origin) {
  XpbdSettings settings;
  settings.simulated_edge = 0.006;
  settings.full_iterations = 1;
  settings.time_mode = TimeMode::dynamic;
  expect_same(flexing_tube(settings));
}

TEST(FarScenes, an_active_muscle_deforms_as_at_the_origin) {
  Scene scene = flexing_tube();
  scene.activation.signals = {{"tube", {0}, {0.3}}};
  expect_same(scene);
}

TEST(FarScenes, muscles_meet_as_at_the_origin) { expect_same(two_tubes("surface")); }

TEST(FarScenes, muscles_meet_by_virtual_edges_as_at_the_origin) { expect_same(two_tubes("virtual-edges")); }

TEST(FarScenes, sections_about_a_line_keep_out_of_bones_as_at_the_origin) { expect_same(line_scene()); }

TEST(FarScenes, an_arm_of_bones_and_muscles_deforms_as_at_the_origin) {
  Scene scene = demo_scene("elbow", radians(20));
  std::erase_if(scene.muscles,
                [](const Muscle& muscle) { return muscle.name.find("brachialis") == std::string::npos; });
  const RigidTransform by = Eigen::Translation3d(kilometres_away) * RigidTransform::Identity();
  const std::vector<FrameRecord> here = run(scene), there = run(moved(by, scene));
  const Difference d = difference(here, there, by);
  // Where a muscle lies on a bone the last bit decides which vertices touch it, a centimetre from the origin as well.
  EXPECT_LT(d.shape, 1e-3);
  EXPECT_LT(d.mean, 1e-5);
  EXPECT_LT(d.lengths, 1e-5);
  EXPECT_LT(d.volume, 1e-5);
  EXPECT_LT(d.belly, 1e-4);
  EXPECT_LT(d.ways, 1e-3);
  EXPECT_TRUE(d.same_gates);
}

TEST(FarScenes, turned_over_as_well_muscles_deform_as_turned_over_at_the_origin) {
  const RigidTransform turn(Eigen::AngleAxisd(2.4, Vec3(1, -2, 2).normalized()));
  expect_same(moved(turn, two_tubes("surface")));
}

TEST(FarScenes, a_run_goes_on_where_it_was_interrupted) {
  const Scene scene = moved(Eigen::Translation3d(kilometres_away) * RigidTransform::Identity(), flexing_tube());
  const std::vector<Pose> poses = pose_sequence(scene);
  const auto method = method_made_for(scene), resumed = method_made_for(scene);
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < 8; ++i) {
    if (i > 0) method->advance(poses[i], usual_time_step);
    frames.push_back(frame_of(*method, poses[i], static_cast<int>(i)));
  }
  resumed->restore({poses.begin(), poses.begin() + 6}, frames[4], frames[5]);
  EXPECT_LT(farthest(frame_of(*resumed, poses[5], 5), frames[5]), 1e-9);
  for (std::size_t i = 6; i < 8; ++i) resumed->advance(poses[i], usual_time_step);
  EXPECT_LT(farthest(frame_of(*resumed, poses[7], 7), frames[7]), 1e-6);
}

}  // namespace gracilis
