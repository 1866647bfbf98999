#include <gracilis/methods/mass_spring/particles.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/nearest_points.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>

#include <algorithm>
#include <random>

namespace gracilis::mass_spring {

Points sampled_along(const Points& line, Index count, Real first_share) {
  const Real length = polyline_length(line), step = length / (count - 2);
  std::vector<Real> distances = {0};
  for (Index k = 0; k < count - 2; ++k) distances.push_back((first_share + k) * step);
  distances.push_back(length);
  Points points = points_along(line, distances);
  points.col(0) = line.col(0);
  points.col(count - 1) = line.col(line.cols() - 1);
  return points;
}

Polylines particles_along(const Polylines& fibers, Index per_fiber, int seed) {
  std::mt19937 generator(static_cast<std::mt19937::result_type>(seed));
  std::vector<Points> lines;
  for (Index f = 0; f < fibers.count(); ++f) {
    const Real share = static_cast<Real>(generator()) / static_cast<Real>(std::mt19937::max());
    lines.push_back(sampled_along(fibers.line(f), per_fiber, share));
  }
  return join(lines);
}

std::vector<NearestBone> nearest_bones(const Scene& scene, const Points& points) {
  std::vector<NearestBone> found(static_cast<std::size_t>(points.cols()));
  for (const Bone& bone : scene.bones) {
    if (bone.surface.face_count() == 0) continue;
    const NearestTriangle surface(bone.surface);
    parallel_for(static_cast<Index>(points.cols()), 256, [&](Index begin, Index end) {
      for (Index p = begin; p < end; ++p) {
        NearestBone& best = found[static_cast<std::size_t>(p)];
        const Real distance = surface.query(points.col(p)).distance;
        if (best.body < 0 || distance < best.distance) best = {bone.body, distance};
      }
    });
  }
  return found;
}

/// Per particle: the body of the nearest attached vertex where that is nearer than `distance`, else -1.
static std::vector<Index> near_attachments(const Muscle& muscle, const Points& particles, Real distance) {
  std::vector<Index> bodies(static_cast<std::size_t>(particles.cols()), -1);
  std::vector<Vec3> places;
  std::vector<Index> body_of;
  for (const Attachment& attachment : muscle.attachments)
    for (const Index v : attachment.vertices) {
      places.emplace_back(muscle.surface.vertices.col(v));
      body_of.push_back(attachment.body);
    }
  if (places.empty()) return bodies;
  Points attached(3, static_cast<Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) attached.col(static_cast<Index>(i)) = places[i];
  const NearestPoints nearest(attached);
  for (Index p = 0; p < static_cast<Index>(particles.cols()); ++p) {
    const auto found = static_cast<std::size_t>(nearest.nearest(particles.col(p)));
    if ((places[found] - particles.col(p)).norm() < distance) bodies[static_cast<std::size_t>(p)] = body_of[found];
  }
  return bodies;
}

std::vector<Index> fixed_bodies(const Muscle& muscle, const Points& particles, const std::vector<NearestBone>& bones,
                                FixedNear near, Real distance) {
  if (near == FixedNear::attachments) return near_attachments(muscle, particles, distance);
  std::vector<Index> bodies;
  for (const NearestBone& bone : bones) bodies.push_back(bone.distance < distance ? bone.body : -1);
  return bodies;
}

std::vector<char> on_boundary_fibers(const Polylines& particles, const Points& vertices) {
  std::vector<char> on_boundary(static_cast<std::size_t>(particles.points.cols()), 0);
  if (on_boundary.empty()) return on_boundary;
  const NearestPoints nearest(particles.points);
  std::vector<char> is_nearest(on_boundary.size(), 0);
  for (Index v = 0; v < static_cast<Index>(vertices.cols()); ++v)
    is_nearest[static_cast<std::size_t>(nearest.nearest(vertices.col(v)))] = 1;
  for (Index f = 0; f < particles.count(); ++f) {
    const auto begin = is_nearest.begin() + particles.begin(f), end = is_nearest.begin() + particles.end(f);
    if (std::find(begin, end, 1) != end)
      std::fill(on_boundary.begin() + particles.begin(f), on_boundary.begin() + particles.end(f), 1);
  }
  return on_boundary;
}

}  // namespace gracilis::mass_spring
