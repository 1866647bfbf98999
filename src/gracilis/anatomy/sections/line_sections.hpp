#pragma once

#include <gracilis/geometry/section_frames.hpp>
#include <gracilis/scene/pose.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// A muscle's sections across its action line, which moves with its bodies (Laclé 2014): always as many, wherever the
/// line runs.
struct LineSections {
  ActionLine line;
  Real length = 0;                 ///< m, of the line in the capture pose
  std::vector<Real> places;        ///< m along it, of each section
  Vec3 first_ray = Vec3::UnitX();  ///< of the first section, in the capture pose
};

/// Of a line, or of a head of a sheet; the first ray leads from the first section's center to this corner of it.
LineSections line_sections(const ActionLine& line, const Vec3& first_corner);

/// Precondition: the muscle has an action line of which its surface was made, and that is one line.
LineSections line_sections(const Muscle& muscle);

/// The section that a vertex of a surface of so many sections belongs to; the two that close the ends belong to theirs.
Index section_of_vertex(Index vertex, Index sections, Index rays);

/// How far a section is from the nearest tendon, along the line in the capture pose, m: 0 or less in one, whose
/// sections keep their distance from the line's end; infinite where there is none.
Real distance_from_tendon(const LineSections& sections, Index section);

/// Where sections are, and their axes: first ray, the direction across it in the plane, the normal.
struct PlacedSections {
  Points centers;
  SectionFrames frames;

  RigidTransform frame(Eigen::Index k) const;  ///< from the axes of section k to the world
};

/// On the line as it runs in this pose (line_at). In the tendons, which keep their lengths, sections keep their
/// distance from the line's ends; elsewhere their share of the rest.
PlacedSections sections_at(const LineSections& sections, const Pose& pose);

}  // namespace gracilis
