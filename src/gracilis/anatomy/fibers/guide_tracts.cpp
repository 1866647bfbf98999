#include <gracilis/anatomy/fibers/guide_tracts.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/principal_axes.hpp>

#include <algorithm>
#include <map>

namespace gracilis {

/// The direction of the line that fits points best, turned to go on as they do; zero where they are one point.
static Vec3 fitted_direction(const Points& points) {
  const PrincipalAxes spread = spread_of(points);
  const Vec3 chord = points.rightCols(1) - points.leftCols(1), axis = spread.most();
  if (!(spread.values[2] > 0)) return Vec3::Zero();
  return axis.dot(chord) < 0 ? Vec3(-axis) : axis;
}

std::vector<DirectionSample> samples_of_tracts(const SolidGrid& grid, const Polylines& tracts) {
  constexpr Index pieces = 24, window = 4;  // half of a third
  std::vector<DirectionSample> samples;
  for (Index t = 0; t < tracts.count(); ++t) {
    const Points line = resampled(tracts.line(t), pieces);
    const Real length = polyline_length(line);
    if (!(length > 0)) continue;
    for (Index i = 0; i <= pieces; i += 2) {
      const Index begin = std::max(0, i - window), end = std::min(pieces, i + window);
      const Vec3 direction = fitted_direction(line.middleCols(begin, end - begin + 1));
      const Vec3 place = line.middleCols(begin, end - begin + 1).rowwise().mean();
      if (direction.squaredNorm() > 0 && grid.depth(place) > -grid.step() / 2)
        samples.push_back({place, direction, length / pieces, t});
    }
  }
  return samples;
}

Eigen::VectorXd inner_origin_to_insertion(const SolidGrid& grid, const Muscle& muscle) {
  const Eigen::VectorXd areas = vertex_areas(muscle.surface.vertices, muscle.surface.faces);
  // The energy of directions is that of three harmonic fields, of which the first is wanted.
  std::vector<DirectionSample> held;
  for (const Attachment& attachment : muscle.attachments)
    for (const Index v : attachment.vertices)
      held.push_back(
          {muscle.surface.vertices.col(v), Vec3(attachment.end == AttachmentEnd::insertion ? 1 : 0, 0, 0), areas[v]});
  return smooth_directions(grid, held, grid.step(), Points::Zero(3, grid.count())).row(0).transpose();
}

Vec3 field_growth(const SolidGrid& grid, const Eigen::VectorXd& field, const Vec3& p) {
  const auto value = [&](const Vec3& q) {
    const SolidGrid::Place at = grid.place(q);
    Real sum = 0;
    for (std::size_t k = 0; k < 8 && at.is_known; ++k) sum += at.weights[k] * field[at.nodes[k]];
    return sum;
  };
  Vec3 result;
  for (Index k = 0; k < 3; ++k) {
    const Vec3 step = grid.step() / 4 * Vec3::Unit(k);
    result[k] = 2 * (value(p + step) - value(p - step));
  }
  return result;
}

void turn_along(const SolidGrid& grid, const Eigen::VectorXd& field, std::vector<DirectionSample>& samples) {
  std::map<Index, Real> grown;
  for (const DirectionSample& sample : samples)
    grown[sample.tract] += sample.weight * field_growth(grid, field, sample.place).dot(sample.direction);
  for (DirectionSample& sample : samples)
    if (grown[sample.tract] < 0) sample.direction = -sample.direction;
}

}  // namespace gracilis
