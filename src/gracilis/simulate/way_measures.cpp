#include <gracilis/simulate/way_measures.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/angle_between.hpp>
#include <gracilis/simulate/taut_string.hpp>
#include <gracilis/simulate/wrong_side.hpp>

#include <algorithm>

namespace gracilis {

/// Coarse enough that a bone's bumps do not add up.
static constexpr Index turning_pieces = 8;

static Real turn_of(const Points& way) {
  const Points coarse = resampled(way, turning_pieces);
  Real turn = 0;
  for (Index i = 1; i < turning_pieces; ++i) {
    const Vec3 before = coarse.col(i) - coarse.col(i - 1), after = coarse.col(i + 1) - coarse.col(i);
    turn += angle_between(before, after);
  }
  return turn;
}

LineBesideWay beside_way(const Points& line, const Points& way) {
  const Points beside = resampled(line, static_cast<Index>(way.cols() - 1));
  return {polyline_length(line), polyline_length(way), turn_of(way), (beside - way).colwise().norm().mean()};
}

Real slack_of(const LineBesideWay& now, const LineBesideWay& rest) {
  if (!(rest.way > 0) || !(rest.length > 0)) return 0;
  const Real needed = now.way * rest.length / rest.way + rest.standoff * std::max(now.turn - rest.turn, Real{0});
  return std::max(now.length / std::max(needed, rest.length) - 1, Real{0});
}

WayMeasures::WayMeasures(const Scene& scene, const std::vector<SignedDistance>& exact, const FiberTracker* tracker)
    : tracker_(tracker),
      space_(scene, exact),
      lines_(scene, tracker),
      ways_(space_, scene.bodies.size(), lines_.rest()) {
  for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
    const Polylines& lines = lines_.rest()[m].lines;
    std::vector<LineBesideWay>& rest = rest_.emplace_back();
    for (Index i = 0; i < lines.count(); ++i)
      rest.push_back(beside_way(lines.line(i), ways_.of(m)[static_cast<std::size_t>(i)].points));
  }
}

std::vector<MuscleWay> WayMeasures::measure(const Frame& frame, const std::vector<MuscleFibers>& fibers) const {
  const std::vector<MuscleFibers> asked =
      fibers.empty() && tracker_ ? tracker_->follow(frame) : std::vector<MuscleFibers>(frame.muscles.size());
  const std::vector<MuscleFibers>& given = fibers.empty() ? asked : fibers;
  const PlacedBones bones(space_, frame.pose.bodies);
  std::vector<MuscleWay> all(frame.muscles.size());
  parallel_for_each(all.size(), [&](std::size_t m) {
    if (rest_[m].empty() || !frame.muscles[m].points.allFinite()) return;
    all[m] = measure(m, lines_.follow(m, frame.muscles[m].points, given[m]), bones);
  });
  return all;
}

MuscleWay WayMeasures::measure(std::size_t muscle, const Polylines& lines, const PlacedBones& bones) const {
  const std::vector<LineBesideWay>& rest = rest_[muscle];
  const Polylines& rest_lines = lines_.rest()[muscle].lines;
  const auto count = static_cast<Real>(rest.size());
  Real length = 0, rest_length = 0;
  MuscleWay measured;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const Points line = lines.line(static_cast<Index>(i)), rest_line = rest_lines.line(static_cast<Index>(i));
    const Points& way = ways_.of(muscle)[i].points;
    const LineBesideWay now = beside_way(line, way);
    length += now.length;
    rest_length += rest[i].length;
    measured.slack += slack_of(now, rest[i]) / count;
    measured.wrong_side += is_on_wrong_side(bones, line, rest_line, way) / count;
  }
  if (length > 0 && rest_length > 0) measured.length_ratio = length / rest_length;
  return measured;
}

}  // namespace gracilis
