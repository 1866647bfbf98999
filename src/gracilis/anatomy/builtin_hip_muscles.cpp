#include <gracilis/anatomy/builtin_hip_muscles.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace gracilis::builtin_hip_shapes {

namespace {

constexpr Real grid_step = 0.002;
constexpr Real rounding = 0.004;  ///< of the rims where a muscle meets what it is cut by
constexpr Real thinnest = -0.006, thickest = 0.010;

/// The two fields that make a muscle, on one grid: its own sheet, and how deep a node lies in the obstacles'
/// surroundings.
struct MuscleFields {
  SampledSolid body;
  std::vector<Real> blocked;

  /// The muscle with its sheet thickened by `swelling`.
  SampledSolid shape(Real swelling) const {
    SampledSolid result = body;
    for (std::size_t i = 0; i < blocked.size(); ++i)
      result.values[i] = smooth_maximum(body.values[i] - swelling, blocked[i], rounding);
    return result;
  }
};

MuscleFields sample_fields(const MusclePlan& plan, const std::vector<Obstacle>& obstacles) {
  ImplicitSolid sheet = thick_sheet(plan.net);
  // Room for swelling.
  sheet.bounds.extend(sheet.bounds.max() + Vec3::Constant(thickest));
  sheet.bounds.extend(sheet.bounds.min() - Vec3::Constant(thickest));
  MuscleFields fields{sample(sheet, grid_step), {}};
  fields.blocked.assign(fields.body.values.size(), -far_distance);
  parallel_for(fields.body.node_count(), 2048, [&](Index begin, Index end) {
    for (Index node = begin; node < end; ++node) {
      if (fields.body.values[node] > thickest + rounding) continue;
      const Vec3 point = fields.body.node(node);
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

/// Volume inside, each node counting for its cell with a ramp one step wide across the surface.
Real approximate_volume(const SampledSolid& shape) {
  Real cells = 0;
  for (Real value : shape.values) cells += std::clamp(0.5 - value / shape.step, 0.0, 1.0);
  return cells * std::pow(shape.step, 3);
}

Real swelling_for(const MuscleFields& fields, Real volume) {
  Real low = thinnest, high = thickest;
  for (int i = 0; i < 12; ++i) {
    const Real middle = (low + high) / 2;
    (approximate_volume(fields.shape(middle)) < volume ? low : high) = middle;
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

}  // namespace gracilis::builtin_hip_shapes
