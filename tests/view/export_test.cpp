#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/view/export/export_gltf.hpp>
#include <gracilis/view/export/export_tables.hpp>

#include "view/recorded_runs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>

#include <tiny_gltf.h>

#include <cstring>

using namespace gracilis;
using testing::ElementsAre;

namespace {

tinygltf::Model read_glb(const std::filesystem::path& path) {
  tinygltf::TinyGLTF reader;
  tinygltf::Model model;
  std::string error, warning;
  EXPECT_TRUE(reader.LoadBinaryFromFile(&model, &error, &warning, path.string())) << error;
  EXPECT_EQ(error + warning, "");
  return model;
}

/// An accessor's floats, one column per element.
Eigen::MatrixXf floats(const tinygltf::Model& model, int accessor) {
  const tinygltf::Accessor& a = model.accessors.at(static_cast<std::size_t>(accessor));
  const tinygltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(a.bufferView));
  Eigen::MatrixXf result(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type)),
                         static_cast<Eigen::Index>(a.count));
  std::memcpy(result.data(), model.buffers.at(0).data.data() + view.byteOffset + a.byteOffset,
              static_cast<std::size_t>(result.size()) * sizeof(float));
  return result;
}

const tinygltf::Node& node_of(const tinygltf::Model& model, const std::string& name) {
  for (const tinygltf::Node& node : model.nodes)
    if (node.name == name) return node;
  throw std::runtime_error("no node " + name);
}

const tinygltf::AnimationSampler& sampler_of(const tinygltf::Model& model, const std::string& node,
                                             const std::string& path) {
  const tinygltf::Animation& animation = model.animations.at(0);
  for (const tinygltf::AnimationChannel& channel : animation.channels)
    if (model.nodes.at(static_cast<std::size_t>(channel.target_node)).name == node && channel.target_path == path)
      return animation.samplers.at(static_cast<std::size_t>(channel.sampler));
  throw std::runtime_error("no channel " + node + " " + path);
}

}  // namespace

TEST(ExportGltf, a_viewer_that_adds_weighted_targets_gets_the_recorded_shapes_back) {
  const TestFolder folder;
  const FlexingLeg leg(7);
  export_gltf(leg.written(folder.path() / "run"), folder.path() / "run.glb");
  const tinygltf::Model model = read_glb(folder.path() / "run.glb");
  const tinygltf::Primitive& shape =
      model.meshes.at(static_cast<std::size_t>(node_of(model, "gluteus_maximus_r").mesh)).primitives.at(0);
  const tinygltf::AnimationSampler& sampler = sampler_of(model, "gluteus_maximus_r", "weights");
  const Eigen::MatrixXf times = floats(model, sampler.input), weights = floats(model, sampler.output);
  ASSERT_EQ(times.cols(), 7);
  ASSERT_EQ(shape.targets.size(), 6u);
  ASSERT_EQ(weights.cols(), 7 * 6);
  for (int frame = 0; frame < 7; ++frame) {
    Eigen::MatrixXf points = floats(model, shape.attributes.at("POSITION"));
    for (int target = 0; target < 6; ++target)
      points += weights(0, frame * 6 + target) *
                floats(model, shape.targets.at(static_cast<std::size_t>(target)).at("POSITION"));
    EXPECT_LT((points.cast<Real>() - leg.record(frame).frame.muscles[0].points).cwiseAbs().maxCoeff(), 1e-6) << frame;
  }
}

TEST(ExportGltf, bones_turn_and_the_subject_stands_upright) {
  const TestFolder folder;
  const FlexingLeg leg(7);
  export_gltf(leg.written(folder.path() / "run"), folder.path() / "run.glb");
  const tinygltf::Model model = read_glb(folder.path() / "run.glb");
  const Eigen::MatrixXf turns = floats(model, sampler_of(model, "femur_r", "rotation").output);
  const Eigen::Quaternionf last(turns(3, 6), turns(0, 6), turns(1, 6), turns(2, 6));
  EXPECT_NEAR(last.angularDistance(
                  Eigen::Quaternionf(Eigen::AngleAxisf(static_cast<float>(radians(18)), Eigen::Vector3f::UnitZ()))),
              0, 1e-5);
  const std::vector<double>& q = node_of(model, "flexing_leg").rotation;
  const Eigen::Quaterniond upright(q.at(3), q.at(0), q.at(1), q.at(2));
  EXPECT_TRUE((upright * leg.scene.axes.superior).isApprox(Vec3::UnitY(), 1e-9));
  EXPECT_TRUE((upright * leg.scene.axes.anterior).isApprox(Vec3::UnitZ(), 1e-9));
}

TEST(ExportGltf, a_run_kilometres_away_keeps_its_shapes_and_stands_there) {
  const TestFolder folder;
  FlexingLeg leg(2);
  const Vec3 far_away(5000.3, -3000.7, 8000.1);
  for (Muscle& muscle : leg.scene.muscles) muscle.surface.vertices.colwise() += far_away;
  for (Bone& bone : leg.scene.bones) bone.surface.vertices.colwise() += far_away;
  export_gltf(leg.written(folder.path() / "run"), folder.path() / "run.glb");
  const tinygltf::Model model = read_glb(folder.path() / "run.glb");
  const tinygltf::Node& root = node_of(model, "flexing_leg");
  const Eigen::Quaterniond turn(root.rotation.at(3), root.rotation.at(0), root.rotation.at(1), root.rotation.at(2));
  const tinygltf::Primitive& shape =
      model.meshes.at(static_cast<std::size_t>(node_of(model, "gluteus_maximus_r").mesh)).primitives.at(0);
  const Points points = floats(model, shape.attributes.at("POSITION")).cast<Real>();
  const Points rest = leg.scene.muscles[0].surface.vertices;
  for (Index v = 0; v < points.cols(); ++v)
    EXPECT_LT((turn * points.col(v) + Eigen::Map<const Vec3>(root.translation.data()) - turn * rest.col(v)).norm(),
              1e-6);
}

TEST(ExportGltf, keeps_to_the_frames_and_vertices_that_are_asked_for) {
  const TestFolder folder;
  AnimationOptions options;
  options.frames = 5;
  options.muscle_vertices = 100;
  export_gltf(FlexingLeg(21).written(folder.path() / "run"), folder.path() / "run.glb", options);
  const tinygltf::Model model = read_glb(folder.path() / "run.glb");
  const tinygltf::Primitive& shape =
      model.meshes.at(static_cast<std::size_t>(node_of(model, "gluteus_medius_r").mesh)).primitives.at(0);
  EXPECT_LE(shape.targets.size(), 4u);
  EXPECT_LT(floats(model, shape.attributes.at("POSITION")).cols(), 200);
}

TEST(SpreadFrames, keep_the_first_and_the_last) {
  EXPECT_THAT(spread_frames(1, 5), ElementsAre(0));
  EXPECT_THAT(spread_frames(4, 5), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(spread_frames(11, 3), ElementsAre(0, 5, 10));
  for (int count = 2; count < 200; ++count) {
    EXPECT_LE(spread_frames(count, 7).size(), 7u) << count;
    EXPECT_EQ(spread_frames(count, 7).back(), count - 1);
  }
}

TEST(ExportObj, is_read_back_with_all_surfaces_of_the_frame) {
  const TestFolder folder;
  const FlexingLeg leg(3);
  export_obj(leg.written(folder.path() / "run"), folder.path() / "obj", {2});
  const TriangleMesh all = read_mesh(folder.path() / "obj/frame_0002.obj", 1);
  const Points last = leg.scene.muscles[1].surface.vertices;
  EXPECT_EQ(all.vertex_count(),
            leg.scene.bones[0].surface.vertex_count() + leg.scene.muscles[0].surface.vertex_count() + last.cols());
  EXPECT_TRUE(all.vertices.rightCols(last.cols()).isApprox(last, 1e-7));
  EXPECT_EQ(all.faces.rightCols(1).maxCoeff() < all.vertex_count(), true);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "obj/frame_0001.obj"));
}

TEST(ExportObj, tells_less_than_a_micrometre_kilometres_away) {
  const TestFolder folder;
  FlexingLeg leg(1);
  leg.scene.muscles[1].surface.vertices.colwise() += Vec3(5000.3, -3000.7, 8000.1);
  export_obj(leg.written(folder.path() / "run"), folder.path() / "obj", {0});
  const Points last = leg.scene.muscles[1].surface.vertices;
  const TriangleMesh all = read_mesh(folder.path() / "obj/frame_0000.obj", 1);
  EXPECT_LT((all.vertices.rightCols(last.cols()) - last).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ExportCsv, holds_the_tables_and_the_points_that_are_asked_for) {
  const TestFolder folder;
  const FlexingLeg leg(3);
  const RecordedRun run = leg.written(folder.path() / "run");
  export_csv(run, folder.path() / "csv", {1});
  const Table lengths = read_table(folder.path() / "csv/fiber_lengths.csv");
  EXPECT_EQ(lengths.columns, read_table(run.folder / "fiber_lengths.sto").columns);
  EXPECT_TRUE(lengths.values.isApprox(read_table(run.folder / "fiber_lengths.sto").values, 1e-7));
  std::ifstream points(folder.path() / "csv/points_gluteus_maximus_r.csv");
  std::string line;
  int lines = 0;
  while (std::getline(points, line)) ++lines;
  EXPECT_EQ(lines, 1 + leg.scene.muscles[0].surface.vertex_count());
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "csv/measures.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "csv/corrections.csv"));
}

TEST(ExportCsv, tells_how_far_each_kind_of_constraint_moved_a_muscle_where_the_run_knows_it) {
  const TestFolder folder;
  FlexingLeg leg(3);
  leg.corrects = true;
  export_csv(leg.written(folder.path() / "run"), folder.path() / "csv", {});
  std::stringstream text;
  text << std::ifstream(folder.path() / "csv/corrections.csv").rdbuf();
  EXPECT_EQ(text.str(),
            "frame,muscle,kind,mean_mm,largest_mm\n"
            "1,gluteus_maximus_r,bone contact,1,1\n1,gluteus_maximus_r,distance,0.2,0.2\n"
            "2,gluteus_maximus_r,bone contact,1,1\n2,gluteus_maximus_r,distance,0.2,0.2\n");
}
