#pragma once

#include <gracilis/scene/frame.hpp>
#include <gracilis/scene/scene.hpp>

/// Scenes that stand elsewhere.
namespace gracilis {

inline Points moved(const RigidTransform& by, const Points& points) {
  return (by.linear() * points).colwise() + by.translation();
}

inline void move_line(const RigidTransform& by, ActionLine& line) {
  line.points = moved(by, line.points);
  line.centers = moved(by, line.centers);
  for (LinePoint& point : line.path.points) {
    point.place = by * point.place;
    point.frame = by * point.frame;
  }
  for (PlacedWrap& wrap : line.path.wraps) wrap.frame = by * wrap.frame;
}

/// The same scene, all of it turned and shifted.
inline Scene moved(const RigidTransform& by, Scene scene) {
  for (Bone& bone : scene.bones) bone.surface.vertices = moved(by, bone.surface.vertices);
  for (Joint& joint : scene.joints) joint.frame = by * joint.frame;
  for (Muscle& muscle : scene.muscles) {
    muscle.surface.vertices = moved(by, muscle.surface.vertices);
    muscle.given_fibers.points = moved(by, muscle.given_fibers.points);
    for (Aponeurosis& each : muscle.aponeuroses) each.surface.vertices = moved(by, each.surface.vertices);
    muscle.tracts.points = moved(by, muscle.tracts.points);
    muscle.given_surface_fibers.points = moved(by, muscle.given_surface_fibers.points);
    move_line(by, muscle.action_line);
  }
  scene.axes.anterior = by.linear() * scene.axes.anterior;
  scene.axes.superior = by.linear() * scene.axes.superior;
  return scene;
}

}  // namespace gracilis
