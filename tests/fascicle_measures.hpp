#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/geometry/triangle_tree.hpp>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <vector>

namespace gracilis {

/// How fibers compare to fascicles that were measured, or are known, in the same muscle.
struct FascicleMeasures {
  Real median_angle = 0, large_angle = 0;     ///< rad; 95 % are below `large_angle`
  Real mean_length = 0, measured_length = 0;  ///< m, of fibers, and of fascicles carried on to the surface
  Real farthest_outside = 0;                  ///< m
};

inline std::ostream& operator<<(std::ostream& out, const FascicleMeasures& m) {
  return out << degrees(m.median_angle) << " degrees off in the median, " << degrees(m.large_angle) << " at 95 %; "
             << 1e3 * m.mean_length << " mm long on average, measured " << 1e3 * m.measured_length
             << " mm; outside by up to " << 1e3 * std::max(0.0, m.farthest_outside) << " mm";
}

/// The pieces of lines: their middles and unit directions.
struct LinePieces {
  Points middles, directions;

  explicit LinePieces(const Polylines& lines) {
    std::vector<Vec3> m, d;
    for (Index l = 0; l < lines.count(); ++l)
      for (Index i = lines.begin(l); i + 1 < lines.end(l); ++i) {
        const Vec3 a = lines.points.col(i), b = lines.points.col(i + 1);
        if (!((b - a).norm() > 0)) continue;
        m.push_back((a + b) / 2), d.push_back((b - a).normalized());
      }
    middles.resize(3, static_cast<Index>(m.size())), directions.resize(3, static_cast<Index>(m.size()));
    for (std::size_t i = 0; i < m.size(); ++i)
      middles.col(static_cast<Index>(i)) = m[i], directions.col(static_cast<Index>(i)) = d[i];
  }
};

/// The length of a fascicle with both of its ends carried straight on to the surface, by at most its length each.
inline Real length_to_surface(const Points& line, const TriangleTree& surface) {
  const Real length = polyline_length(line);
  const Points even = resampled(line, 8);
  Real sum = length;
  for (const bool at_end : {false, true}) {
    const Vec3 end = even.col(at_end ? 8 : 0), before = even.col(at_end ? 6 : 2);
    if (const auto hit = surface.first(end, end + length * (end - before).normalized()))
      sum += (hit->place - end).norm();
  }
  return sum;
}

/// Angles are between a fascicle's pieces and the pieces of fibers nearest to each, whichever way either runs.
inline FascicleMeasures compared(const TriangleMesh& surface, const Polylines& fibers, const Polylines& fascicles) {
  FascicleMeasures result;
  const LinePieces ours(fibers), theirs(fascicles);
  std::vector<Real> angles;
  for (Index i = 0; i < static_cast<Index>(theirs.middles.cols()); ++i) {
    Index nearest = 0;
    (ours.middles.colwise() - theirs.middles.col(i)).colwise().squaredNorm().minCoeff(&nearest);
    angles.push_back(std::acos(std::min(1.0, std::abs(ours.directions.col(nearest).dot(theirs.directions.col(i))))));
  }
  std::sort(angles.begin(), angles.end());
  result.median_angle = angles[angles.size() / 2];
  result.large_angle = angles[angles.size() * 95 / 100];
  for (const Real length : polyline_lengths(fibers)) result.mean_length += length / fibers.count();
  const TriangleTree hits(surface);
  for (Index l = 0; l < fascicles.count(); ++l)
    result.measured_length += length_to_surface(fascicles.line(l), hits) / fascicles.count();
  const SignedDistance distance(surface);
  result.farthest_outside = -1;
  for (Index i = 0; i < static_cast<Index>(fibers.points.cols()); ++i)
    result.farthest_outside = std::max(result.farthest_outside, distance.query(fibers.points.col(i)).distance);
  return result;
}

}  // namespace gracilis
