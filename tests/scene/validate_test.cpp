#include <gracilis/scene/validate.hpp>

#include "shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace gracilis {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

const Real nan = std::numeric_limits<Real>::quiet_NaN();

Scene good_scene() {
  Scene scene;
  scene.name = "boxes";
  scene.bodies = {"pelvis", "femur"};
  scene.bones = {{"pelvis", 0, shapes::box(Vec3(0, 0, 2), Vec3(1, 1, 3))},
                 {"femur", 1, shapes::box(Vec3::Zero(), Vec3::Ones())}};
  scene.joints = {{"hip", 0, 1, RigidTransform::Identity(), {{"flexion", Vec3::UnitX(), 0, -1, 1}}}};
  Muscle muscle;
  muscle.name = "muscle";
  muscle.surface = shapes::box(Vec3(0, 0, 1), Vec3(1, 1, 2));
  muscle.attachments = {{"top", AttachmentEnd::origin, 0, {4, 5, 6, 7}, false},
                        {"bottom", AttachmentEnd::insertion, 1, {0, 1, 2, 3}, false}};
  scene.muscles = {muscle};
  scene.distance_fields.cell_size = 0.01;  // bones of a metre at the default would take gigabytes
  scene.motion = {"motion", {"flexion"}, {0, 1}, Eigen::Vector2d(0, 0.5)};
  return scene;
}

/// The problems as lines of text.
std::vector<std::string> problems(const Scene& scene) {
  std::vector<std::string> lines;
  for (const Problem& problem : validate(scene)) lines.push_back(to_string(problem));
  return lines;
}

/// What validation says after one change to a good scene.
template <class Change>
std::vector<std::string> problems_after(Change change) {
  Scene scene = good_scene();
  change(scene);
  return problems(scene);
}

#define EXPECT_PROBLEM(change, message) \
  EXPECT_THAT(problems_after([](Scene& s) { change; }), Contains(HasSubstr(message)))

}  // namespace

TEST(Validate, a_good_scene_has_no_problem) { EXPECT_THAT(problems(good_scene()), ElementsAre()); }

TEST(Validate, everything_is_found_at_once) {
  Scene scene = good_scene();
  scene.joints[0].axes[0].axis = Vec3::Zero();
  scene.muscles[0].fibers.pennation = nan;
  scene.muscles[0].attachments[0].vertices.clear();
  scene.motion.times = {1, 1};
  EXPECT_THAT(problems(scene),
              ElementsAre(HasSubstr("joint 'hip': the axis of 'flexion' has no length"),
                          HasSubstr("muscle 'muscle': 'pennation' must be a number from -1.2 to 1.2 rad"),
                          HasSubstr("muscle 'muscle', attachment 'top': holds no vertex"),
                          HasSubstr("motion 'motion': the time does not increase at row 1")));
}

TEST(Validate, an_empty_scene_says_what_is_missing) {
  EXPECT_THAT(problems(Scene{}),
              ElementsAre(HasSubstr("the scene has no bodies"), HasSubstr("the scene has no muscles")));
}

TEST(Validate, surfaces_must_have_triangles_of_finite_existing_vertices) {
  EXPECT_PROBLEM(s.muscles[0].surface = {}, "muscle 'muscle': the surface has no triangles");
  EXPECT_PROBLEM(s.bones[1].surface.vertices(2, 3) = nan, "bone 'femur': vertex 3 is not finite");
  EXPECT_PROBLEM(s.bones[0].surface.faces(1, 5) = 8,
                 "bone 'pelvis': triangle 5 refers to a vertex that does not exist");
  EXPECT_PROBLEM(s.bones[0].surface.faces(1, 5) = -1, "triangle 5 refers to a vertex that does not exist");
}

TEST(Validate, surfaces_stand_where_numbers_tell_micrometers_apart) {
  EXPECT_PROBLEM(s.bones[1].surface.vertices.array() += 1e9, "bone 'femur': vertex 0 lies more than 10,000 km from");
  EXPECT_THAT(problems_after([](Scene& s) {
                for (Bone& bone : s.bones) bone.surface.vertices.array() += 1e4;
                for (Muscle& muscle : s.muscles) muscle.surface.vertices.array() += 1e4;
              }),
              ElementsAre())
      << "kilometres away";
}

TEST(Validate, names_must_be_unique_and_fit_for_files) {
  EXPECT_PROBLEM(s.bones[1].name = "pelvis", "bone 'pelvis': duplicate name");
  EXPECT_PROBLEM(s.muscles[0].name = "../muscle", "is not fit for a file's name");
  EXPECT_PROBLEM(s.muscles[0].name = "", "is not fit for a file's name");
}

TEST(Validate, joints_must_chain_every_body_to_the_first) {
  EXPECT_PROBLEM(s.joints.clear(), "body 'femur': no joint says how it moves against 'pelvis'");
  EXPECT_PROBLEM(s.joints[0].child_body = 0, "moves the body 'pelvis', which is fixed in the world");
  EXPECT_PROBLEM(s.joints[0].child_body = 2, "refers to body number 2, which does not exist");
  EXPECT_PROBLEM(s.joints[0].parent_body = 1, "its parent 'femur' does not hang on a joint before it");
  EXPECT_PROBLEM(s.joints.push_back(s.joints[0]), "the body 'femur' is moved by another joint already");
  EXPECT_PROBLEM(s.bones[1].body = 7, "bone 'femur': refers to body number 7");
}

TEST(Validate, axes_must_be_unit_vectors_with_names_and_ranges) {
  EXPECT_PROBLEM(s.joints[0].axes[0].axis = Vec3(2, 0, 0), "is not a unit vector");
  EXPECT_PROBLEM(s.joints[0].axes[0].axis[1] = nan, "is not a unit vector");
  EXPECT_PROBLEM(s.joints[0].axes[0].capture_value = nan, "the capture value of 'flexion' is not finite");
  EXPECT_PROBLEM(s.joints[0].axes[0].range_min = 2, "the range of 'flexion' ends before it begins");
  EXPECT_PROBLEM(s.joints[0].axes.push_back(s.joints[0].axes[0]), "duplicate coordinate 'flexion'");
  EXPECT_PROBLEM(s.joints[0].frame.translation()[0] = nan, "joint 'hip': its frame is not finite");
}

TEST(Validate, attachments_must_hold_existing_vertices_for_one_body_each) {
  EXPECT_PROBLEM(s.muscles[0].attachments[0].vertices.push_back(8), "vertex 8 does not exist");
  EXPECT_PROBLEM(s.muscles[0].attachments[0].vertices = std::vector<Index>(2, 5), "its vertices do not ascend");
  EXPECT_PROBLEM(s.muscles[0].attachments[1].vertices.push_back(4),
                 "1 of its vertices are fixed to 'pelvis' by the attachment 'top'");
  EXPECT_PROBLEM(s.muscles[0].attachments[1].body = -1, "refers to body number -1");
  EXPECT_PROBLEM(s.muscles[0].attachments.pop_back(), "muscle 'muscle': it has no insertion");
  EXPECT_THAT(problems_after([](Scene& s) { s.muscles[0].attachments.push_back(s.muscles[0].attachments[0]); }),
              ElementsAre())
      << "two attachments of one body may share vertices";
}

TEST(Validate, settings_must_lie_within_their_ranges) {
  EXPECT_PROBLEM(s.distance_fields.cell_size = 0, "distance_field: 'cell_size' must be a number");
  EXPECT_PROBLEM(s.sequence.hold_frames = -1, "sequence: 'hold_frames' must be an integer");
}

TEST(Validate, the_motion_must_be_a_finite_table_of_known_coordinates_with_increasing_times) {
  EXPECT_PROBLEM(s.motion.coordinates[0] = "knee", "no joint has the coordinate 'knee'");
  EXPECT_PROBLEM(s.motion.values(1, 0) = nan, "row 1 is not finite");
  EXPECT_PROBLEM(s.motion.times[0] = nan, "row 0 is not finite");
  EXPECT_PROBLEM(s.motion.times.push_back(2), "its table has 2 rows and 1 columns, but there are 3 times");
  EXPECT_THAT(problems_after([](Scene& s) { s.motion = {}; }), ElementsAre()) << "no motion at all is fine";
}

TEST(Validate, a_translation_that_jumps_by_hundreds_of_meters_is_named_with_its_rows) {
  Scene scene = good_scene();
  scene.joints[0].axes.push_back({"shift", Vec3::UnitZ(), 0, -1, 1, true});
  scene.motion.coordinates.push_back("shift");
  scene.motion.values = Eigen::Matrix2d::Zero();
  scene.motion.values(1, 1) = 90;
  EXPECT_THAT(problems(scene), ElementsAre());
  scene.motion.values(1, 1) = 1e4;
  EXPECT_THAT(problems(scene),
              ElementsAre(HasSubstr("motion 'motion': the coordinate 'shift' jumps by 1e+04 m from row 0 to row 1")));
}

TEST(Validate, what_becomes_a_file_has_a_name_of_its_own) {
  EXPECT_PROBLEM(s.muscles[0].name = "femur", "muscle 'femur': a bone has the same name");
  EXPECT_PROBLEM(s.muscles[0].name = std::string(121, 'a'), "the name is too long");
  EXPECT_PROBLEM(s.bones[0].name = "a/b", "bone 'a/b': the name is not fit for a file's name");
  EXPECT_PROBLEM(s.bones[0].name = ".hidden", "is not fit for a file's name");
  EXPECT_PROBLEM(s.name = "a\nb", "the scene's name holds a control character");
}

TEST(Validate, what_becomes_a_column_has_a_name_of_its_own) {
  EXPECT_PROBLEM(s.muscles[0].name = "flexion", "coordinate 'flexion': a muscle has the same name");
  EXPECT_PROBLEM(s.joints[0].axes[0].coordinate = "muscle_f003", "a fiber of the muscle 'muscle' is called so");
  EXPECT_PROBLEM(s.joints[0].axes[0].coordinate = "dihedral_change_max", "measures have a column");
  for (const char* name : {"a,b", "a\tb", "a\nb", "a\"b", " a", "a ", "time", "Time"}) {
    Scene scene = good_scene();
    scene.joints[0].axes[0].coordinate = name;
    EXPECT_THAT(problems(scene), Contains(HasSubstr("is not fit for a column of a table"))) << name;
  }
  EXPECT_THAT(problems_after([](Scene& s) {
                s.joints[0].axes[0].coordinate = "hip flexion";
                s.motion.coordinates = {"hip flexion"};
              }),
              ElementsAre());
}

TEST(Validate, settings_that_ask_for_more_memory_than_there_is_are_named) {
  EXPECT_PROBLEM(s.distance_fields.resolution = 1024, "distance_field: 'resolution' asks for grids of 2.2e+09 nodes");
  EXPECT_PROBLEM(s.distance_fields.cell_size = 1e-4, "distance_field: 'cell_size' asks for grids");
  EXPECT_PROBLEM((s.muscles[0].fibers.count = 100'000, s.muscles[0].fibers.segments = 10'000),
                 "fibers: 'count' and 'segments' ask for 1e+09 points");
  EXPECT_PROBLEM(s.muscles[0].fibers.count = 10'001, "fibers: 'count' asks for 10001 fibers in 'muscle'");
  EXPECT_PROBLEM((s.muscles[0].fibers.count = 100'000, s.muscles[0].contraction.segments = 10'000),
                 "contraction: 'segments' and the 'count' of fibers ask for 1e+09 points");
}

}  // namespace gracilis
