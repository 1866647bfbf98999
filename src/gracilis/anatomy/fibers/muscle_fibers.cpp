#include <gracilis/anatomy/fibers/muscle_fibers.hpp>

#include <gracilis/anatomy/attachments/attachment_samples.hpp>
#include <gracilis/anatomy/fibers/fascicles.hpp>
#include <gracilis/anatomy/fibers/inner_fibers.hpp>
#include <gracilis/anatomy/fibers/superficial_fibers.hpp>
#include <gracilis/geometry/angle_between.hpp>

#include <algorithm>
#include <numeric>

namespace gracilis {

/// Lines that begin nearer to the origin than they end, with as many segments as asked for.
static Polylines prepared(const Polylines& given, const Muscle& muscle) {
  const Vec3 origin = attachment_center(muscle, AttachmentEnd::origin);
  std::vector<Points> lines;
  for (Index i = 0; i < given.count(); ++i) {
    Points line = given.line(i);
    if ((line.rightCols(1) - origin).norm() < (line.leftCols(1) - origin).norm())
      line = line.rowwise().reverse().eval();
    lines.push_back(resampled(line, muscle.fibers.segments));
  }
  return join(lines);
}

static bool has_end(const Muscle& muscle, AttachmentEnd end) {
  return std::any_of(muscle.attachments.begin(), muscle.attachments.end(),
                     [&](const Attachment& attachment) { return attachment.end == end; });
}

static bool wants_fibers(const Muscle& muscle) {
  return muscle.fibers.count > 0 && has_end(muscle, AttachmentEnd::origin) && has_end(muscle, AttachmentEnd::insertion);
}

Polylines fibers_of(const Muscle& muscle) {
  if (!wants_fibers(muscle)) return {};
  if (muscle.given_fibers.count() == 0)
    if (Polylines fascicles = fascicles_of(muscle); fascicles.count() > 0) return fascicles;
  return attached_fibers_of(muscle);
}

Polylines attached_fibers_of(const Muscle& muscle) {
  if (!wants_fibers(muscle)) return {};
  if (muscle.given_fibers.count() == 0) return inner_fibers(muscle);
  if (muscle.given_are_superficial) return filled_between(muscle, muscle.given_fibers);
  return prepared(muscle.given_fibers, muscle);
}

/// Unit direction of the first tenth of a line.
static Vec3 direction_at_begin(const Points& line) {
  const Points even = resampled(line, 10);
  return (even.col(1) - even.col(0)).normalized();
}

static std::vector<Real> angles_to_mean(const std::vector<Vec3>& directions) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& direction : directions) mean += direction;
  std::vector<Real> angles;
  for (const Vec3& direction : directions) angles.push_back(angle_between(direction, mean));
  return angles;
}

FiberMeasures measure_fibers(const Polylines& fibers) {
  FiberMeasures measures;
  measures.lengths = polyline_lengths(fibers);
  std::vector<Vec3> at_origin, at_insertion;
  for (Index i = 0; i < fibers.count(); ++i) {
    const Points line = fibers.line(i);
    at_origin.push_back(direction_at_begin(line));
    at_insertion.push_back(direction_at_begin(line.rowwise().reverse()));
  }
  measures.origin_pennation = angles_to_mean(at_origin);
  measures.insertion_pennation = angles_to_mean(at_insertion);
  return measures;
}

Real mean_fiber_length(const Polylines& fibers) {
  const std::vector<Real> lengths = polyline_lengths(fibers);
  return lengths.empty() ? 0 : std::accumulate(lengths.begin(), lengths.end(), Real{0}) / Real(lengths.size());
}

Real physiological_cross_section(Real volume, const Polylines& fibers) {
  const Real length = mean_fiber_length(fibers);
  return length > 0 ? volume / length : 0;
}

}  // namespace gracilis
