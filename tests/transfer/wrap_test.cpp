#include "../strings/string_scenes.hpp"
#include "opensim/model_texts.hpp"

#include <gracilis/io/input_file.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/opensim/export/model_with_paths.hpp>
#include <gracilis/opensim/export/scene_lengths.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>
#include <gracilis/transfer/wrap_muscles.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

/// A muscle that nothing touches, between two bones at a hinge, and models of the same bones in frames of their own.
namespace gracilis {
namespace {

using opensim::body_fixed_xyz;

const Vec3 origin(-0.15, 0, 0.15), insertion(-0.15, 0, -0.15);
const RigidTransform of_upper = body_fixed_xyz({0.4, -0.7, 1.1}, {0.02, -0.05, 0.3});
/// Its z is the hinge, the scene's y.
const RigidTransform of_lower = body_fixed_xyz({-pi / 2, 0, 0.4}, {0, 0.03, 0});

/// No turn but one lays it on itself.
TriangleMesh bent_bone(Real from) {
  TriangleMesh bone = shapes::cylinder(0.015, 0.25, 24, 30);
  const Vec3 middle = bone.vertices.rowwise().mean();
  for (Index v = 0; v < bone.vertex_count(); ++v) {
    const Vec3 p = bone.vertices.col(v) - middle;
    const Real wide = 1 + 2 * p.z();
    bone.vertices.col(v) =
        Vec3(wide * p.x() + 1.5 * p.z() * p.z(), 1.3 * wide * p.y() + 4 * p.z() * p.z() * p.z(), p.z() + from);
  }
  return bone;
}

Scene hinge_scene() {
  Scene scene = strings::arm_scene();
  scene.method.name = "strings";
  scene.bones = {{"upper", 0, bent_bone(0.15)}, {"lower", 1, bent_bone(-0.15)}};
  scene.joints[0].axes[0].range_max = radians(45);
  Muscle& muscle = scene.muscles[0];
  muscle.surface.vertices.colwise() -= muscle.surface.vertices.rowwise().mean();
  muscle.surface.vertices.colwise() += (origin + insertion) / 2;
  Points line(3, 2);
  line << origin, insertion;
  muscle.given_fibers.append(line);
  return scene;
}

std::string numbers(const Vec3& v) { return fmt::format("{:.17g} {:.17g} {:.17g}", v.x(), v.y(), v.z()); }
std::string angles(const RigidTransform& frame) { return numbers(frame.linear().eulerAngles(0, 1, 2)); }

/// Muscles "flexor", far from where the scene has it, and "other".
std::string hinge_model() {
  using namespace opensim;
  const RigidTransform hinge = of_upper.inverse() * of_lower;
  const std::string flexion =
      "<Coordinate name=\"flexion\"><default_value>0</default_value><range>-1 1</range></Coordinate>";
  const std::string twist =
      "<Coordinate name=\"twist\"><default_value>0</default_value><range>-1 1</range></Coordinate>";
  const std::string points = point("/bodyset/upper", "0.1 0.2 0.3") + point("/bodyset/lower", "0.3 0.2 0.1");
  return document(
      set("BodySet", body("upper") + body("lower") + body("tip")) +
      set("JointSet",
          joint("WeldJoint", "fixed", "/ground", "upper", "", "", numbers(of_upper.translation()), angles(of_upper)) +
              joint("PinJoint", "hinge", "/bodyset/upper", "lower", flexion, "", numbers(hinge.translation()),
                    angles(hinge)) +
              joint("PinJoint", "wrist", "/bodyset/lower", "tip", twist, "", "0 0 0", "0 0 0")) +
      set("ForceSet",
          muscle("flexor", points, "<max_isometric_force>77</max_isometric_force>") + muscle("other", points)));
}

std::vector<opensim::ModelBone> bones_in_their_bodies(const Scene& scene) {
  std::vector<opensim::ModelBone> bones;
  for (const Bone& bone : scene.bones) {
    TriangleMesh surface = bone.surface;
    surface.vertices = (bone.body == 0 ? of_upper : of_lower).inverse() * surface.vertices;
    bones.push_back({bone.name, bone.body + 1, surface});
  }
  return bones;
}

/// All that the command does but for files of surfaces.
struct Wrapped {
  Wrapped() : scene(hinge_scene()), file(folder.write("model.osim", hinge_model())), model(opensim::read_model(file)) {
    const auto method = make_method(scene, [&](const DistanceFieldSettings& settings) {
      std::vector<DistanceField> fields;
      for (const Bone& bone : scene.bones) fields.push_back(build_bone_field(bone, settings));
      return fields;
    });
    samples = opensim::scene_lengths(scene, *method, model, shared_ranges(model, scene), 40, {}, 12);
    shared = shared_bodies(model, scene, bodies_to_share(model, scene), bones_in_their_bodies(scene),
                           std::vector<RigidTransform>(3, RigidTransform::Identity()));
    muscles = wrap_muscles(model, scene, shared.bodies, samples);
  }

  TestFolder folder;
  Scene scene;
  std::filesystem::path file;
  opensim::Model model;
  opensim::LengthSamples samples;
  SharedBodies shared;
  WrappedMuscles muscles;
};

const Wrapped& wrapped() {
  static const Wrapped made;
  return made;
}

TEST(SharedBodies, surfaces_in_other_frames_are_laid_on_each_other) {
  const std::vector<SharedBody>& bodies = wrapped().shared.bodies;
  ASSERT_EQ(bodies.size(), 2u);
  for (const SharedBody& body : bodies) {
    EXPECT_TRUE(body.registered);
    EXPECT_TRUE(body.frame.isApprox(body.of_scene == 0 ? of_upper : of_lower, 1e-7)) << body.name;
    EXPECT_LT(body.error, 1e-7);
  }
}

TEST(SharedBodies, other_bones_and_bodies_of_other_names_are_left_out) {
  Scene scene = hinge_scene();
  std::vector<opensim::ModelBone> bones = bones_in_their_bodies(scene);
  bones[1].surface.vertices *= 1.1;
  scene.bodies[0] = "thigh";
  const SharedBodies shared =
      shared_bodies(wrapped().model, scene, {0, 1}, bones, std::vector<RigidTransform>(3, RigidTransform::Identity()));
  EXPECT_TRUE(shared.bodies.empty());
  EXPECT_THAT(shared.left_out, testing::ElementsAre(testing::HasSubstr("thigh: the model has no body of this name"),
                                                    testing::HasSubstr("lower: its surfaces in the model are 1.100")));
}

TEST(SharedBodies, are_those_of_muscles_of_the_same_names_and_what_lies_between) {
  Scene scene = hinge_scene();
  scene.bodies.emplace_back("tip");  // a body of the model's, too, that no muscle lies on
  EXPECT_THAT(bodies_to_share(wrapped().model, scene), testing::ElementsAre(0, 1));
  scene.muscles[0].name = "extensor";
  EXPECT_THAT(bodies_to_share(wrapped().model, scene), testing::IsEmpty());
}

TEST(WrapMuscles, a_straight_muscle_has_its_length_in_a_model_of_other_frames) {
  const Wrapped& made = wrapped();
  ASSERT_EQ(made.muscles.muscles.size(), 1u) << testing::PrintToString(made.muscles.left_out);
  const std::string text = opensim::model_with_paths(made.file, made.model, made.muscles.muscles);
  const opensim::Model after = opensim::model_from(text);
  opensim::Skeleton skeleton(after);
  const auto flexor = static_cast<std::size_t>(opensim::index_of(after.muscles, "flexor"));
  EXPECT_EQ(after.muscles[flexor].max_isometric_force, 77);
  for (const Real angle : {0.0, 0.2, 0.5, 0.78}) {
    const Eigen::VectorXd q = Eigen::Vector2d(angle, 0);
    skeleton.place(q);
    const Real length = opensim::measure_path(skeleton, after.muscles[flexor].path, q).length;
    EXPECT_NEAR(length, (Eigen::AngleAxisd(angle, Vec3::UnitY()) * insertion - origin).norm(), 1e-6) << angle;
  }
}

TEST(WrapMuscles, poses_are_spread_over_coordinates_alone_that_a_muscle_crosses) {
  Scene scene = wrapped().scene;
  Joint wrist = scene.joints[0];
  wrist.parent_body = 1;
  wrist.child_body = static_cast<Index>(scene.bodies.size());
  wrist.axes[0].coordinate = "twist";
  scene.bodies.push_back("tip");
  scene.joints.push_back(wrist);
  const auto named = [&](const opensim::CoordinateBox& box) {
    std::vector<std::string> names;
    for (const Index i : box.coordinates)
      names.push_back(wrapped().model.coordinates[static_cast<std::size_t>(i)].name);
    return names;
  };
  EXPECT_THAT(named(shared_ranges(wrapped().model, scene)), testing::ElementsAre("flexion"));
  for (Attachment& attachment : scene.muscles[0].attachments)
    if (attachment.body == 1) attachment.body = wrist.child_body;
  EXPECT_THAT(named(shared_ranges(wrapped().model, scene)), testing::ElementsAre("flexion", "twist"));
}

TEST(WrapMuscles, points_lie_on_no_body_that_only_moves_along) {
  const Wrapped& made = wrapped();
  opensim::LengthSamples samples = made.samples;
  for (std::vector<RigidTransform>& pose : samples.scene_poses) pose.push_back(pose[1]);  // the tip, which never bends
  std::vector<SharedBody> bodies = made.shared.bodies;
  SharedBody tip = bodies[1];
  tip.name = "tip", tip.of_model = opensim::index_of(made.model.bodies, "tip"), tip.of_scene = 2;
  bodies.insert(bodies.begin(), tip);
  const WrappedMuscles muscles = wrap_muscles(made.model, made.scene, bodies, samples);
  ASSERT_EQ(muscles.muscles.size(), 1u);
  for (const opensim::PathPoint& point : muscles.muscles[0].path.points) EXPECT_NE(point.body, tip.of_model);
}

TEST(WrapMuscles, errors_in_held_out_poses_are_told) {
  ASSERT_EQ(wrapped().muscles.told.size(), 1u);
  EXPECT_THAT(to_string(wrapped().muscles.told[0]),
              testing::MatchesRegex("flexor: [0-9]+ points; 8 held-out poses: lengths 0.000 mm root .*"
                                    "; arms 0.00. mm root mean square, 0.00. at most"));
}

TEST(WrapMuscles, those_that_cannot_be_written_are_named) {
  const Wrapped& made = wrapped();
  opensim::LengthSamples samples = made.samples;
  samples.muscles.push_back(samples.muscles[0]);
  samples.muscles[1].name = "unknown";
  const WrappedMuscles upper_alone = wrap_muscles(made.model, made.scene, {made.shared.bodies[0]}, samples);
  EXPECT_TRUE(upper_alone.muscles.empty());
  EXPECT_THAT(upper_alone.left_out, testing::ElementsAre("flexor: its ends move with no body of the model",
                                                         "unknown: the model has no muscle of this name"));
}

TEST(ModelWithPaths, all_but_the_path_and_the_slack_length_stay_as_they_were_written) {
  const Wrapped& made = wrapped();
  const std::string before = read_text(made.file);
  const std::string after = opensim::model_with_paths(made.file, made.model, made.muscles.muscles);
  const std::size_t begin = before.find("<Thelen2003Muscle name=\"flexor\">"),
                    end = before.find("<Thelen2003Muscle name=\"other\">");
  EXPECT_EQ(after.substr(0, begin), before.substr(0, begin));
  EXPECT_EQ(after.substr(after.find("<Thelen2003Muscle name=\"other\">")), before.substr(end));
}

TEST(ModelWithPaths, a_file_of_version_3_gets_points_as_that_has_them) {
  const Wrapped& made = wrapped();
  const std::string old = opensim::document(opensim::set("ForceSet", opensim::muscle("flexor", "")), "30000");
  const TestFolder folder;
  opensim::Model model = made.model;
  model.version = 30000;
  const std::string text = opensim::model_with_paths(folder.write("old.osim", old), model, made.muscles.muscles);
  EXPECT_THAT(text, testing::HasSubstr("<body>upper</body>"));
  EXPECT_THAT(text, testing::HasSubstr("<body>lower</body>"));
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("socket")));
}

}  // namespace
}  // namespace gracilis
