#include <gracilis/simulate/tracked_lines.hpp>

#include <gracilis/anatomy/fibers/inner_fibers.hpp>

#include <algorithm>
#include <limits>

namespace gracilis {

namespace {

constexpr Index most_lines = 12;
constexpr Index own_segments = 20;
/// Ends lie on attached triangles, which may be large, so vertices of theirs may be this far away, m.
constexpr Real end_reach = 0.015;

/// The body of the nearest vertex that is attached by this end of the muscle; none within reach.
std::optional<std::size_t> body_at(const Muscle& muscle, AttachmentEnd end, const Vec3& p) {
  Real nearest = end_reach * end_reach;
  std::optional<std::size_t> body;
  for (const Attachment& attachment : muscle.attachments) {
    if (attachment.end != end) continue;
    for (const Index v : attachment.vertices) {
      const Real squared = (muscle.surface.vertices.col(v) - p).squaredNorm();
      if (squared < nearest) nearest = squared, body = static_cast<std::size_t>(attachment.body);
    }
  }
  return body;
}

std::optional<EndBodies> ends_of(const Muscle& muscle, const Points& line) {
  const auto first = body_at(muscle, AttachmentEnd::origin, line.leftCols(1));
  const auto last = body_at(muscle, AttachmentEnd::insertion, line.rightCols(1));
  if (!first || !last) return {};
  return EndBodies{*first, *last};
}

bool has_end(const Muscle& muscle, AttachmentEnd end) {
  return std::any_of(muscle.attachments.begin(), muscle.attachments.end(), [&](const Attachment& attachment) {
    return attachment.end == end && !attachment.vertices.empty();
  });
}

/// Those of `fibers` that are chosen and lead from attachment to attachment; their numbers go to `chosen`.
MuscleLines some_of(const Muscle& muscle, const Polylines& fibers, std::vector<Index>& chosen) {
  MuscleLines some;
  const Index count = std::min(fibers.count(), most_lines);
  for (Index i = 0; i < count; ++i) {
    const Index fiber = (2 * i + 1) * fibers.count() / (2 * count);
    const Points line = fibers.line(fiber);
    const std::optional<EndBodies> ends = ends_of(muscle, line);
    if (!ends) continue;
    some.lines.append(line);
    some.ends.push_back(*ends);
    chosen.push_back(fiber);
  }
  return some;
}

MuscleLines own_lines(const Muscle& muscle) {
  Muscle with_few = muscle;
  with_few.fibers = {};
  with_few.fibers.count = most_lines;
  with_few.fibers.segments = own_segments;
  std::vector<Index> chosen;
  return some_of(muscle, inner_fibers(with_few), chosen);
}

}  // namespace

TrackedLines::TrackedLines(const Scene& scene, const FiberTracker* tracker)
    : rest_(scene.muscles.size()), chosen_(scene.muscles.size()), binding_(scene.muscles.size()) {
  for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
    const Muscle& muscle = scene.muscles[m];
    if (!has_end(muscle, AttachmentEnd::origin) || !has_end(muscle, AttachmentEnd::insertion)) continue;
    if (tracker) rest_[m] = some_of(muscle, tracker->rest(m), chosen_[m]);
    if (rest_[m].lines.count() > 0) continue;
    rest_[m] = own_lines(muscle);
    if (rest_[m].lines.count() > 0) binding_[m].emplace(muscle.surface, rest_[m].lines.points);
  }
}

Polylines TrackedLines::follow(std::size_t muscle, const Points& vertices, const MuscleFibers& fibers) const {
  if (asks_tracker(muscle)) {
    Polylines lines;
    for (const Index fiber : chosen_[muscle]) lines.append(fibers.lines.line(fiber));
    return lines;
  }
  Polylines lines = rest_[muscle].lines;
  if (binding_[muscle]) lines.points = binding_[muscle]->evaluate(vertices);
  return lines;
}

}  // namespace gracilis
