#include <gracilis/opensim/import/neighbor_clearance.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/point_segment.hpp>
#include <gracilis/geometry/polylines.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gracilis::opensim {

static constexpr Real half_gap = 0.00025;     // m
static constexpr Real thin = 0.5;             // times a belly's radius; what is thicker shares the room with it
static constexpr Real side_by_side = 0.5;     // of both radii, that lines of muscles about as thick are apart
static constexpr Real most_lean = 0.5;        // mm per mm, of a line that gives way against where it ran
static constexpr Real farthest_aside = 0.03;  // m, that a center goes
static constexpr int rounds_of_giving_way = 8;
static constexpr int rounds_of_softening = 3;
static constexpr int steps = 16;  // along a ray, and halvings of the step in which it leaves its own room

namespace {

/// The place of a muscle's line that is nearest to a point in radii there.
struct NearestPlace {
  Real radii = std::numeric_limits<Real>::infinity();  ///< how far the point is from it, in radii
  Vec3 foot = Vec3::Zero();
  Real radius = 0;  ///< there, m
};

NearestPlace nearest_place(const RoundMuscle& muscle, const Vec3& p) {
  NearestPlace nearest;
  for (Eigen::Index k = 0; k + 1 < muscle.centers.cols(); ++k) {
    const Vec3 a = muscle.centers.col(k), b = muscle.centers.col(k + 1);
    const Real share = nearest_on_segment<Vec3>(p, a, b);
    const Vec3 foot = a + share * (b - a);
    const Real radius = muscle.radii[k] + share * (muscle.radii[k + 1] - muscle.radii[k]);
    if (const Real radii = (p - foot).norm() / radius; radii < nearest.radii) nearest = {radii, foot, radius};
  }
  return nearest;
}

/// How far a point is from a muscle's line, in radii there.
Real radii_from(const RoundMuscle& muscle, const Vec3& p) { return nearest_place(muscle, p).radii; }

}  // namespace

/// Whether any of the muscle may be nearer, in radii, to a point within `length` of the center.
static bool reaches(const RoundMuscle& muscle, const Vec3& center, Real length) {
  const Vec3 low = muscle.centers.rowwise().minCoeff(), high = muscle.centers.rowwise().maxCoeff();
  return (low - center).cwiseMax(center - high).cwiseMax(0.0).norm() < 3 * (muscle.radii.maxCoeff() + length);
}

RoomBeside room_beside(std::vector<RoundMuscle> muscles) {
  return [muscles = std::move(muscles)](const Vec3& center, const Vec3& ray, Real radius, Real length) {
    std::vector<const RoundMuscle*> near;
    for (const RoundMuscle& muscle : muscles)
      if (reaches(muscle, center, length)) near.push_back(&muscle);
    const auto is_own = [&](Real way) {
      const Vec3 p = center + (way + half_gap) * ray;
      return std::all_of(near.begin(), near.end(),
                         [&](const RoundMuscle* muscle) { return radii_from(*muscle, p) * radius > way + half_gap; });
    };
    Real own = 0, step = length / steps;
    while (own < length && is_own(std::min(own + step, length))) own = std::min(own + step, length);
    for (int i = 0; i < steps && own < length; ++i) {
      step /= 2;
      if (is_own(own + step)) own += step;
    }
    return own;
  };
}

/// How far a section is to be from a place of another muscle, m, and how much of the way there is its own.
struct GivingWay {
  Real distance = 0, share = 1;
};

/// A section with this radius goes beside what it is thin in; else both give way until both have room, but not to what
/// is thin in this one.
static GivingWay giving_way(const NearestPlace& place, Real radius) {
  const Real both = place.radius + radius;
  if (radius < thin * place.radius) return {both + 2 * half_gap, 1};
  if (place.radius < thin * radius) return {0, 0};
  return {side_by_side * both, place.radius / both};
}

/// Along a unit direction from a point that is `from` a center, how far it is to where it is `distance` from that.
static Real way_to_distance(const Vec3& from, const Vec3& direction, Real distance) {
  const Real along = from.dot(direction);
  return std::sqrt(std::max(along * along - from.squaredNorm() + distance * distance, 0.0)) - along;
}

/// The ways of a muscle's sections out of another; zero for those that are far enough from its line. All that follow
/// each other go to the side to which they lie from it on the whole.
static Points ways_out(const RoundMuscle& muscle, const RoundMuscle& other) {
  const Eigen::Index count = muscle.centers.cols();
  Points from(3, count), ways = Points::Zero(3, count);
  std::vector<GivingWay> wanted(static_cast<std::size_t>(count));
  Eigen::Index begin = 0;
  for (Eigen::Index k = 0; k <= count; ++k) {
    if (k < count) {
      const Vec3 center = muscle.centers.col(k);
      const NearestPlace place = nearest_place(other, center);
      from.col(k) = center - place.foot;
      GivingWay& own = wanted[static_cast<std::size_t>(k)] = giving_way(place, muscle.radii[k]);
      if (from.col(k).norm() < own.distance) continue;
    }
    const Vec3 side = from.middleCols(begin, k - begin).rowwise().sum();
    for (Eigen::Index i = begin; i < k && side.norm() > 0; ++i) {
      const auto& [distance, share] = wanted[static_cast<std::size_t>(i)];
      ways.col(i) = share * way_to_distance(from.col(i), side.normalized(), distance) * side.normalized();
    }
    begin = k + 1;
  }
  return ways;
}

/// Makes columns at least as long as their neighbors less what the line may lean over the distance between them.
static void take_along(const Points& line, Points& shift) {
  const auto follow = [&](Eigen::Index k, Eigen::Index leader) {
    const Real led = shift.col(leader).norm() - most_lean * (line.col(k) - line.col(leader)).norm();
    if (led > shift.col(k).norm()) shift.col(k) = led * shift.col(leader).normalized();
  };
  for (Eigen::Index k = 1; k < line.cols(); ++k) follow(k, k - 1);
  for (Eigen::Index k = line.cols() - 1; k > 0; --k) follow(k - 1, k);
}

/// Makes columns no longer than what the line may lean from its ends, which stay, nor than `farthest_aside`.
static void hold_ends(const Points& line, Points& shift) {
  const std::vector<Real> places = distances_along(line);
  for (Eigen::Index k = 0; k < line.cols(); ++k) {
    const Real place = places[static_cast<std::size_t>(k)];
    const Real most = std::min(most_lean * std::min(place, places.back() - place), farthest_aside);
    if (shift.col(k).norm() > most) shift.col(k) *= most / shift.col(k).norm();
  }
}

/// Whether no section of one can be as near to the other as giving_way asks.
static bool are_far_apart(const RoundMuscle& a, const RoundMuscle& b) {
  return bounding_box(a.centers).exteriorDistance(bounding_box(b.centers)) >
         a.radii.maxCoeff() + b.radii.maxCoeff() + 2 * half_gap;
}

/// The centers after one round of giving way; `line` is where they were before the first.
static Points given_way(const Points& line, const RoundMuscle& muscle, const std::vector<RoundMuscle>& others) {
  Points longest = Points::Zero(3, line.cols());
  for (const RoundMuscle& other : others) {
    if (are_far_apart(muscle, other)) continue;
    const Points ways = ways_out(muscle, other);
    for (Eigen::Index k = 0; k < line.cols(); ++k)
      if (ways.col(k).squaredNorm() > longest.col(k).squaredNorm()) longest.col(k) = ways.col(k);
  }
  if (longest.isZero(0)) return muscle.centers;
  Points shift = muscle.centers + longest - line;
  take_along(line, shift);
  for (int round = 0; round < rounds_of_softening; ++round) {
    const Points before = shift;
    for (Eigen::Index k = 1; k + 1 < line.cols(); ++k)
      shift.col(k) = (before.col(k - 1) + 2 * before.col(k) + before.col(k + 1)) / 4;
  }
  hold_ends(line, shift);
  return line + shift;
}

Points beside_bellies(const RoundMuscle& muscle, const std::vector<RoundMuscle>& others) {
  return given_way(muscle.centers, muscle, others);
}

static std::vector<RoundMuscle> all_but(const std::vector<std::string>& names,
                                        const std::map<std::string, RoundMuscle>& muscles) {
  std::vector<RoundMuscle> others;
  for (const auto& [name, muscle] : muscles)
    if (std::find(names.begin(), names.end(), name) == names.end()) others.push_back(muscle);
  return others;
}

/// Where centers come on their way to others before there is a bone.
static Points before_bones(const Points& from, const Points& to, const std::vector<SolidBone>& bones) {
  Points reached = from;
  for (Eigen::Index k = 0; k < from.cols(); ++k) {
    const Vec3 way = to.col(k) - from.col(k);
    if (const Real length = way.norm(); length > 0)
      reached.col(k) += way_along(bones, from.col(k), way / length, length) / length * way;
  }
  return reached;
}

std::map<std::string, RoundMuscle> beside_bellies(const std::map<std::string, RoundMuscle>& muscles,
                                                  const std::vector<SolidBone>& bones) {
  std::map<std::string, RoundMuscle> beside = muscles;
  for (int round = 0; round < rounds_of_giving_way; ++round) {
    const std::map<std::string, RoundMuscle> before = beside;
    for (auto& [name, muscle] : beside) {
      const Points wanted = given_way(muscles.at(name).centers, before.at(name), all_but({name}, before));
      muscle.centers = before_bones(muscle.centers, wanted, bones);
    }
  }
  for (auto& [name, muscle] : beside) muscle.centers = clear_centers(muscle.centers, muscle.radii, bones);
  return beside;
}

RoomBeside room_left(const std::map<std::string, RoundMuscle>& all, const std::vector<std::string>& own) {
  std::vector<RoundMuscle> others = all_but(own, all);
  return others.empty() ? RoomBeside{} : room_beside(std::move(others));
}

}  // namespace gracilis::opensim
