#include <gracilis/anatomy/fibers/aponeurosis_guides.hpp>

#include <gracilis/anatomy/attachments/attachment_samples.hpp>
#include <gracilis/anatomy/fibers/guide_tracts.hpp>
#include <gracilis/geometry/assignment.hpp>
#include <gracilis/geometry/mesh_pieces.hpp>
#include <gracilis/geometry/principal_axes.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

TriangleMesh aponeuroses_of(const Muscle& muscle, std::optional<AttachmentEnd> end) {
  std::vector<TriangleMesh> surfaces;
  for (const Aponeurosis& each : muscle.aponeuroses)
    if (!end || each.end == *end) surfaces.push_back(each.surface);
  return merged(surfaces);
}

/// Points spread over where fibers begin or end.
static Points end_points(const Muscle& muscle, AttachmentEnd end, Index count) {
  const TriangleMesh sheets = aponeuroses_of(muscle, end);
  return sheets.face_count() > 0 ? surface_points(sheets, count) : attachment_samples(muscle, end, count);
}

Polylines lines_between_ends(const Muscle& muscle, Index count) {
  const Points begins = end_points(muscle, AttachmentEnd::origin, count);
  const Points ends = end_points(muscle, AttachmentEnd::insertion, count);
  Eigen::MatrixXd costs(count, count);
  for (Index i = 0; i < count; ++i) costs.row(i) = (ends.colwise() - begins.col(i)).colwise().squaredNorm();
  const std::vector<Index> end_of = cheapest_assignment(costs);
  Polylines lines;
  for (Index i = 0; i < count; ++i) {
    Points line(3, 2);
    line << begins.col(i), ends.col(end_of[static_cast<std::size_t>(i)]);
    lines.append(line);
  }
  return lines;
}

bool attachments_are_spread(const Muscle& muscle) {
  constexpr Index count = 100;
  const Polylines lines = lines_between_ends(muscle, count);
  Vec3 sum = Vec3::Zero();
  Real length = 0;
  for (Index i = 0; i < count; ++i) {
    const Vec3 way = lines.points.col(2 * i + 1) - lines.points.col(2 * i);
    sum += way;
    length += way.norm() / count;
  }
  const Vec3 along = sum.normalized();
  std::vector<Real> begins, ends;
  for (Index i = 0; i < count; ++i) {
    begins.push_back(along.dot(lines.points.col(2 * i)));
    ends.push_back(along.dot(lines.points.col(2 * i + 1)));
  }
  std::sort(begins.begin(), begins.end());
  std::sort(ends.begin(), ends.end());
  const Real overlap = begins[count * 9 / 10] - ends[count / 10];  // a few stray vertices do not count
  return overlap > length / 2;
}

std::vector<DirectionSample> pennate_directions(const SolidGrid& grid, const Muscle& muscle) {
  std::vector<Index> inside;
  for (Index n = 0; n < grid.count(); ++n)
    if (grid.depths()[static_cast<std::size_t>(n)] > 0) inside.push_back(n);
  Points places(3, static_cast<Index>(inside.size()));
  for (std::size_t i = 0; i < inside.size(); ++i) places.col(static_cast<Index>(i)) = grid.nodes().col(inside[i]);
  const Vec3 thin = spread_of(places).least();
  const Vec3 origin = attachment_center(muscle, AttachmentEnd::origin);
  const Vec3 insertion = attachment_center(muscle, AttachmentEnd::insertion);
  const Real aside = thin.dot(insertion - origin);
  const Real angle = aside < 0 ? -muscle.fibers.pennation : muscle.fibers.pennation;
  const Eigen::VectorXd field = inner_origin_to_insertion(grid, muscle);
  std::vector<DirectionSample> samples;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const Vec3 place = places.col(static_cast<Index>(i));
    const Vec3 along = field_growth(grid, field, place).normalized();
    const Vec3 across = (thin - thin.dot(along) * along).normalized();
    if (along.squaredNorm() > 0 && across.squaredNorm() > 0)
      samples.push_back({place, std::cos(angle) * along + std::sin(angle) * across, 1, static_cast<Index>(i)});
  }
  return samples;
}

}  // namespace gracilis
