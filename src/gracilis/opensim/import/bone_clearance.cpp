#include <gracilis/opensim/import/bone_clearance.hpp>

#include <gracilis/geometry/polygon_area.hpp>
#include <gracilis/geometry/section_frames.hpp>
#include <gracilis/opensim/import/edge_clearance.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gracilis::opensim {

static constexpr Real gap = 0.0005;              // m
static constexpr Real center_clearance = 0.004;  // m
static constexpr Real farthest = 0.03;           // m, that a center goes
static constexpr Real widest = 1.6;              // times its radius that a corner goes out
static constexpr Real widest_beside = 2.2;       // the same beside other muscles
static constexpr Real least_beside = 0.4;        // times its radius that a corner keeps beside other muscles
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

Real distance_to(const std::vector<SolidBone>& bones, const Vec3& p, Real most) {
  for (const SolidBone& bone : bones) {
    const Real box = outside_box(bone, p);
    most = std::min(most, box > 2 * gap ? box : bone.distance.query(p, deepest_known).distance);
  }
  return most;
}

/// No step is longer than the distance that is left.
Real way_along(const std::vector<SolidBone>& bones, const Vec3& from, const Vec3& direction, Real length) {
  Real way = 0;
  for (int step = 0; step < 100 && way < length; ++step) {
    const Real room = distance_to(bones, from + way * direction, length);
    if (room < gap + 1e-5) break;
    way += room - gap / 2;
  }
  return std::min(way, length);
}

Points SectionRays::corners() const {
  return feet + (directions.array().rowwise() * lengths.reshaped().transpose().array()).matrix();
}

namespace {

/// A muscle's sections, and how far their corners may go.
struct Rooms {
  const SectionRays& rays;
  Eigen::MatrixXd room;  ///< rays × sections, m
  Real widest = 0;       ///< times its length that a ray grows to

  Eigen::Index count() const { return room.rows(); }     ///< of a section's rays
  Eigen::Index sections() const { return room.cols(); }  ///< their number

  Real area(Eigen::Index k, const Eigen::VectorXd& lengths) const {
    const Points feet = rays.feet.middleCols(k * count(), count()),
                 directions = rays.directions.middleCols(k * count(), count());
    return polygon_area_vector(feet + directions * lengths.asDiagonal()).norm();
  }

  /// How far two sections are apart along the feet of a ray, m.
  Real apart(Eigen::Index ray, Eigen::Index k, Eigen::Index other) const {
    return (rays.feet.col(k * count() + ray) - rays.feet.col(other * count() + ray)).norm();
  }

  /// The section with `more` times its area, where there is room: rays as long as one factor makes them.
  Eigen::VectorXd filled(Eigen::Index k, Real more) const {
    const auto grown = [&](Real factor) -> Eigen::VectorXd {
      return room.col(k).cwiseMin(factor * rays.lengths.col(k));
    };
    const Real wanted = more * area(k, rays.lengths.col(k));
    if (!(area(k, grown(1)) < wanted)) return grown(1);
    // The area grows with the factor: bisection.
    Real low = 1, high = widest;
    for (int step = 0; step < 30; ++step) {
      const Real middle = (low + high) / 2;
      (area(k, grown(middle)) < wanted ? low : high) = middle;
    }
    return grown(low);
  }

  /// Of sections with such rays, m³.
  Real volume(const Eigen::MatrixXd& lengths) const {
    Real sum = 0, before = area(0, lengths.col(0));
    for (Eigen::Index k = 1; k < sections(); ++k) {
      Real distance = 0;
      for (Eigen::Index i = 0; i < count(); ++i) distance += apart(i, k, k - 1) / static_cast<Real>(count());
      const Real now = area(k, lengths.col(k));
      sum += distance * (before + now) / 2;
      before = now;
    }
    return sum;
  }
};

}  // namespace

/// Next to a section that is drawn in a corner goes out no steeper than this, or than the muscle does there by itself.
static void soften(const Rooms& rooms, Eigen::MatrixXd& lengths) {
  const Real steepest = 0.5;
  const auto follow = [&](Eigen::Index k, Eigen::Index before) {
    for (Eigen::Index i = 0; i < rooms.count(); ++i) {
      const Real rise = std::max(steepest * rooms.apart(i, k, before),
                                 widest_beside * (rooms.rays.lengths(i, k) - rooms.rays.lengths(i, before)));
      lengths(i, k) = std::min(lengths(i, k), lengths(i, before) + rise);
    }
  };
  for (Eigen::Index k = 1; k < rooms.sections(); ++k) follow(k, k - 1);
  for (Eigen::Index k = rooms.sections() - 1; k > 0; --k) follow(k - 1, k);
}

/// Sections that take so many times their areas, 2 at most, that together they have their volume.
static Eigen::MatrixXd share_out(const Rooms& rooms) {
  const auto taken = [&](Real more) {
    Eigen::MatrixXd lengths(rooms.count(), rooms.sections());
    for (Eigen::Index k = 0; k < rooms.sections(); ++k) lengths.col(k) = rooms.filled(k, more);
    soften(rooms, lengths);
    return lengths;
  };
  const Real wanted = rooms.volume(rooms.rays.lengths);
  Real low = 1, high = 2;
  for (int step = 0; step < 12; ++step) {
    const Real middle = (low + high) / 2;
    (rooms.volume(taken(middle)) < wanted ? low : high) = middle;
  }
  return taken(high);
}

ClearRays clear_rays(const SectionRays& rays, const std::vector<SolidBone>& bones, const RoomBeside& beside) {
  const Eigen::Index count = rays.lengths.rows(), sections = rays.lengths.cols();
  Rooms rooms{rays, Eigen::MatrixXd(count, sections), beside ? widest_beside : widest};
  for (Eigen::Index k = 0; k < sections; ++k)
    for (Eigen::Index i = 0; i < count; ++i) {
      const Vec3 foot = rays.feet.col(k * count + i), ray = rays.directions.col(k * count + i);
      Real room = way_along(bones, foot, ray, rooms.widest * rays.lengths(i, k));
      // A line in the midst of others would become a thread; what overlaps then is drawn apart.
      if (beside)
        room = std::max(beside(foot, ray, rays.lengths(i, k), room), std::min(room, least_beside * rays.lengths(i, k)));
      rooms.room(i, k) = std::max(room, gap);
    }
  const auto filled = [&] {
    if (beside) return share_out(rooms);
    Eigen::MatrixXd lengths(count, sections);
    for (Eigen::Index k = 0; k < sections; ++k) lengths.col(k) = rooms.filled(k, 1);
    return lengths;
  };
  const Eigen::MatrixXd before = filled();
  Eigen::MatrixXd lengths = drawn_off_ridges(rays, before, bones);
  // What that takes goes elsewhere in the section; among others there is no room for it.
  if (!beside && lengths != before) {
    rooms.room = (lengths.array() < before.array()).select(lengths, rooms.room);
    lengths = drawn_off_ridges(rays, filled(), bones);
  }
  const Real volume_share = rooms.volume(lengths) / rooms.volume(rays.lengths);
  return {std::move(lengths), volume_share};
}

ClearSections clear_of_bones(const Points& line, const Eigen::VectorXd& radii, int rays,
                             const std::vector<SolidBone>& bones, const RoomBeside& beside) {
  const Points centers = clear_centers(line, radii, bones);
  const SectionFrames frames = section_frames(centers, Vec3::UnitX());
  SectionRays round{Points(3, rays * line.cols()), Points(3, rays * line.cols()), radii.transpose().replicate(rays, 1)};
  for (Eigen::Index k = 0; k < line.cols(); ++k)
    for (int i = 0; i < rays; ++i) {
      round.feet.col(k * rays + i) = centers.col(k);
      round.directions.col(k * rays + i) = frames.ray(k, i, rays);
    }
  ClearRays clear = clear_rays(round, bones, beside);
  return {centers, std::move(clear.lengths), clear.volume_share};
}

}  // namespace gracilis::opensim
