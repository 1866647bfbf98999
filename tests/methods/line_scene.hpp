#pragma once

#include <gracilis/anatomy/sections/cylinder_surface.hpp>
#include <gracilis/geometry/section_frames.hpp>
#include <gracilis/scene/scene.hpp>

#include <shapes.hpp>

#include <cmath>

namespace gracilis {

/// Two bones with a hinge about y at the origin, a slide along z, and a muscle of sections in front of them.
inline Scene line_scene(Real tendon) {
  Scene scene;
  scene.name = "line";
  scene.method.name = "cylinder";
  scene.bodies = {"upper", "lower"};
  scene.bones = {{"upper", 0, shapes::box({-0.015, -0.03, 0.005}, {0.015, 0.03, 0.1})},
                 {"lower", 1, shapes::box({-0.015, -0.03, -0.1}, {0.015, 0.03, -0.005})}};
  JointAxis slide{"slide", Vec3::UnitZ(), 0, -1, 1};
  slide.translation = true;
  scene.joints = {{"hinge", 0, 1, RigidTransform::Identity(), {{"flexion", Vec3::UnitY(), 0, -2, 2}, slide}}};
  Muscle muscle;
  muscle.name = "line";
  ActionLine& line = muscle.action_line;
  line.points.resize(3, 3);
  line.points << 0.03, 0.04, 0.03, 0, 0, 0, 0.1, 0.02, -0.1;
  line.bodies = {0, 0, 1};
  line.rays = 8;
  line.scaling = 3;
  line.tendon = tendon;
  const Points centers = subdivide_line(line.points, line.scaling);
  Eigen::MatrixXd radii(8, centers.cols());
  for (Index k = 0; k < centers.cols(); ++k)
    for (Index i = 0; i < 8; ++i) radii(i, k) = 0.004 + 0.0005 * (i % 3) + 0.005 * std::sin(pi * k / 16.0);
  muscle.surface = {section_vertices(centers, section_frames(centers, Vec3::UnitY()), radii),
                    section_faces(static_cast<Index>(centers.cols()), 8)};
  muscle.attachments = {{"o", AttachmentEnd::origin, 0, {0, 1, 2}}, {"i", AttachmentEnd::insertion, 1, {128, 129}}};
  scene.muscles = {muscle};
  return scene;
}

}  // namespace gracilis
