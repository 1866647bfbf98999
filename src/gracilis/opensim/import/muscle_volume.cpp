#include <gracilis/opensim/import/muscle_volume.hpp>

#include <gracilis/anatomy/sections/action_line.hpp>
#include <gracilis/anatomy/sections/cylinder_surface.hpp>
#include <gracilis/anatomy/sections/enhancement.hpp>
#include <gracilis/anatomy/sections/spindle.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gracilis::opensim {

/// The path's points now, those that coincide once; with their bodies.
struct Line {
  Points points;
  std::vector<Index> bodies;
};

/// Points on wrap surfaces are 30 degrees apart at most; others less than 0.1 mm apart become one.
static Line line_of(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                    const Eigen::VectorXd& coordinates) {
  std::vector<Index> bodies;
  const Points all = line_through(current_points(model, muscle.path, poses, coordinates),
                                  placed_wraps(model, muscle.path, poses), radians(30), &bodies);
  Line line;
  for (Eigen::Index i = 0; i < all.cols(); ++i) {
    const Eigen::Index n = line.points.cols();
    if (n > 0 && (line.points.col(n - 1) - all.col(i)).norm() < 1e-4) continue;
    line.points.conservativeResize(3, n + 1);
    line.points.col(n) = all.col(i);
    line.bodies.push_back(bodies[static_cast<std::size_t>(i)]);
  }
  return line;
}

static std::vector<Index> section(Index k, Index rays) {
  std::vector<Index> vertices;
  for (Index i = 0; i < rays; ++i) vertices.push_back(k * rays + i);
  return vertices;
}

/// Origin's and insertion's tendon lengths on a line of this length, m: the slack length scaled as the line is.
static std::pair<Real, Real> tendons_on(const Muscle& muscle, Real length, TendonPlace place) {
  const Real rest =
      muscle.tendon_slack_length + muscle.optimal_fiber_length * std::cos(muscle.pennation_angle_at_optimal);
  const Real scaled = muscle.tendon_slack_length * length / rest;
  switch (place) {
    case TendonPlace::half_at_insertion:
      return {0, scaled / 2};
    case TendonPlace::whole_at_insertion:
      return {0, scaled};
    case TendonPlace::both_ends:
      return {scaled / 2, scaled / 2};
  }
  return {0, scaled / 2};
}

/// What the others leave to a muscle.
static RoomBeside room_of(const Muscle& muscle, const std::map<std::string, RoundMuscle>& beside) {
  std::vector<RoundMuscle> others;
  for (const auto& [name, other] : beside)
    if (name != muscle.name) others.push_back(other);
  return others.empty() ? RoomBeside{} : room_beside(std::move(others));
}

/// Sections along the line, brought onto the muscle's own surface where it is known.
static void add_surface(const Points& fine, const Eigen::VectorXd& radii, const Muscle& muscle,
                        const VolumeSettings& settings, MuscleVolume& volume) {
  const Eigen::MatrixXd round = radii.transpose().replicate(settings.rays, 1);
  volume.surface.faces = section_faces(static_cast<Index>(fine.cols()), settings.rays);
  const auto known = settings.surfaces.find(muscle.name);
  if (known == settings.surfaces.end()) {
    const ClearSections clear =
        settings.bones ? clear_of_bones(fine, radii, settings.rays, *settings.bones, room_of(muscle, settings.beside))
                       : ClearSections{fine, round};
    volume.volume_share = clear.volume_share;
    volume.surface.vertices =
        section_vertices(clear.centers, section_frames(clear.centers, Vec3::UnitX()), clear.radii);
    if (clear.centers != fine) volume.line.centers = clear.centers;
    return;
  }
  const EnhancedSections sections = enhance(fine, Vec3::UnitX(), round, known->second, settings.more_rays);
  volume.surface.vertices = section_vertices(sections.centers, sections.frames, sections.radii);
  volume.line.centers = sections.centers;
  volume.sections_on_surface = static_cast<Index>(std::count(sections.cut.begin(), sections.cut.end(), true));
}

/// A muscle before it gives way to anything: round sections along its line.
struct Spindle {
  ActionLine line;
  Points fine;
  Eigen::VectorXd radii;  ///< m
};

static Spindle spindle_of(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                          const Eigen::VectorXd& coordinates, const VolumeSettings& settings) {
  const Line line = line_of(model, muscle, poses, coordinates);
  const Real length = line.points.cols() < 2 ? 0 : polyline_length(line.points);
  if (!(length > 1e-3))
    throw InputError({model.name, muscle.name, "has no path through space of 1 mm or more", "leave the muscle out"});
  if (!(length < 10))
    throw InputError({model.name, muscle.name, fmt::format("has a path of {:.3g} m", length),
                      "longer than any muscle: check the places of its points"});
  if (!(muscle.max_isometric_force > 0))
    throw InputError({model.name, muscle.name, "has no force, so it has no volume", "leave the muscle out"});
  int scaling = 1;
  while (scaling < 8 && length / static_cast<Real>((line.points.cols() - 1) << scaling) > settings.section_distance)
    ++scaling;
  const Points fine = subdivide_line(line.points, scaling);
  const std::vector<Real> places = distances_along(fine);
  const Eigen::VectorXd positions = Eigen::VectorXd::Map(places.data(), fine.cols());
  const MuscleSize size{muscle.max_isometric_force, muscle.optimal_fiber_length, muscle.pennation_angle_at_optimal,
                        settings.specific_tension};
  if (!(tendon_radius(size) < length / 4))
    throw InputError({model.name, muscle.name,
                      fmt::format("has a force of {:.3g} N on a line of {:.3g} m", muscle.max_isometric_force, length),
                      "its tendon would be thicker than long: check the force"});
  const auto [origin_tendon, tendon] = tendons_on(muscle, length, settings.tendon);

  Spindle spindle{{line.points, line.bodies, settings.rays, scaling, tendon, origin_tendon},
                  fine,
                  spindle_radii(size, positions, tendon, origin_tendon)};
  spindle.line.optimal_fiber = muscle.optimal_fiber_length;
  spindle.line.pennation = muscle.pennation_angle_at_optimal;
  return spindle;
}

RoundMuscle round_muscle(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                         const Eigen::VectorXd& coordinates, const VolumeSettings& settings) {
  const Spindle spindle = spindle_of(model, muscle, poses, coordinates, settings);
  if (!settings.bones) return {spindle.fine, spindle.radii};
  return {clear_centers(spindle.fine, spindle.radii, *settings.bones), spindle.radii};
}

MuscleVolume muscle_volume(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                           const Eigen::VectorXd& coordinates, const VolumeSettings& settings) {
  const Spindle spindle = spindle_of(model, muscle, poses, coordinates, settings);
  MuscleVolume volume;
  volume.line = spindle.line;
  add_surface(spindle.fine, spindle.radii, muscle, settings, volume);

  const Index rays = settings.rays, sections = static_cast<Index>(spindle.fine.cols()), last = sections - 1;
  std::vector<Index> first_vertices = section(0, rays), last_vertices = section(last, rays);
  first_vertices.push_back(rays * sections);
  last_vertices.push_back(rays * sections + 1);
  volume.held = {HeldVertices{AttachmentEnd::origin, spindle.line.bodies.front(), std::move(first_vertices)},
                 HeldVertices{AttachmentEnd::insertion, spindle.line.bodies.back(), std::move(last_vertices)}};
  return volume;
}

}  // namespace gracilis::opensim
