#include "opensim/model_texts.hpp"

#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/anatomy/sections/spindle.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/methods/cylinder/cylinder_method.hpp>
#include <gracilis/opensim/import/scene_folder.hpp>
#include <gracilis/opensim/kinematics/skeleton.hpp>
#include <gracilis/scene/validate.hpp>

#include <shapes.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace gracilis::opensim {

static const char* tetrahedron = "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

static std::string mesh(const std::string& file) {
  return "<attached_geometry><Mesh name=\"g\"><scale_factors>0.001 0.002 0.001</scale_factors><mesh_file>" + file +
         "</mesh_file></Mesh></attached_geometry>";
}

/// A sled that hangs by a pin, and a knee below that shifts as it bends; one muscle over both.
static std::string knee_model() {
  const auto axis = [](const std::string& name, const std::string& direction, const std::string& function) {
    return "<TransformAxis name=\"" + name + "\"><coordinates>bend</coordinates><axis>" + direction + "</axis>" +
           function + "</TransformAxis>";
  };
  const std::string knee =
      "<SpatialTransform>" +
      axis("rotation1", "0 0 1", "<LinearFunction><coefficients>1 0</coefficients></LinearFunction>") +
      axis("translation2", "0 1 0", "<SimmSpline><x>-1 0 1 2</x><y>-0.4 -0.5 -0.45 -0.4</y></SimmSpline>") +
      "<TransformAxis name=\"translation1\"><axis>1 0 "
      "0</axis><Constant><value>0.03</value></Constant></TransformAxis>" +
      "</SpatialTransform>";
  return document(
      set("BodySet", body("thigh", mesh("thigh.obj")) + body("shank", mesh("..\\secret.obj"))) +
      set("JointSet", joint("PlanarJoint", "hip", "/ground", "thigh",
                            coordinate("swing", "0.2") + coordinate("way_tx", "0.6") + coordinate("height", "1.1"), "",
                            "0.1 0.2 0.3", "0.3 0.2 0.1") +
                          joint("CustomJoint", "knee", "/bodyset/thigh", "shank", coordinate("bend", "-0.3"), knee)) +
      set("ForceSet",
          muscle("rectus", point("thigh", "0.05 0 0") + point("thigh", "0.06 -0.4 0") + point("shank", "0.05 -0.1 0"),
                 "<max_isometric_force>800</max_isometric_force><optimal_fiber_length>0.1"
                 "</optimal_fiber_length><tendon_slack_length>0.3</tendon_slack_length>")));
}

static CoordinateMotion some_motion() {
  CoordinateMotion motion;
  motion.times = {0, 0.1, 0.2};
  motion.values.resize(3, 4);
  motion.values << 0.2, 0.6, 1.1, -0.3, 0.5, 0.7, 1.0, 0.4, -0.2, 0.1, 1.2, 1.3;
  return motion;
}

TEST(SceneFolder, a_scene_moves_its_bodies_as_the_model_does) {
  const TestFolder folder;
  folder.write("thigh.obj", tetrahedron);
  const Model model = read_model(folder.write("m.osim", knee_model()));
  const CoordinateMotion motion = some_motion();
  write_scene_folder(model, {folder.path(), {}, {}}, {{"walk", motion}}, {}, folder.path() / "out");
  const LoadedScene loaded = read_scene(folder.path() / "out/walk.toml");
  EXPECT_TRUE(validate(loaded.scene).empty());
  const std::vector<Pose> poses = pose_sequence(loaded.scene);
  Skeleton skeleton(model);
  skeleton.place(default_coordinates(model));
  const std::vector<RigidTransform> capture = skeleton.poses();
  ASSERT_GE(poses.size(), 3u);
  for (int row = 0; row < 3; ++row) {
    skeleton.place(motion.values.row(row));
    const Pose& pose = poses[poses.size() - 3 + static_cast<std::size_t>(row)];
    for (const char* name : {"thigh", "shank"}) {
      const auto in_model = static_cast<std::size_t>(index_of(model.bodies, name));
      const auto in_scene = static_cast<std::size_t>(
          std::find(loaded.scene.bodies.begin(), loaded.scene.bodies.end(), name) - loaded.scene.bodies.begin());
      const RigidTransform expected = skeleton.poses()[in_model] * capture[in_model].inverse();
      EXPECT_LT((pose.bodies[in_scene].matrix() - expected.matrix()).norm(), 1e-12) << name << row;
    }
  }
}

TEST(SceneFolder, bones_lie_where_the_model_shows_them) {
  const TestFolder folder;
  folder.write("thigh.obj", tetrahedron);
  const Model model = read_model(folder.write("m.osim", knee_model()));
  const std::vector<std::string> left_out =
      write_scene_folder(model, {folder.path(), {}, {}}, {}, {}, folder.path() / "out").left_out;
  Skeleton skeleton(model);
  skeleton.place(default_coordinates(model));
  const LoadedScene loaded = read_scene(folder.path() / "out/model.toml");
  ASSERT_EQ(loaded.scene.bones.size(), 1u);
  EXPECT_LT((loaded.scene.bones[0].surface.vertices.col(2) - skeleton.poses()[1] * Vec3(0, 0.2, 0)).norm(), 1e-12);
  EXPECT_THAT(left_out, testing::ElementsAre(testing::HasSubstr("surface '../secret.obj' is not found")));
}

TEST(SceneFolder, surfaces_outside_the_folders_are_not_looked_at) {
  const TestFolder folder;
  std::filesystem::create_directories(folder.path() / "models");
  folder.write("secret.obj", tetrahedron);
  const Model model = read_model(folder.write("models/m.osim", knee_model()));
  const ModelBones bones = load_bones(model, Skeleton(model).poses(), {folder.path() / "models", {}, {}});
  EXPECT_TRUE(bones.bones.empty());
  EXPECT_EQ(bones.missing.size(), 2u);
}

TEST(SceneFolder, a_map_names_files_and_their_unit) {
  const TestFolder folder;
  folder.write("a.obj", tetrahedron);
  const Model model = read_model(folder.write("m.osim", knee_model()));
  const auto named = read_geometry_map(folder.write(
      "map.toml", "\"thigh.obj\" = { files = [\"a.obj\", \"a.obj\"], unit = \"cm\" }\n\"secret.obj\" = \"a.obj\"\n"));
  const ModelBones bones = load_bones(model, Skeleton(model).poses(), {folder.path(), {}, named});
  ASSERT_EQ(bones.bones.size(), 3u);
  EXPECT_EQ(bones.bones[1].name, "a_2");
  const Points& first = bones.bones[0].surface.vertices;
  EXPECT_NEAR((first.col(1) - first.col(0)).norm(), 1, 1e-12);
}

TEST(SceneFolder, a_muscle_has_its_volume_and_is_held_at_its_ends) {
  const Model model = model_from(knee_model());
  Skeleton skeleton(model);
  const Eigen::VectorXd q = default_coordinates(model);
  skeleton.place(q);
  const MuscleVolume volume = muscle_volume(model, model.muscles[0], skeleton.poses(), q, {});
  const MeshReport report = inspect_mesh(volume.surface);
  EXPECT_TRUE(report.is_closed() && report.is_manifold() && report.is_oriented());
  EXPECT_EQ(volume.held[0].body, 1);
  EXPECT_EQ(volume.held[0].vertices.size(), 13u);
  EXPECT_EQ(volume.held[1].body, 2);
  EXPECT_EQ(volume.held[1].vertices.size(), 13u);
  // Belly and tendon; twelve corners instead of a circle take 4.5 % away.
  const MuscleSize size{800, 0.1, 0, 6.1e5};
  const Real tendon = pi * tendon_radius(size) * tendon_radius(size) * volume.line.tendon;
  EXPECT_NEAR(report.volume, 0.955 * (gracilis::muscle_volume(size) + tendon), 0.1 * gracilis::muscle_volume(size));
}

TEST(SceneFolder, the_tendon_lies_at_the_insertion_or_at_both_ends) {
  const Model model = model_from(knee_model());
  Skeleton skeleton(model);
  const Eigen::VectorXd q = default_coordinates(model);
  skeleton.place(q);
  VolumeSettings settings;
  const auto line = [&](TendonPlace place) {
    settings.tendon = place;
    return muscle_volume(model, model.muscles[0], skeleton.poses(), q, settings).line;
  };
  const ActionLine half = line(TendonPlace::half_at_insertion), whole = line(TendonPlace::whole_at_insertion),
                   both = line(TendonPlace::both_ends);
  EXPECT_GT(half.tendon, 0);
  EXPECT_EQ(half.origin_tendon, 0);
  EXPECT_NEAR(whole.tendon, 2 * half.tendon, 1e-15);
  EXPECT_NEAR(both.tendon, half.tendon, 1e-15);
  EXPECT_NEAR(both.origin_tendon, half.tendon, 1e-15);
}

TEST(SceneFolder, sections_are_brought_onto_a_surface_that_is_known) {
  const Model model =
      model_from(pendulum(muscle("m", point("/ground", "0 0.1 0") + point("/bodyset/rod", "0 -0.3 0"))));
  const TestFolder folder;
  SceneFolderSettings settings;
  settings.volumes.surfaces["m"] = shapes::box({-0.01, -0.25, -0.02}, {0.03, 0.05, 0.02});
  const NamedMotion rest{"rest", {{0}, Eigen::MatrixXd::Zero(1, 1), {}}};
  EXPECT_THAT(write_scene_folder(model, {}, {rest}, settings, folder.path()).left_out, testing::IsEmpty());
  const Scene scene = read_scene(folder.path() / "rest.toml", {}).scene;
  EXPECT_THAT(validate(scene), testing::IsEmpty());
  const gracilis::Muscle& muscle = scene.muscles[0];
  ASSERT_GT(muscle.action_line.centers.cols(), 8);
  int on_box = 0;
  for (Index v = 0; v < muscle.surface.vertex_count() - 2; ++v) {
    const Vec3 corner = muscle.surface.vertices.col(v);
    if (corner.y() < 0.045 && corner.y() > -0.245 && std::abs(std::abs(corner.x() - 0.01) - 0.02) < 1e-9) ++on_box;
  }
  EXPECT_GT(on_box, 100);
  // Beside the line: rays match its two sides.
  settings.volumes.surfaces["m"] = shapes::box({0.01, -0.25, -0.02}, {0.03, 0.05, 0.02});
  std::filesystem::remove(folder.path() / "model.toml");
  write_scene_folder(model, {}, {}, settings, folder.path());
  std::ifstream matches(folder.path() / "matches.csv");
  std::string header, first;
  std::getline(matches, header);
  std::getline(matches, first);
  EXPECT_EQ(header, "muscle,section,x_mm,y_mm,z_mm,to_x_mm,to_y_mm,to_z_mm");
  EXPECT_THAT(first, testing::MatchesRegex("m,[0-9]+(,-?[0-9.]+){6}"));
  settings.volumes.surfaces["m"] = shapes::box({5, 5, 5}, {6, 6, 6});
  std::filesystem::remove(folder.path() / "model.toml");
  EXPECT_THAT(write_scene_folder(model, {}, {}, settings, folder.path()).left_out,
              testing::ElementsAre(testing::HasSubstr("nowhere near its line")));
}

TEST(SceneFolder, the_walking_model_becomes_a_scene_of_92_muscles) {
  GRACILIS_NEEDS_DATA("opensim");
  const TestFolder folder;
  const auto path = data_root() / "opensim/subject01_simbody_adjusted_StaticOp.osim";
  const Model model = read_model(path);
  CoordinateMotion motion =
      coordinate_motion(model, read_table(data_root() / "opensim/subject01_walk1_Kinematics.sto"));
  motion.times.resize(3);
  motion.values.conservativeResize(3, Eigen::NoChange);
  const GeometryPlaces places{path.parent_path(), {data_root() / "opensim/geometry"}, {}};
  const auto left_out = write_scene_folder(model, places, {{"walk", motion}}, {}, folder.path()).left_out;
  EXPECT_THAT(left_out, testing::IsEmpty());
  const LoadedScene loaded = read_scene(folder.path() / "walk.toml");
  EXPECT_EQ(loaded.scene.muscles.size(), 92u);
  EXPECT_EQ(loaded.scene.bones.size(), 19u);
  EXPECT_TRUE(validate(loaded.scene).empty());
  Scene cylinders = loaded.scene;
  cylinders.method.name = "cylinder";
  EXPECT_TRUE(validate(cylinders).empty());
  const auto method = make_cylinder_method(cylinders);
  Frame frame;
  for (const Pose& pose : pose_sequence(cylinders)) method->advance(pose, usual_time_step);
  method->write(frame);
  EXPECT_EQ(frame.muscles.size(), 92u);
}

TEST(SceneFolder, the_cadaver_hip_becomes_a_scene_of_8_muscles) {
  GRACILIS_NEEDS_DATA("lhdl-hip");
  const TestFolder folder;
  const Model model = read_model(data_root() / "lhdl-hip/motion/LHDL_hip_r.osim");
  const auto coarse = [](const char* file) { return data_root() / "lhdl-hip/coarse" / file; };
  const std::map<std::string, GeometryFiles> named = {
      {"LHDL_pelvis.vtp", {{coarse("hip_bone_r.ply"), coarse("hip_bone_l.ply"), coarse("sacrum.ply")}, 0.001}},
      {"LHDL_femur_r.vtp", {{coarse("femur_r.ply")}, 0.001}}};
  const CoordinateMotion motion = coordinate_motion(model, read_table(data_root() / "lhdl-hip/motion/hip_flexion.mot"));
  const std::vector<std::string> left_out =
      write_scene_folder(model, {{}, {}, named}, {{"flexion", motion}}, {}, folder.path()).left_out;
  EXPECT_TRUE(left_out.empty());  // bellies leave room for tendons, though placeholders of slack lengths would not
  const LoadedScene loaded = read_scene(folder.path() / "flexion.toml");
  EXPECT_EQ(loaded.scene.muscles.size(), 8u);
  EXPECT_EQ(loaded.scene.motion.times.size(), 36u);
  EXPECT_TRUE(validate(loaded.scene).empty());
}

TEST(SceneFolder, muscles_that_no_volume_can_be_made_of_are_left_out_and_told) {
  const TestFolder folder;
  const auto with = [](const std::string& name, const std::string& end, const std::string& force) {
    return muscle(name, point("/ground", "0.3 0 0") + point("/bodyset/rod", end),
                  "<max_isometric_force>" + force + "</max_isometric_force>");
  };
  const Model model =
      read_model(folder.write("m.osim", pendulum(with("fit", "0 -0.4 0", "500") + with("far", "0 -1e9 0", "500") +
                                                 with("idle", "0 -0.4 0", "0") + with("thick", "0 -0.4 0", "1e12"))));
  const std::vector<std::string> left_out =
      write_scene_folder(model, {folder.path(), {}, {}}, {{"rest", {{0}, default_coordinates(model).transpose(), {}}}},
                         {}, folder.path() / "out")
          .left_out;
  EXPECT_THAT(left_out,
              testing::ElementsAre(testing::HasSubstr("far: has a path of"), testing::HasSubstr("idle: has no force"),
                                   testing::HasSubstr("thick: has a force of")));
  const LoadedScene loaded = read_scene(folder.path() / "out/rest.toml");
  ASSERT_EQ(loaded.scene.muscles.size(), 1u);
  EXPECT_TRUE(validate(loaded.scene).empty());
}

TEST(SceneFolder, names_of_a_model_that_is_not_utf_8_make_a_scene_that_can_be_read) {
  const TestFolder folder;
  const std::string way = point("/ground", "0.3 0 0") + point("/bodyset/b\xe9\"", "0 -0.4 0");
  std::string text =
      document(set("BodySet", body("b\xe9&quot;")) +
               set("JointSet", joint("PinJoint", "h\xfc", "/ground", "b\xe9&quot;", coordinate("\xe4"))) +
               set("ForceSet", muscle("m\xff", way, "", "")));
  for (std::size_t at; (at = text.find("b\xe9\"")) != std::string::npos;) text.replace(at, 3, "b\xe9&quot;");
  const Model model = read_model(folder.write("m.osim", text));
  write_scene_folder(model, {folder.path(), {}, {}}, {{"rest", {{0}, default_coordinates(model).transpose(), {}}}}, {},
                     folder.path() / "out");
  EXPECT_EQ(read_scene(folder.path() / "out/rest.toml").scene.joints[0].axes[0].coordinate, "\xc3\xa4");
}

/// How deep a vertex of one surface lies in the other, at most, m.
static Real deepest(const TriangleMesh& one, const TriangleMesh& other) {
  const SignedDistance distance(other);
  Real deepest = 0;
  for (const Vec3 vertex : one.vertices.colwise()) deepest = std::max(deepest, -distance.query(vertex).distance);
  return deepest;
}

static Real volume_of(const TriangleMesh& mesh) { return enclosed_volume(mesh.vertices, mesh.faces); }

TEST(SceneFolder, muscles_apart_lie_side_by_side_and_keep_their_volumes) {
  const TestFolder folder;
  const std::string size =
      "<max_isometric_force>800</max_isometric_force><optimal_fiber_length>0.1</optimal_fiber_length>"
      "<tendon_slack_length>0.1</tendon_slack_length>";
  // 8 mm apart and 13 mm thick, on one body, so that nothing else is about.
  const Model model =
      model_from(pendulum(muscle("left", point("/ground", "0.5 0 0") + point("/ground", "0.5 -0.4 0"), size) +
                          muscle("right", point("/ground", "0.508 0 0") + point("/ground", "0.508 -0.4 0.01"), size)));
  const CoordinateMotion rest{{0}, default_coordinates(model).transpose(), {}};
  const auto scene = [&](bool apart) {
    SceneFolderSettings settings;
    settings.apart = apart;
    const std::filesystem::path out = folder.path() / (apart ? "apart" : "round");
    EXPECT_THAT(write_scene_folder(model, {folder.path(), {}, {}}, {{"rest", rest}}, settings, out).left_out,
                testing::IsEmpty());
    return read_scene(out / "rest.toml", {}).scene;
  };
  const Scene round = scene(false), apart = scene(true);
  ASSERT_EQ(apart.muscles.size(), 2u);
  EXPECT_GT(deepest(round.muscles[0].surface, round.muscles[1].surface), 0.005);
  for (std::size_t m = 0; m < 2; ++m) {
    EXPECT_LT(deepest(apart.muscles[m].surface, apart.muscles[1 - m].surface), 0.0005);
    EXPECT_NEAR(volume_of(apart.muscles[m].surface) / volume_of(round.muscles[m].surface), 1, 0.03);
  }
}

}  // namespace gracilis::opensim
