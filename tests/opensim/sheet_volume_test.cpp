#include "opensim/model_texts.hpp"

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/anatomy/sections/sheet.hpp>
#include <gracilis/anatomy/sections/spindle.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/self_crossings.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/methods/cylinder/cylinder_method.hpp>
#include <gracilis/opensim/import/muscle_heads.hpp>
#include <gracilis/opensim/import/muscle_names.hpp>
#include <gracilis/opensim/import/scene_folder.hpp>
#include <gracilis/opensim/import/sheet_volume.hpp>
#include <gracilis/opensim/kinematics/skeleton.hpp>
#include <gracilis/scene/section_line.hpp>
#include <gracilis/scene/validate.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

static std::string head(const std::string& name, const std::string& origin, const std::string& insertion,
                        const std::string& force = "400") {
  return muscle(name, point("/ground", origin) + point("/bodyset/rod", insertion),
                "<max_isometric_force>" + force +
                    "</max_isometric_force><optimal_fiber_length>0.1</optimal_fiber_length>"
                    "<tendon_slack_length>0.1</tendon_slack_length>");
}

/// Three heads behind a hinge that come together; in the model's file the middle one stands last.
static Model fan() {
  return model_from(pendulum(head("fan1_r", "0.1 0.2 -0.05", "0.1 -0.1 -0.01") +
                             head("fan3_r", "0.1 0.2 0.05", "0.1 -0.1 0.01", "800") +
                             head("fan2_r", "0.1 0.21 0", "0.1 -0.11 0")));
}

static MuscleVolume sheet_of(const Model& model) {
  Skeleton skeleton(model);
  const Eigen::VectorXd coordinates = default_coordinates(model);
  skeleton.place(coordinates);
  std::vector<const Muscle*> heads;
  for (const Muscle& each : model.muscles) heads.push_back(&each);
  return sheet_volume(model, heads, skeleton.poses(), coordinates, {});
}

static Index sections_of(const MuscleVolume& sheet) { return static_cast<Index>(sheet.line.heads[0].shares.size()); }

/// Without what is tendon.
static Real belly_volume(const MuscleVolume& sheet) {
  const ActionLine& head = sheet.line.heads[0];
  const Real end = 1 - head.tendon / polyline_length(head.points) + 1e-9;
  const auto sections =
      static_cast<Index>(std::upper_bound(head.shares.begin(), head.shares.end(), end) - head.shares.begin());
  const Points corners = sheet.surface.vertices.leftCols(sections * sheet.line.rays);
  return enclosed_volume(sheet_vertices(corners, sheet.line.rays), sheet_faces(sections, sheet.line.rays));
}

static void expect_sound(const MuscleVolume& sheet) {
  const MeshReport report = inspect_mesh(sheet.surface);
  EXPECT_TRUE(report.is_closed() && report.is_manifold() && report.is_oriented());
  EXPECT_FALSE(report.degenerate_faces);
}

TEST(MuscleHeads, are_known_by_numbers_and_parts_of_a_sheet) {
  EXPECT_EQ(muscle_of_head("glut_max1_r"), "glut_max_r");
  EXPECT_EQ(muscle_of_head("r_GlutMed_2"), "r_GlutMed");
  EXPECT_EQ(muscle_of_head("addmagProx_l"), "addmag_l");
  for (const char* name : {"glut_max_r", "tib_ant_r", "tib_post_r", "bifemlh_l", "12", "r_", ""})
    EXPECT_EQ(muscle_of_head(name), "") << name;
}

TEST(MuscleHeads, of_one_muscle_end_on_the_same_bodies) {
  const auto groups = [](const std::string& muscles) {
    const Model model = model_from(pendulum(muscles));
    std::vector<const Muscle*> all;
    for (const Muscle& each : model.muscles) all.push_back(&each);
    std::vector<std::string> names;
    for (const MuscleHeads& group : heads_among(all)) names.push_back(group.name + std::to_string(group.heads.size()));
    return names;
  };
  const std::string one = head("m1_r", "0 0.2 0", "0 -0.1 0"), two = head("m2_r", "0 0.2 0.1", "0 -0.1 0.1");
  EXPECT_THAT(groups(one + two + head("m1_l", "0 0.2 0", "0 -0.1 0")), testing::ElementsAre("m_r2"));
  const std::string elsewhere = muscle("m3_r", point("/ground", "0 0.2 0") + point("/ground", "0 0.5 0"), "");
  EXPECT_THAT(groups(one + two + elsewhere), testing::IsEmpty());
  const std::string other_origin =
      muscle("m3_r", point("/bodyset/rod", "0 -0.3 0") + point("/bodyset/rod", "0 -0.1 0"), "");
  EXPECT_THAT(groups(one + two + other_origin), testing::ElementsAre("m_r3"));
  EXPECT_THAT(groups(one + other_origin), testing::IsEmpty());
}

TEST(SheetVolume, is_closed_does_not_cut_itself_and_has_the_volume_of_its_heads) {
  const Model model = fan();
  const MuscleVolume sheet = sheet_of(model);
  expect_sound(sheet);
  const std::vector<char> crossing =
      crossing_faces(TriangleTree(sheet.surface), sheet.surface,
                     build_topology(sheet.surface.faces, sheet.surface.vertex_count()).edges);
  EXPECT_EQ(std::count(crossing.begin(), crossing.end(), 1), 0);
  Real wanted = 0;
  for (const Muscle& each : model.muscles)
    wanted += gracilis::muscle_volume({each.max_isometric_force, each.optimal_fiber_length, 0, 6.1e5});
  EXPECT_NEAR(belly_volume(sheet) / wanted, 1, 1e-3);
}

TEST(SheetVolume, heads_lie_from_edge_to_edge_and_inside) {
  const MuscleVolume sheet = sheet_of(fan());
  std::vector<std::string> names;
  for (const ActionLine& each : sheet.line.heads) names.push_back(each.name);
  EXPECT_THAT(names, testing::ElementsAre("fan1_r", "fan2_r", "fan3_r"));
  const SignedDistance distance(sheet.surface);
  for (const ActionLine& each : sheet.line.heads) {
    const Points centers = section_line(each).centers;
    for (Eigen::Index k = 1; k + 1 < centers.cols(); ++k)
      EXPECT_LT(distance.query(centers.col(k)).distance, 0) << each.name << k;
  }
  // Flat: 100 mm wide at its origin, and 20 at its insertion.
  const auto extent = [&](Index section) -> Vec3 {
    const auto ring = sheet.surface.vertices.middleCols(section * sheet.line.rays, sheet.line.rays);
    return ring.rowwise().maxCoeff() - ring.rowwise().minCoeff();
  };
  EXPECT_NEAR(extent(0).z(), 0.1, 0.01);
  EXPECT_NEAR(extent(sections_of(sheet) - 1).z(), 0.02, 0.01);
  const Vec3 middle = extent(sections_of(sheet) / 2);
  EXPECT_LT(middle.x(), 0.7 * middle.z());
}

TEST(SheetVolume, heads_on_one_line_make_a_round_muscle) {
  const Model model =
      model_from(pendulum(head("m1", "0.1 0.2 0", "0.1 -0.1 0") + head("m2", "0.1 0.2 0", "0.1 -0.1 0")));
  const MuscleVolume sheet = sheet_of(model);
  expect_sound(sheet);
  EXPECT_NEAR(belly_volume(sheet) / (2 * gracilis::muscle_volume({400, 0.1, 0, 6.1e5})), 1, 1e-3);
}

TEST(SheetVolume, ends_are_held_by_the_bodies_of_the_nearest_heads) {
  const Model model = model_from(
      pendulum(head("m1", "0.1 0.2 -0.05", "0.1 -0.1 0") + head("m2", "0.1 0.2 0", "0.1 -0.1 0.01") +
               muscle("m3", point("/bodyset/rod", "0.1 0.2 0.05") + point("/bodyset/rod", "0.1 -0.1 0.02"), "")));
  const MuscleVolume sheet = sheet_of(model);
  ASSERT_EQ(sheet.held.size(), 3u);
  Index held = 0;
  for (const HeldVertices& each : sheet.held) held += static_cast<Index>(each.vertices.size());
  EXPECT_EQ(held, 2 * (sheet.line.rays + 1));
  for (const HeldVertices& each : sheet.held)
    for (const Index v : each.vertices) {
      const Vec3 place = sheet.surface.vertices.col(v);
      if (std::abs(place.z() - 0.025) < 0.005) continue;  // half way, give or take the thickness
      const bool of_last = each.end == AttachmentEnd::origin && place.z() > 0.025;
      EXPECT_EQ(each.body, each.end == AttachmentEnd::insertion || of_last ? 1 : 0) << v;
    }
}

TEST(SheetVolume, a_sheet_that_would_cut_itself_is_refused) {
  // One head goes from one edge to the other and back beside heads that do not.
  const std::string zigzag = point("/ground", "0.1 0.2 -0.05") + point("/ground", "0.1 0.1 0.15") +
                             point("/ground", "0.1 0 -0.15") + point("/bodyset/rod", "0.1 -0.1 0.05");
  const Model model = model_from(pendulum(muscle("m1", zigzag, "<max_isometric_force>800</max_isometric_force>") +
                                          head("m2", "0.1 0.2 0.05", "0.1 -0.1 -0.05", "800")));
  EXPECT_THAT(message_of_input_error([&] { sheet_of(model); }), testing::HasSubstr("would cut itself"));
}

/// The scene of the fan, its heads merged.
static Scene fan_scene(const std::string& more = "") {
  const TestFolder folder;
  const Model model = fan();
  SceneFolderSettings settings;
  settings.merge_heads = true;
  const CoordinateMotion rest{{0}, default_coordinates(model).transpose(), {}};
  const SceneFolderNotes notes =
      write_scene_folder(model, {folder.path(), {}, {}}, {{"rest", rest}}, settings, folder.path() / "out");
  EXPECT_THAT(notes.left_out, testing::IsEmpty());
  EXPECT_THAT(notes.sheets, testing::ElementsAre("fan_r: a sheet over fan1_r, fan2_r, fan3_r"));
  folder.write("out/active.sto",
               "active\nnRows=1\nnColumns=4\ninDegrees=no\nendheader\n"
               "time\tfan1_r\tfan2_r\tfan3_r\n0\t0.1\t0.2\t0.6\n");
  folder.write("out/scene.toml", "schema = 1\ninclude = \"rest.toml\"\n" + more);
  const Scene scene = read_scene(folder.path() / "out/scene.toml").scene;
  EXPECT_THAT(validate(scene), testing::IsEmpty());
  return scene;
}

TEST(SheetVolume, a_scene_reads_back_what_import_made) {
  const Scene scene = fan_scene();
  ASSERT_EQ(scene.muscles.size(), 1u);
  const gracilis::Muscle& muscle = scene.muscles[0];
  const MuscleVolume sheet = sheet_of(fan());
  EXPECT_EQ(muscle.name, "fan_r");
  EXPECT_EQ(muscle.attachments.size(), 2u);
  EXPECT_LT((muscle.surface.vertices - sheet.surface.vertices).norm(), 1e-5);
  ASSERT_EQ(muscle.action_line.heads.size(), 3u);
  EXPECT_EQ(muscle.action_line.side, sheet.line.side);
  EXPECT_EQ(muscle.action_line.heads[1].name, "fan2_r");
  EXPECT_EQ(muscle.action_line.heads[2].max_isometric_force, 800);
  EXPECT_EQ(muscle.action_line.heads[0].bodies.size(), 2u);
}

TEST(SheetVolume, cylinder_carries_each_edge_along_its_heads_line_and_keeps_the_volume) {
  Scene scene = fan_scene();
  scene.method.name = "cylinder";
  const gracilis::Muscle& muscle = scene.muscles[0];
  const auto method = make_cylinder_method(scene);
  const Real rest = enclosed_volume(muscle.surface.vertices, muscle.surface.faces);
  for (const Real swing : {0.0, -0.3, 0.3}) {
    const Pose pose = pose_at(scene, std::vector<Real>{swing});
    method->advance(pose, usual_time_step);
    Frame frame;
    method->write(frame);
    const Points& now = frame.muscles[0].points;
    EXPECT_NEAR(enclosed_volume(now, muscle.surface.faces) / rest, 1, 0.01) << swing;
    const std::vector<LineSections> lines = carrying_lines(muscle);
    for (Index k = 0; k < static_cast<Index>(lines[0].places.size()); ++k) {
      // The last head's edge stands where its section takes it.
      const Vec3 corner = muscle.surface.vertices.col(k * muscle.action_line.rays);
      const Vec3 carried = sections_at(lines[2], pose).frame(k) *
                           (sections_at(lines[2], capture_pose(scene.bodies.size())).frame(k).inverse() * corner);
      EXPECT_LT((now.col(k * muscle.action_line.rays) - carried).norm(), 1e-9) << k;
    }
  }
}

TEST(SheetVolume, a_sheet_is_as_active_as_its_heads_weighted_by_their_forces) {
  const Scene scene = fan_scene("[[activations]]\nmuscle = \"fan_r\"\nfile = \"active.sto\"\n");
  ASSERT_EQ(scene.activation.signals.size(), 1u);
  EXPECT_NEAR(scene.activation.signals[0].values[0], (400 * 0.1 + 400 * 0.2 + 800 * 0.6) / 1600, 1e-12);
}

}  // namespace gracilis::opensim
