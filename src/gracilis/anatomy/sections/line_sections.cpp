#include <gracilis/anatomy/sections/line_sections.hpp>

#include <gracilis/anatomy/sections/line_path.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/scene/section_line.hpp>

#include <algorithm>
#include <limits>

namespace gracilis {

/// As many bodies as the line needs.
static std::size_t body_count(const ActionLine& line) {
  Index last = 0;
  for (const Index body : line.bodies) last = std::max(last, body);
  for (const LinePoint& point : line.path.points) last = std::max(last, point.body);
  for (const PlacedWrap& wrap : line.path.wraps) last = std::max(last, wrap.body);
  return static_cast<std::size_t>(last) + 1;
}

LineSections line_sections(const ActionLine& line, const Vec3& first_corner) {
  LineSections result;
  result.line = line;
  const Points centers = section_line(line).centers;
  // The line's points may cut the corners of its path.
  result.length = polyline_length(line_at(line, capture_pose(body_count(line))));
  result.places = line.shares;
  for (Real& place : result.places) place *= result.length;
  if (line.shares.empty()) {
    result.places = distances_along(centers);
    for (Real& place : result.places) place *= result.length / polyline_length(centers);
  }
  result.first_ray = first_corner - centers.col(0);
  if (result.first_ray.norm() < 1e-9) result.first_ray = Vec3::UnitX();
  return result;
}

LineSections line_sections(const Muscle& muscle) {
  return line_sections(muscle.action_line, muscle.surface.vertices.col(0));
}

Index section_of_vertex(Index vertex, Index sections, Index rays) {
  if (vertex < sections * rays) return vertex / rays;
  return vertex == sections * rays ? 0 : sections - 1;
}

Real distance_from_tendon(const LineSections& sections, Index section) {
  const Real place = sections.places[static_cast<std::size_t>(section)];
  Real distance = std::numeric_limits<Real>::infinity();
  if (sections.line.origin_tendon > 0) distance = place - sections.line.origin_tendon;
  if (sections.line.tendon > 0) distance = std::min(distance, sections.length - sections.line.tendon - place);
  return distance;
}

RigidTransform PlacedSections::frame(Eigen::Index k) const {
  RigidTransform frame = RigidTransform::Identity();
  frame.linear() = frames.axes(k);
  frame.translation() = centers.col(k);
  return frame;
}

/// Places of the sections on a line of this length: the tendons' keep their distance from its ends.
static std::vector<Real> places_on(const LineSections& sections, Real length) {
  const Real begin = sections.line.origin_tendon, end = sections.length - sections.line.tendon;
  const Real tendons = sections.length - (end - begin), belly = end - begin;
  std::vector<Real> places;
  // A line hardly longer than the tendon leaves no room for a belly: then all shrink alike.
  const bool stiff = tendons > 0 && belly > 0 && length - tendons > 0.2 * belly;
  for (const Real place : sections.places) {
    if (!stiff)
      places.push_back(place * length / sections.length);
    else if (place <= begin)
      places.push_back(place);
    else
      places.push_back(place <= end ? begin + (place - begin) * (length - tendons) / belly
                                    : length - (sections.length - place));
  }
  return places;
}

PlacedSections sections_at(const LineSections& sections, const Pose& pose) {
  const Points points = line_at(sections.line, pose);
  const Points centers = points_along(points, places_on(sections, polyline_length(points)));
  const Vec3 ray = pose.bodies[static_cast<std::size_t>(sections.line.bodies[0])].linear() * sections.first_ray;
  return {centers, section_frames(centers, ray)};
}

}  // namespace gracilis
