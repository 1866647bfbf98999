#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/section_map.hpp>
#include <gracilis/scene/scene.hpp>

#include <functional>
#include <vector>

namespace gracilis {

/// A muscle cut into cross-sections from origin to insertion, on which a template of fibers can be mapped.
struct Sections {
  std::vector<SectionMap> maps;
  std::vector<Real> shares;  ///< per section: its share of the way from origin to insertion, in (0, 1), ascending
  std::vector<Real> levels;  ///< per section: the value of the harmonic field
  Real slenderness = 1;      ///< length over width along the first axis of the unit square
  int left_out = 0;          ///< levels whose contour is not one closed line around the muscle
};

/// The harmonic field on the muscle's surface that is 0 on its origin and 1 on its insertion, per vertex.
Eigen::VectorXd origin_to_insertion(const Muscle& muscle);

/// Cuts a muscle along isocontours of `origin_to_insertion` (template
/// decomposition, Kohout and Kukačka 2014). The levels have equal areas of surface between them. A consistent angular
/// parameter runs around all contours: each begins where its points come nearest to those of the contour before.
/// Between contours that lie farther apart than half of their girth, as on thin tendons, there are more, unless fibers
/// are smoothed without a limit. Levels with a second contour longer than a quarter of the first, such as between two
/// heads, are left out.
Sections cut_into_sections(const Muscle& muscle, int levels = 32);

/// The fibers of a muscle by template decomposition: `muscle.fibers.count` lines of `muscle.fibers.segments` pieces.
/// Each starts in the origin, passes its template's point in every section, ends in the insertion, and stays inside.
/// The ends spread evenly over the attachments; which fiber goes to which is the assignment with the least sum of
/// squared distances. Smoothed with their ends in place, by little where their bundle is thin. Deterministic for any
/// number of threads. Requires an origin and an insertion; empty when the count is 0.
Polylines inner_fibers(const Muscle& muscle);

/// Where a fiber that starts at a point of the unit square passes a section (by its number).
using FiberCourse = std::function<Eigen::Vector2d(const Eigen::Vector2d& start, std::size_t section)>;

/// The same along courses other than a template's.
Polylines fibers_through(const Muscle& muscle, const Sections& sections, const FiberCourse& course);

}  // namespace gracilis
