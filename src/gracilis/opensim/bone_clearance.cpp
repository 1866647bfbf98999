#include <gracilis/opensim/bone_clearance.hpp>

#include <gracilis/geometry/section_frames.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

static constexpr Real gap = 0.0005;              // m
static constexpr Real center_clearance = 0.004;  // m
static constexpr Real farthest = 0.03;           // m, that a center goes
static constexpr Real widest = 1.6;              // times its radius that a corner goes out
static constexpr Real known = 0.06;              // m; no place in a bone is deeper

SolidBone::SolidBone(const TriangleMesh& surface)
    : distance(surface), low(surface.vertices.rowwise().minCoeff()), high(surface.vertices.rowwise().maxCoeff()) {}

/// How far a point is outside of the box around a bone, m; 0 in it.
static Real outside_box(const SolidBone& bone, const Vec3& p) {
  return (bone.low - p).cwiseMax(p - bone.high).cwiseMax(0.0).norm();
}

/// The way from a point to where it is so far away from a bone; zero where it is.
static Vec3 way_out(const SolidBone& bone, const Vec3& p, Real clearance) {
  if (outside_box(bone, p) >= clearance) return Vec3::Zero();
  const SignedDistance::Answer answer = bone.distance.query(p, known);
  if (!(answer.distance < clearance) || answer.distance == 0) return Vec3::Zero();
  const Vec3 to_surface = (answer.nearest.point - p).normalized();
  return answer.distance < 0 ? Vec3((clearance - answer.distance) * to_surface)
                             : Vec3((answer.distance - clearance) * to_surface);
}

/// A section in need goes its own way; the others follow their neighbors, but the ends stay.
static Points clear_centers(const Points& line, const Eigen::VectorXd& radii, const std::vector<SolidBone>& bones) {
  Points shift = Points::Zero(3, line.cols());
  for (int round = 0; round < 60; ++round) {
    bool any = false;
    Points next = shift;
    for (Eigen::Index k = 0; k < line.cols(); ++k) {
      Vec3 longest = Vec3::Zero();
      for (const SolidBone& bone : bones) {
        const Vec3 way = way_out(bone, line.col(k) + shift.col(k), std::min(center_clearance, radii[k]) + gap);
        if (way.squaredNorm() > longest.squaredNorm()) longest = way;
      }
      any = any || longest.norm() > 1e-6;
      const bool alone = longest.norm() > 0 || k == 0 || k + 1 == line.cols();
      next.col(k) += alone ? longest : Vec3((shift.col(k - 1) - 2 * shift.col(k) + shift.col(k + 1)) / 4);
      if (next.col(k).norm() > farthest) next.col(k) *= farthest / next.col(k).norm();
    }
    if (!any) break;
    shift = next;
  }
  return line + shift;
}

/// How far one comes from a point outside of the bones along a unit direction, `length` at most: no step is longer than
/// the distance that is left.
static Real way_along(const std::vector<SolidBone>& bones, const Vec3& from, const Vec3& direction, Real length) {
  Real way = 0;
  for (int step = 0; step < 100 && way < length; ++step) {
    const Vec3 p = from + way * direction;
    Real room = length;
    for (const SolidBone& bone : bones) {
      const Real box = outside_box(bone, p);
      room = std::min(room, box > 2 * gap ? box : bone.distance.query(p, known).distance);
    }
    if (room < gap + 1e-5) break;
    way += room - gap / 2;
  }
  return std::min(way, length);
}

/// Twice the area of a section, over the sine between rays.
static Real area_of(const Eigen::VectorXd& radii) {
  Real sum = 0;
  for (Eigen::Index i = 0; i < radii.size(); ++i) sum += radii[i] * radii[(i + 1) % radii.size()];
  return sum;
}

ClearSections clear_of_bones(const Points& line, const Eigen::VectorXd& radii, int rays,
                             const std::vector<SolidBone>& bones) {
  ClearSections result{clear_centers(line, radii, bones), radii.transpose().replicate(rays, 1)};
  const SectionFrames frames = section_frames(result.centers, Vec3::UnitX());
  for (Eigen::Index k = 0; k < line.cols(); ++k) {
    const Vec3 center = result.centers.col(k);
    Eigen::VectorXd room(rays);
    for (int i = 0; i < rays; ++i)
      room[i] = std::max(way_along(bones, center, frames.ray(k, i, rays), widest * radii[k]), gap);
    const auto grown = [&](Real factor) -> Eigen::VectorXd { return room.cwiseMin(factor * radii[k]); };
    // The area grows with the factor: bisection.
    Real low = 1, high = widest;
    const Real wanted = rays * radii[k] * radii[k];
    for (int step = 0; step < 30 && area_of(grown(1)) < wanted; ++step) {
      const Real middle = (low + high) / 2;
      (area_of(grown(middle)) < wanted ? low : high) = middle;
    }
    result.radii.col(k) = grown(low);
  }
  return result;
}

}  // namespace gracilis::opensim
