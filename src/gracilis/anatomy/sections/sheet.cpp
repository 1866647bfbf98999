#include <gracilis/anatomy/sections/sheet.hpp>

#include <gracilis/geometry/point_segment.hpp>
#include <gracilis/scene/section_line.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {

SheetCorner sheet_corner(Index rays, Index side, std::size_t heads, Real corner) {
  SheetCorner result;
  result.angle = 2 * pi * corner / static_cast<Real>(rays);
  const Real turned = std::abs(std::remainder(result.angle, 2 * pi));  // 0 at the last head's edge, pi at the first's
  const Real along_side = pi * static_cast<Real>(2 * side) / static_cast<Real>(rays);
  const Real from_last = std::clamp(0.5 + (turned - pi / 2) / along_side, 0.0, 1.0);
  const Real place = (1 - from_last) * static_cast<Real>(heads - 1);
  result.head = std::min(static_cast<std::size_t>(place), heads - 2);
  result.next = place - static_cast<Real>(result.head);
  return result;
}

Index opposite_corner(Index rays, Index corner) { return (rays - corner) % rays; }

/// The corner before the middle of a side; the vertex that closes an end lies between it, the next one and those
/// opposite to them.
static Index before_middle(Index rays) { return (rays / 2 - 1) / 2; }

Eigen::Matrix3Xi sheet_faces(Index sections, Index rays) {
  Eigen::Matrix3Xi faces(3, 2 * rays * (sections - 1) + 2 * rays);
  Index count = 0;
  const auto add = [&](Index a, Index b, Index c, bool turned = false) {
    faces.col(count++) = turned ? Eigen::Vector3i(a, c, b) : Eigen::Vector3i(a, b, c);
  };
  for (Index k = 0; k + 1 < sections; ++k)
    for (Index i = 0; i < rays; ++i) {
      const Index a = k * rays + i, b = k * rays + (i + 1) % rays;
      add(a, b, b + rays);
      add(a, b + rays, a + rays);
    }
  for (const bool first : {true, false}) {
    const Index ring = first ? 0 : (sections - 1) * rays, middle = sections * rays + (first ? 0 : 1);
    for (Index i = 0; i < rays / 2; ++i) {
      const Index a = ring + i, b = a + 1, c = ring + opposite_corner(rays, i + 1), d = ring + opposite_corner(rays, i);
      if (i == before_middle(rays)) {
        add(middle, a, b, first);
        add(middle, b, c, first);
        add(middle, c, d, first);
        add(middle, d, a, first);
        continue;
      }
      if (b != c) add(a, b, c, first);
      if (a != d) add(a, c, d, first);
    }
  }
  return faces;
}

Points sheet_vertices(const Points& corners, Index rays) {
  Points vertices(3, corners.cols() + 2);
  vertices.leftCols(corners.cols()) = corners;
  const Index i = before_middle(rays);
  for (const Index end : {0, 1}) {
    const Eigen::Index ring = end == 0 ? 0 : corners.cols() - rays;
    Vec3 sum = Vec3::Zero();
    for (const Index corner : {i, i + 1, opposite_corner(rays, i), opposite_corner(rays, i + 1)})
      sum += corners.col(ring + corner);
    vertices.col(corners.cols() + end) = sum / 4;
  }
  return vertices;
}

std::vector<LineSections> carrying_lines(const Muscle& muscle) {
  if (muscle.action_line.heads.empty()) return {line_sections(muscle)};
  std::vector<LineSections> lines;
  for (const ActionLine& head : muscle.action_line.heads)
    lines.push_back(line_sections(head, muscle.surface.vertices.col(0)));
  return lines;
}

std::vector<LineShare> line_shares(const ActionLine& line, Index vertices) {
  std::vector<LineShare> shares(static_cast<std::size_t>(vertices));
  const Index sections = (vertices - 2) / line.rays;
  for (Index v = 0; v < vertices; ++v) {
    LineShare& share = shares[static_cast<std::size_t>(v)];
    share.section = section_of_vertex(v, sections, line.rays);
    if (line.heads.empty()) continue;
    const Real corner = v < sections * line.rays ? v % line.rays : before_middle(line.rays) + 0.5;
    const SheetCorner place = sheet_corner(line.rays, line.side, line.heads.size(), corner);
    share.line = place.head;
    share.next = place.next;
  }
  return shares;
}

LineShare nearest_share(const std::vector<Points>& centers, const Vec3& point) {
  LineShare share;
  Real least = std::numeric_limits<Real>::infinity();
  for (const Points& line : centers) {
    Eigen::Index nearest = 0;
    const Real distance = (line.colwise() - point).colwise().squaredNorm().minCoeff(&nearest);
    if (!(distance < least)) continue;
    least = distance;
    share.section = static_cast<Index>(nearest);
  }
  least = std::numeric_limits<Real>::infinity();
  for (std::size_t line = 0; line + 1 < centers.size(); ++line) {
    const Vec3 from = centers[line].col(share.section), to = centers[line + 1].col(share.section);
    const Real next = nearest_on_segment<Vec3>(point, from, to);
    const Real distance = (point - from - next * (to - from)).squaredNorm();
    if (!(distance < least)) continue;
    least = distance;
    share.line = line;
    share.next = next;
  }
  return share;
}

std::vector<LineShare> vertex_shares(const Muscle& muscle, const std::vector<Points>& centers) {
  const Points& vertices = muscle.surface.vertices;
  if (vertices.cols() == muscle.action_line.rays * centers[0].cols() + 2)
    return line_shares(muscle.action_line, static_cast<Index>(vertices.cols()));
  std::vector<LineShare> shares;
  for (const Vec3 vertex : vertices.colwise()) shares.push_back(nearest_share(centers, vertex));
  return shares;
}

std::vector<char> in_tendons(const std::vector<LineSections>& lines, const std::vector<LineShare>& shares) {
  std::vector<char> in_tendon;
  for (const LineShare& share : shares) {
    const auto is_tendon = [&](std::size_t line) { return distance_from_tendon(lines[line], share.section) <= 0; };
    in_tendon.push_back((share.next >= 1 || is_tendon(share.line)) && (share.next <= 0 || is_tendon(share.line + 1)));
  }
  return in_tendon;
}

std::vector<char> in_tendons(const Muscle& muscle) {
  if (muscle.action_line.rays == 0) return {};
  const std::vector<LineSections> lines = carrying_lines(muscle);
  std::vector<Points> centers;
  for (const LineSections& line : lines) centers.push_back(section_line(line.line).centers);
  return in_tendons(lines, vertex_shares(muscle, centers));
}

}  // namespace gracilis
