#include <gracilis/simulate/fiber_tracker.hpp>

#include <gracilis/anatomy/fibers/muscle_fibers.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/cross_section.hpp>
#include <gracilis/geometry/measures.hpp>

#include <algorithm>

namespace gracilis {

FiberTracker::FiberTracker(const Scene& scene, const Frame* capture) : scene_(scene), muscles_(scene.muscles.size()) {
  parallel_for_each(muscles_.size(), [&](std::size_t m) {
    const Muscle& muscle = scene.muscles[m];
    Bound& bound = muscles_[m];
    if (muscle.fibers.count == 0) return;
    const bool known = capture && capture->muscles[m].fibers.count() > 0;
    bound.rest = known ? capture->muscles[m].fibers : fibers_of(muscle);
    if (bound.rest.count() == 0) return;
    bound.rest_lengths = polyline_lengths(bound.rest);
    if (!known) bound.binding.emplace(muscle.surface, bound.rest.points);
    bound.topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  });
}

MuscleFibers FiberTracker::follow(std::size_t muscle, const MuscleShape& shape) const {
  const Bound& bound = muscles_[muscle];
  MuscleFibers fibers;
  if (bound.rest.count() == 0) return fibers;
  fibers.lines = bound.rest;
  fibers.lines.points = bound.binding ? bound.binding->evaluate(shape.points) : shape.fibers.points;
  fibers.lengths = polyline_lengths(fibers.lines);
  const auto count = static_cast<Real>(fibers.lengths.size());
  for (std::size_t i = 0; i < fibers.lengths.size(); ++i) {
    fibers.mean_length += fibers.lengths[i] / count;
    if (bound.rest_lengths[i] > 0) fibers.mean_strain += (fibers.lengths[i] / bound.rest_lengths[i] - 1) / count;
  }
  if (shape.points.cols() == 0) return fibers;
  const TriangleMesh now = {shape.points, scene_.muscles[muscle].surface.faces};
  fibers.cross_section = largest_cross_section(now, bound.topology, fibers.lines);
  if (fibers.mean_length > 0)
    fibers.physiological_cross_section = enclosed_volume(now.vertices, now.faces) / fibers.mean_length;
  return fibers;
}

std::vector<MuscleFibers> FiberTracker::follow(const Frame& frame) const {
  std::vector<MuscleFibers> all(muscles_.size());
  parallel_for_each(all.size(), [&](std::size_t m) { all[m] = follow(m, frame.muscles[m]); });
  return all;
}

Real largest_cross_section(const TriangleMesh& surface, const MeshTopology& topology, const Polylines& fibers) {
  constexpr Index sections = 20;
  if (fibers.count() == 0) return 0;
  Points mean = Points::Zero(3, sections + 1);
  for (Index i = 0; i < fibers.count(); ++i) mean += resampled(fibers.line(i), sections) / fibers.count();
  Real largest = 0;
  for (Index k = sections / 5; k <= sections - sections / 5; ++k) {
    const Vec3 along = mean.col(k + 1) - mean.col(k - 1);
    if (along.norm() > 0)
      largest = std::max(largest, cross_section_area(surface, topology, mean.col(k), along.normalized()));
  }
  return largest;
}

}  // namespace gracilis
