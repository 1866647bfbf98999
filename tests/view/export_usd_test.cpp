#include <gracilis/view/export/export_usd.hpp>

#include "view/recorded_runs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace gracilis {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string exported(const FlexingLeg& leg, const AnimationOptions& options = {}) {
  const TestFolder folder;
  export_usd(leg.written(folder.path() / "run"), folder.path() / "run.usda", options);
  std::ifstream file(folder.path() / "run.usda");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What follows `mark` in a text.
std::string after(const std::string& text, const std::string& mark) {
  const std::size_t at = text.find(mark);
  if (at == std::string::npos) throw std::runtime_error("no " + mark);
  return text.substr(at + mark.size());
}

/// The text of a prim, to the end of its braces.
std::string prim_of(const std::string& usda, const std::string& type, const std::string& name) {
  const std::string text = after(usda, "def " + type + " \"" + name + "\"");
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '{') ++depth;
    if (text[i] == '}' && --depth == 0) return text.substr(0, i);
  }
  throw std::runtime_error(name + " does not end");
}

/// All numbers of the value that begins a text, up to the end of its brackets.
std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  int depth = 0;
  const char* at = text.c_str();
  while (*at != '\0') {
    if (*at == '[' || *at == '(')
      ++depth, ++at;
    else if (*at == ']' || *at == ')') {
      if (--depth == 0) return numbers;
      ++at;
    } else if (*at == ' ' || *at == ',' || *at == '=' || *at == '\n')
      ++at;
    else {
      char* end = nullptr;
      numbers.push_back(std::strtod(at, &end));
      if (end == at) throw std::runtime_error("no number: " + std::string(at).substr(0, 20));
      at = end;
    }
  }
  throw std::runtime_error("a value does not end");
}

std::vector<double> sample_of(const std::string& prim, const std::string& attribute, int frame) {
  return numbers_of(
      after(after(prim, attribute + ".timeSamples = {"), "\n            " + std::to_string(frame) + ": "));
}

Points points_of(const std::vector<double>& numbers) {
  return Eigen::Map<const Points>(numbers.data(), 3, static_cast<Index>(numbers.size() / 3));
}

/// USD's vectors are rows.
RigidTransform transform_of(const std::vector<double>& rows) {
  RigidTransform transform;
  transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(rows.data());
  return transform;
}

}  // namespace

TEST(ExportUsd, points_of_muscles_in_each_frame_are_those_recorded) {
  const FlexingLeg leg(7);
  const std::string prim = prim_of(exported(leg), "Mesh", "gluteus_maximus_r");
  for (int frame = 0; frame < 7; ++frame) {
    const Points points = points_of(sample_of(prim, "point3f[] points", frame));
    const Points recorded = leg.record(frame).frame.muscles[0].points;
    ASSERT_EQ(points.cols(), recorded.cols());
    EXPECT_LT((points - recorded).cwiseAbs().maxCoeff(), 1e-7) << frame;
    const Points extent = points_of(sample_of(prim, "float3[] extent", frame));
    EXPECT_LT((extent.col(1) - points.rowwise().maxCoeff()).norm(), 1e-7);
  }
  const std::vector<double> faces = numbers_of(after(prim, "faceVertexIndices ="));
  EXPECT_EQ(static_cast<Index>(faces.size()), leg.scene.muscles[0].surface.faces.size());
  EXPECT_EQ(numbers_of(after(prim, "faceVertexCounts =")).size() * 3, faces.size());
}

TEST(ExportUsd, bones_turn_and_the_subject_stands_upright) {
  const FlexingLeg leg(7);
  const std::string usda = exported(leg);
  const RigidTransform last =
      transform_of(sample_of(prim_of(usda, "Mesh", "femur_r"), "matrix4d xformOp:transform", 6));
  EXPECT_TRUE(last.isApprox(leg.poses[6].bodies[1], 1e-6)) << last.matrix();
  const RigidTransform upright = transform_of(numbers_of(after(usda, "matrix4d xformOp:transform =")));
  EXPECT_TRUE((upright * leg.scene.axes.superior).isApprox(Vec3::UnitY(), 1e-6));
  EXPECT_TRUE((upright * leg.scene.axes.anterior).isApprox(Vec3::UnitZ(), 1e-6));
  EXPECT_THAT(usda, HasSubstr("upAxis = \"Y\""));
  EXPECT_THAT(usda, HasSubstr("endTimeCode = 6\n"));
}

TEST(ExportUsd, fibers_are_curves_with_as_many_points_as_recorded) {
  const FlexingLeg leg(3);
  const std::string prim = prim_of(exported(leg), "BasisCurves", "gluteus_maximus_r_fibers");
  EXPECT_EQ(sample_of(prim, "int[] curveVertexCounts", 2), std::vector<double>{3});
  const Points points = points_of(sample_of(prim, "point3f[] points", 2));
  EXPECT_LT((points - leg.record(2).fibers[0].lines.points).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(ExportUsd, a_run_kilometres_away_keeps_its_shapes_and_stands_there) {
  FlexingLeg leg(2);
  for (Muscle& muscle : leg.scene.muscles) muscle.surface.vertices.colwise() += Vec3(5000.3, -3000.7, 8000.1);
  for (Bone& bone : leg.scene.bones) bone.surface.vertices.colwise() += Vec3(5000.3, -3000.7, 8000.1);
  const std::string usda = exported(leg);
  const RigidTransform root = transform_of(numbers_of(after(usda, "matrix4d xformOp:transform =")));
  const Points points = points_of(sample_of(prim_of(usda, "Mesh", "gluteus_maximus_r"), "point3f[] points", 0));
  EXPECT_LT(points.cwiseAbs().maxCoeff(), 1);
  const Points& rest = leg.scene.muscles[0].surface.vertices;
  for (Index v = 0; v < points.cols(); ++v)
    EXPECT_LT((root * Vec3(points.col(v)) - root.linear() * rest.col(v)).norm(), 1e-4);
}

TEST(ExportUsd, names_that_no_prim_may_have_become_ones_it_may_and_stay_apart) {
  FlexingLeg leg(2);
  leg.scene.name = "leg \"left\"";
  leg.scene.muscles[0].name = "1st-head";
  leg.scene.muscles[1].name = "1st_head";
  const std::string usda = exported(leg);
  EXPECT_THAT(usda, HasSubstr("def Mesh \"_1st_head\""));
  EXPECT_THAT(usda, HasSubstr("def Mesh \"_1st_head_2\""));
  EXPECT_THAT(usda, HasSubstr("gracilis:name = \"1st-head\""));
  EXPECT_THAT(usda, HasSubstr("gracilis:name = \"1st_head\""));
  EXPECT_THAT(usda, HasSubstr("doc = \"leg \\\"left\\\", written by Gracilis\""));
}

TEST(ExportUsd, keeps_to_the_frames_and_vertices_that_are_asked_for) {
  AnimationOptions options;
  options.frames = 3;
  options.muscle_vertices = 100;
  const std::string usda = exported(FlexingLeg(21), options);
  EXPECT_THAT(usda, HasSubstr("endTimeCode = 2\n"));
  EXPECT_THAT(prim_of(usda, "Mesh", "gluteus_maximus_r"), Not(HasSubstr("\n            3: ")));
  EXPECT_LE(points_of(sample_of(prim_of(usda, "Mesh", "gluteus_maximus_r"), "point3f[] points", 0)).cols(), 110);
}

}  // namespace gracilis
