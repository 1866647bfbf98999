#pragma once

#include <gracilis/anatomy/attachments/body_carriers.hpp>
#include <gracilis/scene/pose.hpp>
#include <gracilis/scene/scene.hpp>

namespace gracilis {

/// A muscle that came as a surface, without an action line: sections across the line through its middle, which a blend
/// of the bodies' motions carries (this project's own; Laclé 2014 has a model's line). Never changes.
struct SurfaceSections {
  Points rest;               ///< of the surface, world, in the capture pose, m
  BodyCarriers carriers;     ///< of the surface
  BodyCarriers of_line;      ///< the same of the sections' centers
  Points centers;            ///< in the capture pose, m; none: the bodies carry the surface
  Eigen::Matrix3Xd normals;  ///< of the sections, unit
  Eigen::VectorXd spacing;   ///< m, what belongs to each section of the line
  Eigen::VectorXd places;    ///< per vertex: 0 in the first section to n - 1 in the last
};

/// Places follow the harmonic field from origin to insertion, such that equal parts of the surface lie between
/// sections; a section's center is the middle of the surface about it. A muscle without origin and insertion has no
/// sections.
SurfaceSections surface_sections(const Muscle& muscle);

/// The surface in this pose, 3 × vertices, m: each vertex keeps its place in the axes of the two sections that it lies
/// between. Sections turn with the line and, within the fifth of them that is nearest to an end, more and more with the
/// bodies; they grow as their neighbors come closer, so that what lies between them keeps its volume. Attached vertices
/// go exactly with their bodies.
Points surface_at(const SurfaceSections& sections, const Pose& pose);

/// Half of the way to each neighbor, m; 3 × n points of a line.
Eigen::VectorXd spacing_of(const Points& centers);

}  // namespace gracilis
