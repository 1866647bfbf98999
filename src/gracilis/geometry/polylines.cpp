#include <gracilis/geometry/polylines.hpp>

#include <gracilis/geometry/point_segment.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gracilis {

void Polylines::append(const Points& line) {
  const Eigen::Index before = points.cols();
  points.conservativeResize(3, before + line.cols());
  points.rightCols(line.cols()) = line;
  offsets.push_back(static_cast<Index>(points.cols()));
}

Polylines join(const std::vector<Points>& lines) {
  Polylines joined;
  for (const Points& line : lines) joined.offsets.push_back(joined.offsets.back() + static_cast<Index>(line.cols()));
  joined.points.resize(3, joined.offsets.back());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    joined.points.middleCols(joined.offsets[i], lines[i].cols()) = lines[i];
  }
  return joined;
}

std::vector<Index> spread_numbers(Index all, Index most) {
  std::vector<Index> numbers;
  const Index count = std::min(all, most);
  for (Index i = 0; i < count; ++i) numbers.push_back(i * all / count);
  return numbers;
}

Polylines spread_lines(const Polylines& lines, Index most) {
  std::vector<Points> chosen;
  for (const Index i : spread_numbers(lines.count(), most)) chosen.push_back(lines.line(i));
  return join(chosen);
}

Real polyline_length(const Points& line) {
  Real length = 0;
  for (Eigen::Index i = 1; i < line.cols(); ++i) length += (line.col(i) - line.col(i - 1)).norm();
  return length;
}

std::vector<Real> polyline_lengths(const Polylines& lines) {
  std::vector<Real> lengths;
  for (Index i = 0; i < lines.count(); ++i) {
    Real length = 0;
    for (Index p = lines.begin(i) + 1; p < lines.end(i); ++p)
      length += (lines.points.col(p) - lines.points.col(p - 1)).norm();
    lengths.push_back(length);
  }
  return lengths;
}

Real distance_to_polyline(const Points& line, const Vec3& p) {
  Real nearest = std::numeric_limits<Real>::infinity();
  for (Eigen::Index i = 1; i < line.cols(); ++i)
    nearest = std::min(nearest, distance_to_segment<Vec3>(p, line.col(i - 1), line.col(i)));
  return nearest;
}

std::vector<Real> distances_along(const Points& line) {
  std::vector<Real> distances;
  for (Eigen::Index i = 0; i < line.cols(); ++i)
    distances.push_back(i == 0 ? 0 : distances.back() + (line.col(i) - line.col(i - 1)).norm());
  return distances;
}

Points points_along(const Points& line, const std::vector<Real>& distances) {
  const Eigen::Index last = line.cols() - 1;
  Points points(3, static_cast<Eigen::Index>(distances.size()));
  Eigen::Index i = 0;
  Real begin = 0, length = last > 0 ? (line.col(1) - line.col(0)).norm() : 0;  // of segment i
  for (std::size_t k = 0; k < distances.size(); ++k) {
    while (i + 1 < last && begin + length < distances[k]) {
      begin += length;
      ++i;
      length = (line.col(i + 1) - line.col(i)).norm();
    }
    const Real share = length > 0 ? std::clamp((distances[k] - begin) / length, Real{0}, Real{1}) : 0;
    points.col(static_cast<Eigen::Index>(k)) =
        last > 0 ? Vec3(line.col(i) + share * (line.col(i + 1) - line.col(i))) : Vec3(line.col(0));
  }
  return points;
}

Points resampled(const Points& line, Index segments) {
  const Real step = polyline_length(line) / segments;
  std::vector<Real> distances;
  for (Index k = 0; k <= segments; ++k) distances.push_back(step * k);
  Points result = points_along(line, distances);
  result.col(0) = line.col(0);
  result.col(segments) = line.col(line.cols() - 1);
  return result;
}

/// A point of the span from b to c at time t in [t1, t2], by Barry and Goldman's pyramid of linear interpolations.
static Vec3 in_span(const std::array<Vec3, 4>& p, const std::array<Real, 4>& times, Real t) {
  const auto between = [&](const Vec3& a, const Vec3& b, Real from, Real to) -> Vec3 {
    return ((to - t) * a + (t - from) * b) / (to - from);
  };
  const Vec3 a1 = between(p[0], p[1], times[0], times[1]), a2 = between(p[1], p[2], times[1], times[2]),
             a3 = between(p[2], p[3], times[2], times[3]);
  const Vec3 b1 = between(a1, a2, times[0], times[2]), b2 = between(a2, a3, times[1], times[3]);
  return between(b1, b2, times[1], times[2]);
}

static Points without_repetitions(const Points& line) {
  Points kept(3, line.cols());
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < line.cols(); ++i)
    if (count == 0 || (line.col(i) - kept.col(count - 1)).norm() > 0) kept.col(count++) = line.col(i);
  return kept.leftCols(count);
}

Points centripetal_spline(const Points& knots, Index pieces) {
  const Points p = without_repetitions(knots);
  const Eigen::Index spans = p.cols() - 1;
  Points result(3, spans * pieces + 1);
  for (Eigen::Index i = 0; i < spans; ++i) {
    // Beyond the ends the line goes on as its mirror image.
    const Vec3 b = p.col(i), c = p.col(i + 1);
    const Vec3 a = i > 0 ? Vec3(p.col(i - 1)) : Vec3(2 * b - c);
    const Vec3 d = i + 2 < p.cols() ? Vec3(p.col(i + 2)) : Vec3(2 * c - b);
    std::array<Real, 4> times{};
    times[1] = std::sqrt((b - a).norm());
    times[2] = times[1] + std::sqrt((c - b).norm());
    times[3] = times[2] + std::sqrt((d - c).norm());
    result.col(i * pieces) = b;
    for (Index k = 1; k < pieces; ++k)
      result.col(i * pieces + k) = in_span({a, b, c, d}, times, times[1] + (times[2] - times[1]) * k / pieces);
  }
  result.rightCols(1) = p.rightCols(1);
  return result;
}

}  // namespace gracilis
