#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/io/scene/data_root.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/prepare_surfaces.hpp>

#include <build_paths.hpp>

#include "shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
