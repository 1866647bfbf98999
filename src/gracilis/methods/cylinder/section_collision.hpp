#pragma once

#include <gracilis/anatomy/sections/section_rings.hpp>
#include <gracilis/geometry/triangle_tree.hpp>
#include <gracilis/scene/scene.hpp>

#include <functional>
#include <vector>

namespace gracilis {

/// Sections that give way to each other and to bones (Laclé 2014, chapter 4).

/// How far two sections joined by a transversal lie in each other, m: at each end where the angle between the
/// transversal and the direction to the section's own center is acute, the transversal's projection on that direction.
Real transversal_depth(const SectionRings& moved, const SectionCorner& corner, const SectionRings& other,
                       const SectionCorner& other_corner);

/// Moves the section's center, and its corners with it, along the direction from the tagged corner to the center,
/// where the depth exceeds that radius, so that it lies `depth` from where the corner was (eq. 4.4).
bool yield_to_transversal(SectionRings& rings, const SectionCorner& corner, Real depth);

/// Whether a segment cuts an obstacle.
using Obstacle = std::function<bool(const Vec3& a, const Vec3& b)>;

/// The surface of another muscle's sections as it is now: every triangle is tried whose box the segment's box meets
/// (Möller and Trumbore 1997).
Obstacle obstacle_of(const SectionRings& rings);

/// What a section remembers from round to round: how it was before, per ray whether it is held, and how far obstacles
/// have moved its center.
struct YieldingSection {
  YieldingSection(const SectionRings& rings, Index section);

  Real area = 0;          // m²
  Eigen::VectorXd radii;  // m
  std::vector<bool> fixed;
  Vec3 pushed = Vec3::Zero();  // m
};

/// One round for one section: where the way from a corner to the next one cuts the obstacle both radii shrink by a
/// tenth and are fixed; where one is nearly spent (5 % of what it was), or the way to the next corner of the following
/// section cuts it, the center moves by a tenth of the opposite radius. Returns whether anything was cut.
bool yield_to_obstacle(SectionRings& rings, Index section, const Obstacle& cuts, YieldingSection& state);

/// Moves the center back to where no obstacle had moved it: of a section that does not come free, for what it meets
/// beside the following section it would meet however far it goes.
void take_back(SectionRings& rings, Index section, YieldingSection& state);

/// Scales the free radii alike so that the section has `area` (m²) again; at most to three times their length.
void inflate(SectionRings& rings, Index section, Real area, const std::vector<bool>& fixed);

}  // namespace gracilis
