#include <gracilis/opensim/import/muscle_volume.hpp>

#include <gracilis/anatomy/sections/cylinder_surface.hpp>
#include <gracilis/anatomy/sections/enhancement.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/opensim/import/muscle_line.hpp>
#include <gracilis/scene/section_line.hpp>

#include <algorithm>
#include <utility>

namespace gracilis::opensim {

static std::vector<Index> section(Index k, Index rays) {
  std::vector<Index> vertices;
  for (Index i = 0; i < rays; ++i) vertices.push_back(k * rays + i);
  return vertices;
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
    const ClearSections clear = settings.bones ? clear_of_bones(line, radii, settings.rays, *settings.bones,
                                                                room_left(settings.beside, {muscle.name}))
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
  volume.matches = sections.matches;
  for (std::size_t k = 0; k < sections.cut.size(); ++k)
    if (sections.cut[k] && !sections.inside[k]) ++volume.centers_outside;
  volume.sections_on_surface = static_cast<Index>(std::count(sections.cut.begin(), sections.cut.end(), true));
}

RoundMuscle round_muscle(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                         const Eigen::VectorXd& coordinates, const VolumeSettings& settings) {
  const MuscleLine line = muscle_line(model, muscle, poses, coordinates, settings);
  const Points fine = section_line(line.line).centers;
  const Eigen::VectorXd radii = radii_at(line, distances_along(fine));
  return {settings.bones ? clear_centers(fine, radii, *settings.bones) : fine, radii};
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
  const MuscleLine line = muscle_line(model, muscle, poses, coordinates, settings);
  const Points fine = section_line(line.line).centers;
  MuscleVolume volume;
  volume.line = line.line;
  volume.tendon_share = line.tendon_share;
  add_surface(fine, radii_at(line, distances_along(fine)), muscle, settings, volume);
  if (settings.tendon_sections) add_tendon_sections(volume);

  const Index rays = settings.rays, sections = (volume.surface.vertex_count() - 2) / rays, last = sections - 1;
  std::vector<Index> first_vertices = section(0, rays), last_vertices = section(last, rays);
  first_vertices.push_back(rays * sections);
  last_vertices.push_back(rays * sections + 1);
  volume.held = {HeldVertices{AttachmentEnd::origin, volume.line.bodies.front(), std::move(first_vertices)},
                 HeldVertices{AttachmentEnd::insertion, volume.line.bodies.back(), std::move(last_vertices)}};
  return volume;
}

}  // namespace gracilis::opensim
