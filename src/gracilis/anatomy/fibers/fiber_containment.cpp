#include <gracilis/anatomy/fibers/fiber_containment.hpp>

#include <gracilis/geometry/measures.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

/// The point at `depth` below the nearest point of the surface, or the deepest that halving the depth finds.
static Vec3 moved_inside(const TriangleMesh& surface, const SignedDistance& distance, Real depth, const Vec3& p) {
  const SignedDistance::Answer answer = distance.query(p);
  if (answer.distance <= -depth) return p;
  const Vec3 nearest = answer.nearest.point;
  // Inwards is away from the nearest point where p lies inside, else towards it and on; on the surface itself the
  // triangle's normal decides.
  Vec3 inwards = answer.distance < 0 ? Vec3(p - nearest) : Vec3(nearest - p);
  if (inwards.norm() < 1e-9) inwards = -area_vector(surface.vertices, surface.faces.col(answer.nearest.face));
  const Vec3 normal = -area_vector(surface.vertices, surface.faces.col(answer.nearest.face)).normalized();
  for (const Vec3& direction : {Vec3(inwards.normalized()), normal}) {
    Real step = depth;
    for (int halving = 0; halving < 5; ++halving, step /= 2) {
      Vec3 q = nearest + step * direction;
      if (distance.query(q).distance < 0) return q;
    }
  }
  return answer.distance < 0 ? p : nearest;
}

void move_inside(const TriangleMesh& surface, const SignedDistance& distance, Real depth, Points& line) {
  for (Index i = 0; i < line.cols(); ++i) line.col(i) = moved_inside(surface, distance, depth, line.col(i));
}

/// `p`, or as much of the way there from `home` as the limit allows.
static Vec3 held_near(const Vec3& home, const Eigen::Matrix3d& limit, const Vec3& p) {
  const Real beyond = (p - home).dot(limit * (p - home));
  return beyond > 1 ? Vec3(home + (p - home) / std::sqrt(beyond)) : p;
}

void smooth_inside(const TriangleMesh& surface, const SignedDistance& distance, Real depth, int rounds, Points& line,
                   std::span<const Eigen::Matrix3d> limits) {
  const Eigen::Index inner = line.cols() - 2;
  if (inner <= 0) return;
  const Points home = line.middleCols(1, inner);
  // How far each point may move before it could leave the inside: the surface is asked only once that is used up.
  Eigen::RowVectorXd leeway = Eigen::RowVectorXd::Zero(inner);
  Points middle = line.middleCols(1, inner);
  for (int round = 0; round < rounds; ++round) {
    middle = (line.leftCols(inner) + line.rightCols(inner)) / 4 + line.middleCols(1, inner) / 2;
    for (Eigen::Index i = 0; i < inner && !limits.empty(); ++i)
      middle.col(i) = held_near(home.col(i), limits[static_cast<std::size_t>(i) + 1], middle.col(i));
    leeway -= (middle - line.middleCols(1, inner)).colwise().norm();
    for (Eigen::Index i = 0; i < inner; ++i) {
      if (leeway[i] > 0) continue;
      middle.col(i) = moved_inside(surface, distance, depth, middle.col(i));
      leeway[i] = -distance.query(middle.col(i)).distance - depth;
    }
    line.middleCols(1, inner) = middle;
  }
}

Containment containment(const SignedDistance& distance, const Polylines& fibers) {
  Containment result;
  result.points = static_cast<Index>(fibers.points.cols());
  for (Index i = 0; i < result.points; ++i) {
    const Real outside = distance.query(fibers.points.col(i)).distance;
    if (outside > 1e-9) ++result.outside;
    result.farthest = std::max(result.farthest, outside);
  }
  return result;
}

}  // namespace gracilis
