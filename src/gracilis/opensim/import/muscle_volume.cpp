#include <gracilis/opensim/import/muscle_volume.hpp>

#include <gracilis/anatomy/sections/cylinder_surface.hpp>
#include <gracilis/anatomy/sections/enhancement.hpp>
#include <gracilis/anatomy/sections/spindle.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/opensim/import/belly_length.hpp>
#include <gracilis/opensim/import/drawn_apart.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>
#include <gracilis/scene/section_line.hpp>

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

/// Origin's and insertion's tendon lengths on a line of this length, m. Slack lengths, and rest lengths by which
/// bellies grow, are those that fit_to_skeleton has scaled where the model was brought into another skeleton.
static std::pair<Real, Real> tendons_of(const Muscle& muscle, const VolumeSettings& settings, Real line) {
  const Real slack = muscle.tendon_slack_length;
  switch (settings.tendon) {
    case TendonPlace::beyond_belly:
      return {0, line - belly_on_line(muscle, settings.specific_tension, line)};
    case TendonPlace::half_at_insertion:
      return {0, slack / 2};
    case TendonPlace::whole_at_insertion:
      return {0, slack};
    case TendonPlace::both_ends:
      return {slack / 2, slack / 2};
  }
  return {0, slack / 2};
}

static std::vector<RoundMuscle> all_but(const std::string& name, const std::map<std::string, RoundMuscle>& muscles) {
  std::vector<RoundMuscle> others;
  for (const auto& [other, muscle] : muscles)
    if (other != name) others.push_back(muscle);
  return others;
}

/// What the others leave to a muscle.
static RoomBeside room_of(const Muscle& muscle, const std::map<std::string, RoundMuscle>& beside) {
  std::vector<RoundMuscle> others = all_but(muscle.name, beside);
  return others.empty() ? RoomBeside{} : room_beside(std::move(others));
}

std::map<std::string, RoundMuscle> tendons_beside_bellies(const std::map<std::string, RoundMuscle>& muscles,
                                                          const std::vector<SolidBone>& bones) {
  std::map<std::string, RoundMuscle> beside = muscles;
  for (auto& [name, muscle] : beside)
    muscle.centers = clear_centers(beside_bellies(muscle, all_but(name, muscles)), muscle.radii, bones);
  return beside;
}

/// Sections along the line, brought onto the muscle's own surface where it is known.
static void add_surface(const Points& fine, const Eigen::VectorXd& radii, const Muscle& muscle,
                        const VolumeSettings& settings, MuscleVolume& volume) {
  const Eigen::MatrixXd round = radii.transpose().replicate(settings.rays, 1);
  volume.surface.faces = section_faces(static_cast<Index>(fine.cols()), settings.rays);
  const auto known = settings.surfaces.find(muscle.name);
  if (known == settings.surfaces.end()) {
    const auto placed = settings.beside.find(muscle.name);
    const Points& line = placed == settings.beside.end() ? fine : placed->second.centers;
    const ClearSections clear =
        settings.bones ? clear_of_bones(line, radii, settings.rays, *settings.bones, room_of(muscle, settings.beside))
                       : ClearSections{fine, round};
    volume.volume_share = clear.volume_share;
    volume.surface.vertices =
        section_vertices(clear.centers, section_frames(clear.centers, Vec3::UnitX()), clear.radii);
    if (clear.centers != fine) volume.line.centers = clear.centers;
    return;
  }
  const EnhancedSections sections = enhance(fine, Vec3::UnitX(), round, known->second, settings.enhancement);
  volume.surface.vertices = section_vertices(sections.centers, sections.frames, sections.radii);
  volume.line.centers = sections.centers;
  for (std::size_t k = 0; k < sections.cut.size(); ++k)
    if (sections.cut[k] && !sections.inside[k]) ++volume.centers_outside;
  volume.sections_on_surface = static_cast<Index>(std::count(sections.cut.begin(), sections.cut.end(), true));
}

/// A muscle before it gives way to anything: round sections along its line.
struct Spindle {
  ActionLine line;
  Points fine;
  Eigen::VectorXd radii;  ///< m
  Real tendon_share = 1;
};

/// How often each part is halved so that sections are no farther apart than this (m) on average; once at least.
static int scaling_for(const Points& line, Real distance) {
  int scaling = 1;
  while (scaling < 16 && polyline_length(line) / std::ldexp(static_cast<Real>(line.cols() - 1), scaling) > distance)
    ++scaling;
  return scaling;
}

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
  const int scaling = settings.scaling.value_or(scaling_for(line.points, settings.section_distance));
  const Points fine = subdivide_line(line.points, scaling);
  const std::vector<Real> places = distances_along(fine);
  const Eigen::VectorXd positions = Eigen::VectorXd::Map(places.data(), fine.cols());
  const MuscleSize size{muscle.max_isometric_force, muscle.optimal_fiber_length, muscle.pennation_angle_at_optimal,
                        settings.specific_tension};
  if (!(tendon_radius(size) < length / 4))
    throw InputError({model.name, muscle.name,
                      fmt::format("has a force of {:.3g} N on a line of {:.3g} m", muscle.max_isometric_force, length),
                      "its tendon would be thicker than long: check the force"});
  auto [origin_tendon, tendon] = tendons_of(muscle, settings, length);
  // A fifth of the line at least is belly.
  const Real share = std::min(1.0, 0.8 * length / std::max(tendon + origin_tendon, 1e-9));
  origin_tendon *= share;
  tendon *= share;

  Spindle spindle{{line.points, line.bodies, settings.rays, scaling, tendon, origin_tendon, false},
                  fine,
                  spindle_radii(size, positions, tendon, origin_tendon)};
  spindle.tendon_share = share;
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

/// Columns with `more` put in before every block of `width` columns that `at` names; a new block lies between its
/// neighbors, by their shares.
static Points with_blocks(Points columns, Index width, const std::vector<Index>& at, const std::vector<Real>& shares) {
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Eigen::Index before = Eigen::Index{width} * at[i], after = columns.cols() - before;
    Points longer(3, columns.cols() + width);
    longer << columns.leftCols(before),
        (1 - shares[i]) * columns.middleCols(before - width, width) + shares[i] * columns.middleCols(before, width),
        columns.rightCols(after);
    columns = std::move(longer);
  }
  return columns;
}

/// Sections where tendons end, interpolated between their neighbors as published (Laclé 2014, section 3.4.3).
static void add_tendon_sections(MuscleVolume& volume) {
  volume.line.tendon_sections = true;
  const SectionLine sections = section_line(volume.line);
  const std::vector<Real> places = distances_along(sections.centers);
  std::vector<Real> shares;
  for (const Index k : sections.tendon_ends) {
    const auto at = static_cast<std::size_t>(k);
    // The next one may be an end of a tendon, too, which is not there yet.
    const bool twin =
        std::find(sections.tendon_ends.begin(), sections.tendon_ends.end(), k + 1) != sections.tendon_ends.end();
    shares.push_back((places[at] - places[at - 1]) / (places[at + (twin ? 2 : 1)] - places[at - 1]));
  }
  const Index rays = volume.line.rays;
  const Eigen::Index corners = volume.surface.vertices.cols() - 2;
  const Points rings = with_blocks(volume.surface.vertices.leftCols(corners), rays, sections.tendon_ends, shares);
  Points vertices(3, rings.cols() + 2);
  vertices << rings, volume.surface.vertices.rightCols(2);
  volume.surface = {vertices, section_faces(static_cast<Index>(sections.centers.cols()), rays)};
  if (volume.line.centers.cols() > 0)
    volume.line.centers = with_blocks(volume.line.centers, 1, sections.tendon_ends, shares);
}

MuscleVolume muscle_volume(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                           const Eigen::VectorXd& coordinates, const VolumeSettings& settings) {
  const Spindle spindle = spindle_of(model, muscle, poses, coordinates, settings);
  MuscleVolume volume;
  volume.line = spindle.line;
  volume.tendon_share = spindle.tendon_share;
  add_surface(spindle.fine, spindle.radii, muscle, settings, volume);
  if (settings.tendon_sections) add_tendon_sections(volume);

  const Index rays = settings.rays, sections = (volume.surface.vertex_count() - 2) / rays, last = sections - 1;
  std::vector<Index> first_vertices = section(0, rays), last_vertices = section(last, rays);
  first_vertices.push_back(rays * sections);
  last_vertices.push_back(rays * sections + 1);
  volume.held = {HeldVertices{AttachmentEnd::origin, spindle.line.bodies.front(), std::move(first_vertices)},
                 HeldVertices{AttachmentEnd::insertion, spindle.line.bodies.back(), std::move(last_vertices)}};
  return volume;
}

void draw_volumes_apart(std::vector<MuscleVolume>& volumes) {
  std::vector<MuscleVolume*> drawn;
  std::vector<SectionedSurface> surfaces;
  for (MuscleVolume& volume : volumes)
    if (volume.sections_on_surface == 0) {
      drawn.push_back(&volume);
      surfaces.push_back({volume.surface, section_line(volume.line).centers});
    }
  draw_apart(surfaces);
  for (std::size_t m = 0; m < drawn.size(); ++m) {
    TriangleMesh& before = drawn[m]->surface;
    const TriangleMesh& now = surfaces[m].surface;
    drawn[m]->volume_share *= enclosed_volume(now.vertices, now.faces) / enclosed_volume(before.vertices, before.faces);
    before = now;
  }
}

}  // namespace gracilis::opensim
