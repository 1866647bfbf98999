#include <gracilis/anatomy/builtin/builtin_muscles.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/surface_remeshing.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace gracilis::builtin_shapes {

namespace {

constexpr Real grid_step = 0.0025;
constexpr Real rounding = 0.006;  ///< of the rims where a muscle meets what it is cut by
constexpr Real thinnest = -0.006, thickest = 0.006;

/// Replaces every value by the mean of the 2 reach + 1 nodes around it along one axis; beyond the border the last value
/// counts on.
void average_along(std::vector<Real>& values, const Eigen::Vector3i& nodes, int axis, int reach) {
  const Index stride = axis == 0 ? 1 : axis == 1 ? nodes.x() : nodes.x() * nodes.y();
  const Index length = nodes[axis], lines = nodes.prod() / length;
  parallel_for(lines, 256, [&](Index begin, Index end) {
    std::vector<Real> line(length);
    for (Index l = begin; l < end; ++l) {
      // The first node of line l: lines are counted in the order of their first nodes.
      Real* const first = values.data() + (l / stride) * stride * length + l % stride;
      for (Index i = 0; i < length; ++i) line[i] = first[i * stride];
      const auto at = [&](Index i) { return line[std::clamp(i, 0, length - 1)]; };
      Real sum = 0;
      for (Index i = -reach; i <= reach; ++i) sum += at(i);
      for (Index i = 0; i < length; ++i) {
        first[i * stride] = sum / (2 * reach + 1);
        sum += at(i + reach + 1) - at(i - reach);
      }
    }
  });
}

/// The fields that make a muscle, on one grid: its own sheet, how deep a node lies in the obstacles' surroundings, and
/// how much of belly (1) or tendon (0) it is; empty where all is belly.
struct MuscleFields {
  SampledSolid body;
  std::vector<Real> blocked;
  std::vector<Real> belly;
  int averaging_passes = 0;

  /// The muscle with the sheet of its belly thickened by `swelling`. Averaging leaves flat places alone but takes away
  /// what is thinner than about 5 mm, such as the feather edges between bone and sheet, and rounds rims; tendons are
  /// spared. Then obstacles are cut away once more.
  SampledSolid shape(Real swelling) const {
    SampledSolid result = body;
    const auto share = [&](std::size_t node) { return belly.empty() ? 1 : belly[node]; };
    for (std::size_t i = 0; i < blocked.size(); ++i)
      result.values[i] =
          smooth_maximum(body.values[i] - share(i) * swelling, blocked[i], (0.25 + 0.75 * share(i)) * rounding);
    const std::vector<Real> as_cut = belly.empty() ? std::vector<Real>() : result.values;
    for (int pass = 0; pass < averaging_passes; ++pass)
      for (int axis = 0; axis < 3; ++axis) average_along(result.values, result.nodes, axis, 1);
    for (std::size_t i = 0; i < as_cut.size(); ++i)
      result.values[i] = belly[i] * result.values[i] + (1 - belly[i]) * as_cut[i];
    for (std::size_t i = 0; i < blocked.size(); ++i)
      result.values[i] = smooth_maximum(result.values[i], blocked[i], rounding / 4);
    return result;
  }
};

/// Where on the way from origin to insertion the belly is, with soft ends.
Real belly_share(const MusclePlan& plan, Real along) {
  constexpr Real ramp = 0.06;
  const auto rise = [](Real t) { return std::clamp(0.5 + t / (2 * ramp), 0.0, 1.0); };
  return (plan.belly_from > 0 ? rise(along - plan.belly_from) : 1) *
         (plan.belly_until < 1 ? rise(plan.belly_until - along) : 1);
}

MuscleFields sample_fields(const MusclePlan& plan, const std::vector<Obstacle>& obstacles) {
  ImplicitSolid sheet = thick_sheet(plan.net);
  // Room for swelling.
  sheet.bounds.extend(sheet.bounds.max() + Vec3::Constant(thickest));
  sheet.bounds.extend(sheet.bounds.min() - Vec3::Constant(thickest));
  // A mean of three nodes has the variance 2/3 step².
  const int passes = static_cast<int>(std::lround(1.5 * std::pow(plan.roundness / grid_step, 2)));
  MuscleFields fields{sample(sheet, grid_step), {}, {}, passes};
  fields.blocked.assign(fields.body.values.size(), -far_distance);
  const bool has_tendon = plan.belly_from > 0 || plan.belly_until < 1;
  if (has_tendon) fields.belly.assign(fields.body.values.size(), 1);
  const ThickSheet net(plan.net);
  parallel_for(fields.body.node_count(), 2048, [&](Index begin, Index end) {
    for (Index node = begin; node < end; ++node) {
      if (fields.body.values[node] > thickest + rounding) continue;
      const Vec3 point = fields.body.node(node);
      if (has_tendon) fields.belly[node] = belly_share(plan, net.nearest(point).along);
      for (const Obstacle& obstacle : obstacles) {
        const Real outside = obstacle.solid.bounds.exteriorDistance(point);
        if (outside > far_distance) continue;
        fields.blocked[node] =
            smooth_maximum(fields.blocked[node], obstacle.gap - obstacle.solid.distance(point), rounding / 2);
      }
    }
  });
  return fields;
}

/// Volume inside; each node counts for its cell, with a ramp one step wide across the surface.
Real approximate_volume(const SampledSolid& shape) {
  Real cells = 0;
  for (Real value : shape.values) cells += std::clamp(0.5 - value / shape.step, 0.0, 1.0);
  return cells * std::pow(shape.step, 3);
}

/// The swelling that gives the volume to within one percent, by false position kept inside the bracket.
Real swelling_for(const MuscleFields& fields, Real volume) {
  Real low = thinnest, high = thickest;
  Real missing_low = approximate_volume(fields.shape(low)) - volume,
       missing_high = approximate_volume(fields.shape(high)) - volume;
  for (int i = 0; i < 8; ++i) {
    const Real share = std::clamp(missing_low / (missing_low - missing_high), 0.1, 0.9);
    const Real middle = low + share * (high - low), missing = approximate_volume(fields.shape(middle)) - volume;
    if (std::abs(missing) < 0.01 * volume) return middle;
    (missing < 0 ? low : high) = middle;
    (missing < 0 ? missing_low : missing_high) = missing;
  }
  return (low + high) / 2;
}

Real edge_length_for(const TriangleMesh& surface, Index faces) {
  return std::sqrt(4 / std::sqrt(3.0) * surface_area(surface.vertices, surface.faces) / faces);
}

}  // namespace

ShapedMuscle shape_muscle(const MusclePlan& plan, const std::vector<Obstacle>& obstacles) {
  const MuscleFields fields = sample_fields(plan, obstacles);
  Real swelling = swelling_for(fields, plan.volume);
  ShapedMuscle muscle{{}, fields.shape(swelling)};
  const TriangleMesh fine = largest_component(extract_surface(muscle.shape));
  muscle.surface = remesh(fine, muscle.shape, edge_length_for(fine, plan.faces));
  // Triangles cut corners: a few small corrections give the mesh the volume that the grid only approximates.
  for (int i = 0; i < 6; ++i) {
    const Real missing = plan.volume - enclosed_volume(muscle.surface.vertices, muscle.surface.faces);
    if (std::abs(missing) < 0.002 * plan.volume) break;
    swelling += 1.4 * missing / surface_area(muscle.surface.vertices, muscle.surface.faces);
    muscle.shape = fields.shape(swelling);
    project_to_surface(muscle.surface, muscle.shape);
  }
  return muscle;
}

ImplicitSolid as_solid(SampledSolid shape) {
  const Vec3 last = shape.origin + shape.step * (shape.nodes - Eigen::Vector3i::Ones()).cast<Real>();
  const Eigen::AlignedBox3d bounds(shape.origin, last);
  return {[shape = std::make_shared<const SampledSolid>(std::move(shape)), bounds](const Vec3& point) {
            return bounds.exteriorDistance(point) + interpolate(*shape, point);
          },
          bounds};
}

}  // namespace gracilis::builtin_shapes
