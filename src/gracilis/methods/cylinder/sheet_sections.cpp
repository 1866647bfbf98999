#include <gracilis/methods/cylinder/sheet_sections.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/polygon_area.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

/// Each vertex between where the heads' sections take it.
static Points carried(const SheetSections& sheet, const std::vector<PlacedSections>& placed) {
  Points vertices(3, sheet.places[0].cols());
  for (Index v = 0; v < static_cast<Index>(vertices.cols()); ++v) {
    const LineShare& share = sheet.shares[static_cast<std::size_t>(v)];
    const auto by = [&](std::size_t line) -> Vec3 {
      return placed[line].frame(share.section) * sheet.places[line].col(v);
    };
    vertices.col(v) = by(share.line);
    if (share.next > 0) vertices.col(v) += share.next * (by(share.line + 1) - vertices.col(v));
  }
  return vertices;
}

/// What belongs to each section: its area over half of the way between its neighbors, m³. Sections stand askew to it.
static Eigen::VectorXd volumes_of(const SheetSections& sheet, const Points& vertices) {
  const Index sections = static_cast<Index>(vertices.cols() - 2) / sheet.rays;
  const auto middle = [&](Index k) -> Vec3 { return vertices.middleCols(k * sheet.rays, sheet.rays).rowwise().mean(); };
  Eigen::VectorXd volumes(sections);
  for (Index k = 0; k < sections; ++k) {
    const Vec3 way = middle(std::min(k + 1, sections - 1)) - middle(std::max(k - 1, 0));
    volumes[k] = std::abs(polygon_area_vector(vertices.middleCols(k * sheet.rays, sheet.rays)).dot(way)) / 2;
  }
  return volumes;
}

static std::vector<PlacedSections> placed_sections(const SheetSections& sheet, const Pose& pose) {
  std::vector<PlacedSections> placed;
  for (const LineSections& line : sheet.lines) placed.push_back(sections_at(line, pose));
  return placed;
}

SheetSections sheet_sections(const Muscle& muscle, const Pose& capture) {
  const Points& vertices = muscle.surface.vertices;
  SheetSections sheet;
  sheet.lines = carrying_lines(muscle);
  sheet.shares = line_shares(muscle.action_line, muscle.surface.vertex_count());
  sheet.rays = muscle.action_line.rays;
  const std::vector<PlacedSections> placed = placed_sections(sheet, capture);
  for (const PlacedSections& line : placed) {
    Points& places = sheet.places.emplace_back(3, vertices.cols());
    for (Index v = 0; v < muscle.surface.vertex_count(); ++v)
      places.col(v) = line.frame(sheet.shares[static_cast<std::size_t>(v)].section).inverse() * vertices.col(v);
  }
  sheet.volumes = volumes_of(sheet, vertices);
  sheet.faces = muscle.surface.faces;
  sheet.volume = enclosed_volume(vertices, sheet.faces);
  return sheet;
}

/// Whether any head's tendon, which keeps its thickness, runs through the section.
static bool is_in_tendon(const SheetSections& sheet, Index section) {
  for (const LineSections& line : sheet.lines)
    if (distance_from_tendon(line, section) < 0) return true;
  return false;
}

/// Moves the corners on both sides of a section apart by this factor.
static void thicken(Points& vertices, Index section, Index rays, Real factor) {
  for (Index i = 1; i < rays / 2; ++i) {
    auto one = vertices.col(section * rays + i), other = vertices.col(section * rays + opposite_corner(rays, i));
    const Vec3 middle = (one + other) / 2;
    one = middle + factor * (one - middle);
    other = middle + factor * (other - middle);
  }
}

Points sheet_at(const SheetSections& sheet, const Pose& pose) {
  Points vertices = carried(sheet, placed_sections(sheet, pose));
  const Eigen::VectorXd volumes = volumes_of(sheet, vertices);
  std::vector<Index> belly;
  Real of_belly = 0;
  for (Index k = 0; k < static_cast<Index>(volumes.size()); ++k) {
    if (!(volumes[k] > 0) || is_in_tendon(sheet, k)) continue;
    thicken(vertices, k, sheet.rays, std::clamp(sheet.volumes[k] / volumes[k], 0.5, 2.0));
    belly.push_back(k);
    of_belly += sheet.volumes[k];
  }
  // What lies between sections is not quite theirs: all of the belly takes the rest, a few percent, alike.
  const Real rest = sheet.volume - enclosed_volume(vertices, sheet.faces);
  for (const Index k : belly) thicken(vertices, k, sheet.rays, std::clamp(1 + rest / of_belly, 0.5, 2.0));
  return vertices;
}

}  // namespace gracilis
