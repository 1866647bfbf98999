#include <gracilis/opensim/import/bone_clearance.hpp>

#include <gracilis/geometry/section_frames.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

static constexpr Real gap = 0.0005;              // m
static constexpr Real center_clearance = 0.004;  // m
static constexpr Real farthest = 0.03;           // m, that a center goes
static constexpr Real widest = 1.6;              // times its radius that a corner goes out
static constexpr Real widest_beside = 2.2;       // the same beside other muscles
static constexpr Real deepest_known = 0.06;      // m; no place in a bone is deeper

SolidBone::SolidBone(const TriangleMesh& surface)
    : distance(surface), low(surface.vertices.rowwise().minCoeff()), high(surface.vertices.rowwise().maxCoeff()) {}

/// How far a point is outside of the box around a bone, m; 0 in it.
static Real outside_box(const SolidBone& bone, const Vec3& p) {
  return (bone.low - p).cwiseMax(p - bone.high).cwiseMax(0.0).norm();
}

/// The way from a point to where it is so far away from a bone; zero where it is.
static Vec3 way_out(const SolidBone& bone, const Vec3& p, Real clearance) {
  if (outside_box(bone, p) >= clearance) return Vec3::Zero();
  const SignedDistance::Answer answer = bone.distance.query(p, deepest_known);
  if (!(answer.distance < clearance) || answer.distance == 0) return Vec3::Zero();
  const Vec3 to_surface = (answer.nearest.point - p).normalized();
  return answer.distance < 0 ? Vec3((clearance - answer.distance) * to_surface)
                             : Vec3((answer.distance - clearance) * to_surface);
}

/// A section in need goes its own way; the others follow their neighbors, but the ends stay.
Points clear_centers(const Points& line, const Eigen::VectorXd& radii, const std::vector<SolidBone>& bones) {
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
      room = std::min(room, box > 2 * gap ? box : bone.distance.query(p, deepest_known).distance);
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

namespace {

/// A muscle's sections, and how far their corners may go.
struct Rooms {
  const Eigen::VectorXd& radii;
  Eigen::MatrixXd room;  ///< rays × sections, m
  Real widest = 0;       ///< times its radius

  /// The section with `more` times its round area, where there is room: corners as far out as one factor takes them.
  Eigen::VectorXd filled(Eigen::Index k, Real more) const {
    const auto grown = [&](Real factor) -> Eigen::VectorXd { return room.col(k).cwiseMin(factor * radii[k]); };
    const Real wanted = more * static_cast<Real>(room.rows()) * radii[k] * radii[k];
    if (!(area_of(grown(1)) < wanted)) return grown(1);
    // The area grows with the factor: bisection.
    Real low = 1, high = widest;
    for (int step = 0; step < 30; ++step) {
      const Real middle = (low + high) / 2;
      (area_of(grown(middle)) < wanted ? low : high) = middle;
    }
    return grown(low);
  }
};

}  // namespace

/// Next to a section that is drawn in a corner goes out no steeper than this, or than the round muscle does there.
static void soften(const Points& centers, const Eigen::VectorXd& round, Eigen::MatrixXd& radii) {
  const Real steepest = 0.5;
  const auto follow = [&](Eigen::Index k, Eigen::Index before) {
    const Real rise =
        std::max(steepest * (centers.col(k) - centers.col(before)).norm(), widest_beside * (round[k] - round[before]));
    radii.col(k) = radii.col(k).cwiseMin((radii.col(before).array() + rise).matrix());
  };
  for (Eigen::Index k = 1; k < centers.cols(); ++k) follow(k, k - 1);
  for (Eigen::Index k = centers.cols() - 1; k > 0; --k) follow(k - 1, k);
}

/// Of sections with these corners, over half the sine between rays.
static Real volume_of(const Points& centers, const Eigen::MatrixXd& radii) {
  Real sum = 0;
  for (Eigen::Index k = 0; k + 1 < centers.cols(); ++k)
    sum += (centers.col(k + 1) - centers.col(k)).norm() * (area_of(radii.col(k)) + area_of(radii.col(k + 1))) / 2;
  return sum;
}

static Real round_volume(const Points& centers, const Rooms& rooms) {
  return volume_of(centers, rooms.radii.transpose().replicate(rooms.room.rows(), 1));
}

/// Sections that take so many times their areas, 2 at most, that together they have their volume.
static Eigen::MatrixXd share_out(const Points& centers, const Rooms& rooms) {
  const auto taken = [&](Real more) {
    Eigen::MatrixXd radii(rooms.room.rows(), rooms.room.cols());
    for (Eigen::Index k = 0; k < radii.cols(); ++k) radii.col(k) = rooms.filled(k, more);
    soften(centers, rooms.radii, radii);
    return radii;
  };
  const Real wanted = round_volume(centers, rooms);
  Real low = 1, high = 2;
  for (int step = 0; step < 12; ++step) {
    const Real middle = (low + high) / 2;
    (volume_of(centers, taken(middle)) < wanted ? low : high) = middle;
  }
  return taken(high);
}

ClearSections clear_of_bones(const Points& line, const Eigen::VectorXd& radii, int rays,
                             const std::vector<SolidBone>& bones, const RoomBeside& beside) {
  ClearSections result{clear_centers(line, radii, bones), Eigen::MatrixXd(rays, line.cols())};
  const SectionFrames frames = section_frames(result.centers, Vec3::UnitX());
  Rooms rooms{radii, Eigen::MatrixXd(rays, line.cols()), beside ? widest_beside : widest};
  for (Eigen::Index k = 0; k < line.cols(); ++k)
    for (int i = 0; i < rays; ++i) {
      const Vec3 center = result.centers.col(k), ray = frames.ray(k, i, rays);
      Real room = way_along(bones, center, ray, rooms.widest * radii[k]);
      if (beside) room = beside(center, ray, radii[k], room);
      rooms.room(i, k) = std::max(room, gap);
    }
  if (beside)
    result.radii = share_out(result.centers, rooms);
  else
    for (Eigen::Index k = 0; k < line.cols(); ++k) result.radii.col(k) = rooms.filled(k, 1);
  result.volume_share = volume_of(result.centers, result.radii) / round_volume(result.centers, rooms);
  return result;
}

}  // namespace gracilis::opensim
