#pragma once

#include <gracilis/anatomy/sections/sheet.hpp>
#include <gracilis/scene/pose.hpp>
#include <gracilis/scene/scene.hpp>

namespace gracilis {

/// A sheet over the lines of several heads, carried by all of them. Never changes.
struct SheetSections {
  std::vector<LineSections> lines;  ///< of each head
  std::vector<LineShare> shares;    ///< per vertex
  Index rays = 0;
  std::vector<Points> places;  ///< of all vertices, in the axes of each line's sections
  Eigen::VectorXd volumes;     ///< m³, what belongs to each section in the capture pose
  Eigen::Matrix3Xi faces;
  Real volume = 0;  ///< m³, of the whole
};

/// Precondition: the muscle's action line has heads.
SheetSections sheet_sections(const Muscle& muscle, const Pose& capture);

/// The muscle's vertices in a pose, m: each between where the sections of its two heads take it. Sections of the belly
/// are as thick as keeps what belongs to them its volume, and the whole, by twice or half at most; how wide they are is
/// up to the lines.
Points sheet_at(const SheetSections& sheet, const Pose& pose);

}  // namespace gracilis
