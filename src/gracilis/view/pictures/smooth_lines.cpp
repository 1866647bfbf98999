#include <gracilis/view/pictures/smooth_lines.hpp>

#include <algorithm>

namespace gracilis {

static constexpr int rounding_passes = 2, parts_drawn = 4;

static Points corners_rounded(Points line) {
  for (int pass = 0; pass < rounding_passes; ++pass) {
    const Points before = line;
    for (Index i = 1; i + 1 < line.cols(); ++i)
      line.col(i) = before.col(i) / 2 + (before.col(i - 1) + before.col(i + 1)) / 4;
  }
  return line;
}

/// The place at t (0 to 1) between points i and i + 1.
static Vec3 curve_at(const Points& line, Index i, Real t) {
  const Vec3 p1 = line.col(i), p2 = line.col(i + 1);
  const Vec3 p0 = line.col(std::max<Index>(i - 1, 0)), p3 = line.col(std::min<Index>(i + 2, line.cols() - 1));
  return ((2 * p1) + (p2 - p0) * t + (2 * p0 - 5 * p1 + 4 * p2 - p3) * (t * t) +
          (3 * (p1 - p2) + p3 - p0) * (t * t * t)) /
         2;
}

/// A column for each place.
static Points drawn_curve(const Points& line) {
  if (line.cols() < 3) return line;
  const Points smooth = corners_rounded(line);
  Points curve(3, parts_drawn * (line.cols() - 1) + 1);
  for (Index i = 0; i + 1 < curve.cols(); ++i)
    curve.col(i) = curve_at(smooth, i / parts_drawn, static_cast<Real>(i % parts_drawn) / parts_drawn);
  curve.rightCols<1>() = line.rightCols<1>();
  return curve;
}

Polylines smooth_lines(const Polylines& lines) {
  std::vector<Points> curves;
  for (Index l = 0; l < lines.count(); ++l) curves.push_back(drawn_curve(lines.line(l)));
  return join(curves);
}

}  // namespace gracilis
