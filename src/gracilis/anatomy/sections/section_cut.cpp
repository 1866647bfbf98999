#include <gracilis/anatomy/sections/section_cut.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace gracilis {

using Vec2 = Eigen::Vector2d;

static Real cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

SectionCut::SectionCut(const TriangleMesh& surface, const Vec3& center, const Vec3& x, const Vec3& y) {
  const Vec3 normal = x.cross(y);
  const Eigen::VectorXd heights = (surface.vertices.colwise() - center).transpose() * normal;
  // From the lower to the higher index, so that both triangles of an edge find the same point.
  const auto crossing = [&](int a, int b) -> Vec2 {
    if (a > b) std::swap(a, b);
    const Real share = heights[a] / (heights[a] - heights[b]);
    const Vec3 place = surface.vertices.col(a) + share * (surface.vertices.col(b) - surface.vertices.col(a)) - center;
    return {place.dot(x), place.dot(y)};
  };
  for (Eigen::Index f = 0; f < surface.faces.cols(); ++f) {
    const Eigen::Vector3i face = surface.faces.col(f);
    for (int k = 0; k < 3; ++k) {
      const int lone = face[k], next = face[(k + 1) % 3], last = face[(k + 2) % 3];
      const bool above = heights[lone] >= 0;
      if ((heights[next] >= 0) == above || (heights[last] >= 0) == above) continue;
      // Seen from outside corners run counterclockwise, so that the inside lies to the left from the edge after a lone
      // corner above the plane to the edge before it.
      const Vec2 after = crossing(lone, next), before = crossing(lone, last);
      segments_.push_back(above ? Segment{after, before} : Segment{before, after});
    }
  }
}

std::vector<RayHit> SectionCut::hits(const Vec2& from, const Vec2& along) const {
  std::vector<RayHit> found;
  for (const Segment& segment : segments_) {
    const Vec2 a = segment.from - from, b = segment.to - from;
    const Real side_a = cross(along, a), side_b = cross(along, b);
    if ((side_a >= 0) == (side_b >= 0)) continue;
    const Real share = side_a / (side_a - side_b);
    const Real distance = along.dot(a + share * (b - a));
    if (distance > 0) found.push_back({distance, side_b >= 0});
  }
  std::sort(found.begin(), found.end(), [](const RayHit& a, const RayHit& b) { return a.distance < b.distance; });
  return found;
}

std::vector<Eigen::Matrix2Xd> SectionCut::outlines() const {
  // Both triangles of an edge find the same point, bit by bit. Several segments may begin in one where the plane meets
  // a vertex.
  std::multimap<std::pair<Real, Real>, const Segment*> beginnings;
  for (const Segment& segment : segments_)
    if (segment.from != segment.to) beginnings.emplace(std::pair(segment.from.x(), segment.from.y()), &segment);
  std::vector<Eigen::Matrix2Xd> curves;
  while (!beginnings.empty()) {
    std::vector<Vec2> points;
    auto next = beginnings.begin();
    while (next != beginnings.end()) {
      points.push_back(next->second->from);
      const Vec2 to = next->second->to;
      beginnings.erase(next);
      next = beginnings.find({to.x(), to.y()});
    }
    Eigen::Matrix2Xd curve(2, static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) curve.col(static_cast<Eigen::Index>(i)) = points[i];
    if (curve.cols() > 2) curves.push_back(std::move(curve));
  }
  return curves;
}

bool SectionCut::contains(const Vec2& point) const {
  int winding = 0;
  for (const RayHit& hit : hits(point, Vec2(0.8, 0.6))) winding += hit.back ? 1 : -1;
  return winding > 0;
}

}  // namespace gracilis
