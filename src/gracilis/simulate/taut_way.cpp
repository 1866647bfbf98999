#include <gracilis/simulate/taut_way.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/simulate/pose_steps.hpp>
#include <gracilis/simulate/taut_string.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace {

constexpr Real spacing = 0.008;  ///< m between a string's points; bones that one may lie across are thicker
constexpr Index fewest_parts = 8, most_parts = 64;
constexpr int sweeps_at_first = 500, sweeps_per_step = 40;
constexpr Real largest_turn = radians(2);
constexpr Real largest_slide = 0.005;  ///< m

Points string_along(const Points& line) {
  const auto wanted = static_cast<Index>(std::ceil(polyline_length(line) / spacing));
  return resampled(line, std::clamp(wanted, fewest_parts, most_parts));
}

std::vector<RigidTransform> bone_motions(const BoneSpace& space, const std::vector<RigidTransform>& from,
                                         const std::vector<RigidTransform>& to) {
  std::vector<RigidTransform> motions;
  for (std::size_t b = 0; b < space.count(); ++b) motions.push_back(to[space.body(b)] * from[space.body(b)].inverse());
  return motions;
}

}  // namespace

TautWays::TautWays(const BoneSpace& space, std::size_t body_count, const std::vector<MuscleLines>& lines)
    : space_(space), bodies_(body_count, RigidTransform::Identity()) {
  for (const MuscleLines& muscle : lines) {
    offsets_.push_back(ways_.size());
    for (Index i = 0; i < muscle.lines.count(); ++i) {
      const Points line = muscle.lines.line(i);
      ways_.push_back(
          {muscle.ends[static_cast<std::size_t>(i)], line.leftCols(1), line.rightCols(1), string_along(line)});
    }
  }
  offsets_.push_back(ways_.size());
  const PlacedBones bones(space_, bodies_);
  parallel_for_each(ways_.size(), [&](std::size_t i) { pull_tight(bones, ways_[i].points, sweeps_at_first); });
}

void TautWays::follow(const Pose& pose) {
  for (const std::vector<RigidTransform>& next : pose_steps(bodies_, pose.bodies, largest_turn, largest_slide)) {
    const PlacedBones before(space_, bodies_), now(space_, next);
    const std::vector<RigidTransform> motions = bone_motions(space_, bodies_, next);
    parallel_for(static_cast<Index>(ways_.size()), 4, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        TautWay& way = ways_[static_cast<std::size_t>(i)];
        carry_string(before, motions, way.points);
        way.points.col(0) = next[way.ends.first] * way.rest_first;
        way.points.rightCols(1) = next[way.ends.last] * way.rest_last;
        pull_tight(now, way.points, sweeps_per_step);
      }
    });
    bodies_ = next;
  }
}

}  // namespace gracilis
