#pragma once

#include <gracilis/core/types.hpp>

#include <vector>

namespace gracilis {

/// Open lines through points, one after the other: line i has the points offsets[i] ... offsets[i + 1] - 1.
struct Polylines {
  Points points;                     ///< 3 × n, m
  std::vector<Index> offsets = {0};  ///< one more than there are lines

  Index count() const { return static_cast<Index>(offsets.size()) - 1; }               ///< of lines
  Index begin(Index line) const { return offsets[static_cast<std::size_t>(line)]; }    ///< column of its first point
  Index end(Index line) const { return offsets[static_cast<std::size_t>(line) + 1]; }  ///< column after its last point
  Index size(Index line) const { return end(line) - begin(line); }                     ///< of its points
  /// The points of one line, 3 × its size.
  Points line(Index line) const { return points.middleCols(begin(line), size(line)); }
  void append(const Points& line);  ///< as the last one; 3 × its points
};

/// All lines in one, in their order.
Polylines join(const std::vector<Points>& lines);

/// At most `most` of the numbers 0 .. all - 1, evenly spread over them.
std::vector<Index> spread_numbers(Index all, Index most);

/// At most `most` of the lines, evenly spread over their numbers.
Polylines spread_lines(const Polylines& lines, Index most);

/// Sum of the lengths of a line's segments, m.
Real polyline_length(const Points& line);

/// The length of every line, m.
std::vector<Real> polyline_lengths(const Polylines& lines);

/// How far a point is from the nearest of a line's segments, m; infinite without any.
Real distance_to_polyline(const Points& line, const Vec3& p);

/// How far along the line each of its points is, m; 0 for the first.
std::vector<Real> distances_along(const Points& line);

/// The points of a line at these distances from its beginning (m, ascending); beyond an end, that end. Precondition: at
/// least one point.
Points points_along(const Points& line, const std::vector<Real>& distances);

/// A line of `segments` pieces between points at equal distances along the given one; first and last stay. A single
/// point is repeated. Preconditions: at least one point, segments > 0.
Points resampled(const Points& line, Index segments);

/// A centripetal Catmull-Rom spline through the points (Yuksel et al. 2011), `pieces` points per span and the last
/// one: it passes through every given point, is continuously differentiable, and has neither loops nor cusps between
/// two of them. Coinciding neighbors are merged. The ends are those given. Preconditions: at least one point, pieces >
/// 0.
Points centripetal_spline(const Points& knots, Index pieces);

}  // namespace gracilis
