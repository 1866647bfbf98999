#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/scene/data_root.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/prepare_surfaces.hpp>
#include <gracilis/prepare/solids.hpp>

#include <build_paths.hpp>

#include "shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

/// The whole preparation: on small shapes, and on the cadaver's hip where its data are at hand.
namespace gracilis {
namespace {

using shapes::mm;
using shapes::sphere;

void silent(const std::string&) {}

/// Two muscles that overlap by 3 mm and a bone that both touch.
std::vector<NamedSurface> overlapping_muscles() {
  return {{"a", sphere(Vec3(-18.5 * mm, 0, 0), 20 * mm, 3)}, {"b", sphere(Vec3(18.5 * mm, 0, 0), 20 * mm, 3)}};
}
std::vector<NamedSurface> bone_between() { return {{"bone", sphere(Vec3(0, 0, 22 * mm), 10 * mm, 3)}}; }

TEST(Preparation, leaves_no_intersection_and_reports_what_moved) {
  PrepareSettings settings;
  settings.edge_length = 2.5 * mm;
  const PreparedSurfaces prepared = prepare_surfaces(overlapping_muscles(), bone_between(), settings, silent);
  ASSERT_EQ(prepared.muscles.size(), 2u);
  const TriangleMesh bone = bone_between()[0].mesh;
  const std::array<const TriangleMesh*, 3> all = {&prepared.muscles[0], &prepared.muscles[1], &bone};
  EXPECT_TRUE(intersecting_faces(all).empty());
  ASSERT_EQ(prepared.report.pairs.size(), 3u);
  for (const PreparedPairReport& pair : prepared.report.pairs) {
    EXPECT_GT(pair.intersections_before, 0) << pair.a << " " << pair.b;
    EXPECT_EQ(pair.intersections_after, 0) << pair.a << " " << pair.b;
  }
  for (const PreparedMuscleReport& muscle : prepared.report.muscles) {
    EXPECT_GT(muscle.vertices_moved, 0);
    EXPECT_GT(muscle.max_displacement, 1 * mm);
    EXPECT_GE(muscle.max_displacement, muscle.mean_displacement);
    EXPECT_LT(muscle.hausdorff, 4 * mm);
    EXPECT_NEAR(muscle.volume_after / muscle.volume_before, 1, 0.06);
  }
}

TEST(Preparation, of_prepared_surfaces_moves_nothing) {
  PrepareSettings settings;
  settings.edge_length = 2.5 * mm;
  const PreparedSurfaces once = prepare_surfaces(overlapping_muscles(), bone_between(), settings, silent);
  const PreparedSurfaces twice =
      prepare_surfaces({{"a", once.muscles[0]}, {"b", once.muscles[1]}}, bone_between(), settings, silent);
  for (std::size_t m = 0; m < 2; ++m) {
    EXPECT_LT(twice.report.muscles[m].hausdorff, 0.05 * mm);
    EXPECT_EQ(twice.report.muscles[m].vertices_moved, 0);
  }
}

TEST(Preparation, gives_edges_the_length_asked_for) {
  PrepareSettings settings;
  settings.edge_length = 4 * mm;
  const PreparedSurfaces prepared =
      prepare_surfaces({{"ball", sphere(Vec3::Zero(), 20 * mm, 4)}}, {}, settings, silent);
  const TriangleMesh& ball = prepared.muscles[0];
  Real sum = 0;
  for (Index f = 0; f < ball.face_count(); ++f)
    for (int k = 0; k < 3; ++k)
      sum += (ball.vertices.col(ball.faces(k, f)) - ball.vertices.col(ball.faces((k + 1) % 3, f))).norm();
  EXPECT_NEAR(sum / (3 * ball.face_count()), 4 * mm, 0.5 * mm);
  EXPECT_LT(prepared.report.muscles[0].hausdorff, 0.3 * mm);
}

Real volume_change(const PreparedMuscleReport& muscle) { return muscle.volume_after / muscle.volume_before - 1; }

/// As thin as triangles of 3 mm are long.
TriangleMesh sheet() {
  TriangleMesh mesh = sphere(Vec3::Zero(), 30 * mm, 4);
  mesh.vertices.row(2) *= 0.05;
  return mesh;
}

TEST(Preparation, of_a_clean_muscle_keeps_its_volume_unless_told_otherwise) {
  const PreparedSurfaces kept = prepare_surfaces({{"sheet", sheet()}}, {}, {}, silent);
  EXPECT_LT(std::abs(volume_change(kept.report.muscles[0])), 0.01);
  PrepareSettings loose;
  loose.volume_tolerance = 1;
  const PreparedSurfaces grown = prepare_surfaces({{"sheet", sheet()}}, {}, loose, silent);
  EXPECT_GT(volume_change(grown.report.muscles[0]), 0.02);  // the test would see it
}

TEST(Preparation, keeps_pieces_that_lie_apart_or_the_largest_alone) {
  const TriangleMesh large = sphere(Vec3::Zero(), 15 * mm, 3), small = sphere(Vec3(40 * mm, 0, 0), 10 * mm, 3);
  const PreparedSurfaces both = prepare_surfaces({{"heads", merged({small, large})}}, {}, {}, silent);
  EXPECT_EQ(both.report.muscles[0].pieces, 2);
  EXPECT_EQ(inspect_mesh(both.muscles[0]).components, 2);
  const PreparedSurfaces one = prepare_surfaces({{"heads", merged({small, large}), true}}, {}, {}, silent);
  EXPECT_EQ(inspect_mesh(one.muscles[0]).components, 1);
  EXPECT_NEAR(one.report.muscles[0].volume_after / enclosed_volume(large.vertices, large.faces), 1, 0.01);
}

TEST(Preparation, gives_what_a_scene_takes_of_surfaces_as_they_come) {
  TriangleMesh open = sphere(Vec3::Zero(), 15 * mm, 4);
  open.faces.conservativeResize(3, open.face_count() - 40);
  TriangleMesh pierced = sphere(Vec3::Zero(), 15 * mm, 3);
  Index top = 0;
  pierced.vertices.row(2).maxCoeff(&top);
  pierced.vertices(2, top) = -20 * mm;
  const TriangleMesh twice = merged({sphere(Vec3::Zero(), 15 * mm, 3), sphere(Vec3::Zero(), 15 * mm, 3)});
  const TriangleMesh crossing =
      merged({sphere(Vec3::Zero(), 15 * mm, 3), sphere(Vec3(10 * mm, 3 * mm, 0), 12 * mm, 3)});
  for (const TriangleMesh& mesh : {open, pierced, twice, crossing}) {
    const PreparedSurfaces prepared = prepare_surfaces({{"muscle", mesh}}, {}, {}, silent);
    EXPECT_NO_THROW(check_surface(prepared.muscles[0], 1, SurfaceRole::muscle, "muscle"));
    EXPECT_EQ(prepared.report.muscles[0].self_intersections_after, 0);
  }
}

TEST(Preparation, leaves_muscles_as_they_were_where_they_cannot_be_pulled_apart) {
  // A thin slab halfway into a bone with room on neither side.
  const TriangleMesh slab = shapes::box(Vec3(-20, -20, -3) * mm, Vec3(20, 20, 3) * mm);
  const TriangleMesh below = shapes::box(Vec3(-40, -40, -30) * mm, Vec3(40, 40, -0.2) * mm);
  const TriangleMesh above = shapes::box(Vec3(-40, -40, 2) * mm, Vec3(40, 40, 30) * mm);
  PrepareSettings settings;
  const PreparedSurfaces prepared =
      prepare_surfaces({{"slab", slab}}, {{"below", below}, {"above", above}}, settings, silent);
  const PreparedMuscleReport& muscle = prepared.report.muscles[0];
  EXPECT_TRUE(is_solid(prepared.muscles[0]));
  EXPECT_LT(muscle.volume_after, 1.06 * muscle.volume_before);
  EXPECT_LE(muscle.max_displacement, 2 * 3.2 * mm);
}

TEST(PreparedHip, has_no_intersections_at_rest_and_keeps_its_shapes) {
  const std::filesystem::path scene_file =
      std::filesystem::path(build_paths::source_folder) / "scenes/lhdl_hip_prepared/hip.toml";
  const std::filesystem::path data = find_data_root(scene_file, {});
  if (data.empty() || !std::filesystem::is_directory(data / "lhdl-hip"))
    GTEST_SKIP() << "the cadaver's data are not here: set GRACILIS_DATA, or put them into ../shared/data";
  SceneOptions options;
  options.data = data;
  options.prepare = prepare_surfaces;
  const SceneSurfaces raw = read_scene_surfaces(scene_file, options);
  const Scene scene = read_scene(scene_file, options).scene;
  ASSERT_EQ(scene.muscles.size(), 5u);
  std::vector<const TriangleMesh*> all, as_read;
  for (const Muscle& muscle : scene.muscles) all.push_back(&muscle.surface);
  for (const NamedSurface& muscle : raw.muscles) as_read.push_back(&muscle.mesh);
  for (const Bone& bone : scene.bones) all.push_back(&bone.surface), as_read.push_back(&bone.surface);
  const auto of_muscles = [](const std::vector<FacePair>& pairs) {
    return std::count_if(pairs.begin(), pairs.end(), [](const FacePair& pair) { return pair.mesh_a < 5; });
  };
  EXPECT_GT(of_muscles(intersecting_faces(as_read)), 500);  // the test would see them
  EXPECT_EQ(of_muscles(intersecting_faces(all)), 0);
  for (std::size_t m = 0; m < 5; ++m) {
    const TriangleMesh& now = scene.muscles[m].surface;
    const NearestTriangle before(raw.muscles[m].mesh);
    Real farthest = 0;
    for (Index v = 0; v < now.vertex_count(); ++v)
      farthest = std::max(farthest, before.query(now.vertices.col(v)).distance);
    EXPECT_LT(farthest, 5 * mm) << scene.muscles[m].name;
    const Real volume = enclosed_volume(raw.muscles[m].mesh.vertices, raw.muscles[m].mesh.faces);
    EXPECT_NEAR(enclosed_volume(now.vertices, now.faces) / volume, 1, 0.05) << scene.muscles[m].name;
  }
}

}  // namespace
}  // namespace gracilis
