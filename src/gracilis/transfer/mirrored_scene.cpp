#include <gracilis/transfer/mirrored_scene.hpp>

#include <gracilis/geometry/mirrored_mesh.hpp>

#include <array>

namespace gracilis {
namespace {

constexpr std::array<std::array<const char*, 2>, 4> sides = {
    {{"r", "l"}, {"right", "left"}, {"R", "L"}, {"Right", "Left"}}};

std::string other_side_word(const std::string& word) {
  for (const auto& [one, other] : sides) {
    if (word == one) return other;
    if (word == other) return one;
  }
  return word;
}

void mirror_frame(RigidTransform& frame, const Eigen::Matrix3d& mirror) {
  frame.linear() = mirror * frame.linear() * mirror;
  frame.translation() = mirror * frame.translation();
}

void mirror_line(ActionLine& line, const Eigen::Matrix3d& mirror) {
  line.points = mirror * line.points;
  line.centers = mirror * line.centers;
  line.path.wraps.clear();
  for (LinePoint& point : line.path.points) point.place = mirror * point.place;
  for (ActionLine& head : line.heads) {
    head.name = other_side_name(head.name);
    mirror_line(head, mirror);
  }
}

}  // namespace

std::string other_side_name(const std::string& name) {
  std::string result, word;
  const auto finish = [&] {
    // A single letter at the beginning is no side.
    result += result.empty() && word.size() == 1 ? word : other_side_word(word);
    word.clear();
  };
  for (const char c : name) {
    if (c != '_' && c != '.' && c != ' ' && c != '-') {
      word += c;
      continue;
    }
    finish();
    result += c;
  }
  finish();
  return result;
}

Scene mirrored_scene(Scene scene) {
  const Vec3 across = scene.axes.right().normalized();
  const Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity() - 2 * across * across.transpose();
  for (std::string& body : scene.bodies) body = other_side_name(body);
  for (Bone& bone : scene.bones) {
    bone.name = other_side_name(bone.name);
    bone.surface = mirrored(bone.surface, across);
  }
  for (Joint& joint : scene.joints) {
    joint.name = other_side_name(joint.name);
    mirror_frame(joint.frame, mirror);
    for (JointAxis& axis : joint.axes) {
      axis.coordinate = other_side_name(axis.coordinate);
      // A mirror turns a rotation around, and its axis with it.
      axis.axis = (axis.translation ? 1 : -1) * (mirror * axis.axis);
    }
  }
  for (Muscle& muscle : scene.muscles) {
    muscle.name = other_side_name(muscle.name);
    muscle.surface = mirrored(muscle.surface, across);
    for (Aponeurosis& sheet : muscle.aponeuroses) sheet.surface = mirrored(sheet.surface, across);
    for (Polylines* lines : {&muscle.given_fibers, &muscle.tracts, &muscle.given_surface_fibers})
      lines->points = mirror * lines->points;
    mirror_line(muscle.action_line, mirror);
  }
  for (MuscleBody& body : scene.muscle_bodies) body.center = mirror * body.center;
  for (std::string& coordinate : scene.motion.coordinates) coordinate = other_side_name(coordinate);
  return scene;
}

}  // namespace gracilis
