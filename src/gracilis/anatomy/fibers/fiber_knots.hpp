#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/section_map.hpp>

#include <vector>

namespace gracilis {

/// Per section, and at both ends as in the section beside them: 1/m² across a bundle's width and its thickness, by half
/// of each; nothing along the fibers.
std::vector<Eigen::Matrix3d> inverse_extents(const std::vector<SectionMap>& sections);

/// A fiber's points in sections and its two ends, with the `inverse_extents` there.
struct FiberKnots {
  Points line;
  std::vector<Eigen::Matrix3d> extents;
};

/// Without points from which a fiber would turn back: beside attached areas that lie along a muscle contours go past
/// where fibers end, or around these areas. The ends stay.
FiberKnots without_turning_back(const FiberKnots& all);

/// What keeps smoothing (smooth_inside) from moving a fiber by more than the share `reach` of half of its bundle's
/// width and thickness: one limit for each of `count` points, 2 or more, with equal ways between them.
std::vector<Eigen::Matrix3d> smoothing_limits(const FiberKnots& knots, Real reach, Index count);

}  // namespace gracilis
