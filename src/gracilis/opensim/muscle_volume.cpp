#include <gracilis/opensim/muscle_volume.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/methods/cylinder/action_line.hpp>
#include <gracilis/methods/cylinder/cylinder_surface.hpp>
#include <gracilis/methods/cylinder/spindle.hpp>
#include <gracilis/opensim/muscle_path.hpp>

#include <algorithm>

namespace gracilis::opensim {

/// The path's points now, those that coincide once; with their bodies.
struct Line {
  Points points;
  std::vector<Index> bodies;
};

static Line line_of(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                    const Eigen::VectorXd& coordinates) {
  Line line;
  for (const CurrentPoint& point : current_points(model, muscle.path, poses, coordinates)) {
    const Eigen::Index n = line.points.cols();
    if (n > 0 && (line.points.col(n - 1) - point.place).norm() < 1e-4) continue;
    line.points.conservativeResize(3, n + 1);
    line.points.col(n) = point.place;
    line.bodies.push_back(point.body);
  }
  return line;
}

static std::vector<Index> section(Index k, Index rays) {
  std::vector<Index> vertices;
  for (Index i = 0; i < rays; ++i) vertices.push_back(k * rays + i);
  return vertices;
}

MuscleVolume muscle_volume(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                           const Eigen::VectorXd& coordinates, const VolumeSettings& settings) {
  const Line line = line_of(model, muscle, poses, coordinates);
  const Real length = line.points.cols() < 2 ? 0 : polyline_length(line.points);
  if (!(length > 1e-3))
    throw InputError({model.name, muscle.name, "has no path through space of 1 mm or more", "leave the muscle out"});
  int scaling = 1;
  while (scaling < 8 && length / static_cast<Real>((line.points.cols() - 1) << scaling) > settings.section_distance)
    ++scaling;
  const Points fine = subdivide_line(line.points, scaling);
  const std::vector<Real> places = distances_along(fine);
  const Eigen::VectorXd positions = Eigen::VectorXd::Map(places.data(), fine.cols());
  const MuscleSize size{muscle.max_isometric_force, muscle.optimal_fiber_length, muscle.pennation_angle_at_optimal,
                        settings.specific_tension};
  const Real rest = muscle.tendon_slack_length + muscle.optimal_fiber_length * std::cos(size.pennation);
  const Real tendon = 0.5 * muscle.tendon_slack_length * length / rest;
  const Eigen::VectorXd radii = spindle_radii(size, positions, tendon);

  MuscleVolume volume;
  const Index rays = settings.rays, sections = static_cast<Index>(fine.cols()), last = sections - 1;
  const SectionFrames frames = section_frames(fine, Vec3::UnitX());
  volume.surface.vertices = section_vertices(fine, frames, radii.transpose().replicate(rays, 1));
  volume.surface.faces = section_faces(sections, rays);
  volume.line = {line.points, line.bodies, rays, scaling, tendon};
  std::vector<Index> first_vertices = section(0, rays), last_vertices = section(last, rays);
  first_vertices.push_back(rays * sections);
  last_vertices.push_back(rays * sections + 1);
  volume.held.push_back({AttachmentEnd::origin, line.bodies.front(), std::move(first_vertices)});
  for (std::size_t i = 1; i + 1 < line.bodies.size(); ++i) {
    const auto k = static_cast<Index>(i) << scaling;
    if (positions[k] > length - tendon)
      volume.held.push_back({AttachmentEnd::insertion, line.bodies[i], section(k, rays)});
  }
  volume.held.push_back({AttachmentEnd::insertion, line.bodies.back(), std::move(last_vertices)});
  return volume;
}

}  // namespace gracilis::opensim
