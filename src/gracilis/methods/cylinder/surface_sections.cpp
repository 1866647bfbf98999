#include <gracilis/methods/cylinder/surface_sections.hpp>

#include <gracilis/anatomy/fibers/inner_fibers.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/rotations.hpp>
#include <gracilis/geometry/topology.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace {

constexpr Index most_sections = 24;
/// Coarser surfaces have fewer sections.
constexpr Index least_vertices_per_section = 8;
/// Rounds in which the line through the sections' centers is smoothed.
constexpr int smoothing_rounds = 3;
/// Share of the sections, from each end, over which they come to turn and grow by the line alone.
constexpr Real end_share = 0.2;
/// Sections grow and shrink by no more than this.
constexpr Real most_growth = 2;
/// As in skinning, m.
constexpr Real line_tendon_length = 0.03;

bool has_both_ends(const Muscle& muscle) {
  const auto has = [&](AttachmentEnd end) {
    return std::any_of(muscle.attachments.begin(), muscle.attachments.end(),
                       [&](const Attachment& each) { return each.end == end; });
  };
  return has(AttachmentEnd::origin) && has(AttachmentEnd::insertion);
}

/// Per vertex 0 ... `last`: the share of the free surface that lies nearer to the origin.
Eigen::VectorXd places_by_area(const Muscle& muscle, const std::vector<Index>& fixed_body, Real last) {
  const Eigen::VectorXd field = origin_to_insertion(muscle);
  const Eigen::VectorXd areas = vertex_areas(muscle.surface.vertices, muscle.surface.faces);
  std::vector<Index> free;
  Real all = 0;
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v) {
    if (fixed_body[static_cast<std::size_t>(v)] >= 0) continue;
    free.push_back(v);
    all += areas[v];
  }
  std::stable_sort(free.begin(), free.end(), [&](Index a, Index b) { return field[a] < field[b]; });
  Eigen::VectorXd places(field.size());
  for (Index v = 0; v < static_cast<Index>(field.size()); ++v) places[v] = field[v] < 0.5 ? 0 : last;
  Real before = 0;
  for (const Index v : free) {
    places[v] = all > 0 ? last * (before + areas[v] / 2) / all : last / 2;
    before += areas[v];
  }
  return places;
}

/// What a vertex counts in a section.
Real nearness(Real place, Index section) { return std::max(1 - std::abs(place - section), Real{0}); }

/// The sections' centers, and what carries them: the means of what lies about each.
void place_centers(const TriangleMesh& mesh, Index count, SurfaceSections& sections) {
  const Eigen::VectorXd areas = vertex_areas(mesh.vertices, mesh.faces);
  sections.centers = Points::Zero(3, count);
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(sections.carriers.weights.rows(), count);
  for (Index k = 0; k < count; ++k) {
    // The first and the last section are what is attached, so that they go with it.
    const bool is_end = k == 0 || k == count - 1;
    Real sum = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (is_end && sections.carriers.fixed_body[static_cast<std::size_t>(v)] < 0) continue;
      const Real weight = nearness(sections.places[v], k) * areas[v];
      if (!(weight > 0)) continue;
      sum += weight;
      sections.centers.col(k) += weight * mesh.vertices.col(v);
      shares.col(k) += weight * sections.carriers.weights.col(v).cast<Real>();
    }
    if (sum > 0) {
      sections.centers.col(k) /= sum;
      shares.col(k) /= sum;
    } else if (k > 0) {  // a large triangle spans it; smoothing brings it between its neighbors
      sections.centers.col(k) = sections.centers.col(k - 1);
      shares.col(k) = shares.col(k - 1);
    }
  }
  for (int round = 0; round < smoothing_rounds; ++round) {
    const Points last = sections.centers;
    for (Index k = 1; k + 1 < count; ++k)
      sections.centers.col(k) = (last.col(k - 1) + 2 * last.col(k) + last.col(k + 1)) / 4;
  }
  sections.of_line = {sections.carriers.center, std::vector<Index>(static_cast<std::size_t>(count), -1),
                      sections.carriers.bodies, shares.cast<float>()};
}

/// Unit; zero where neighbors coincide.
Eigen::Matrix3Xd normals_of(const Points& line) {
  const Eigen::Index last = line.cols() - 1;
  Eigen::Matrix3Xd normals(3, line.cols());
  for (Eigen::Index k = 0; k <= last; ++k)
    normals.col(k) = (line.col(std::min(k + 1, last)) - line.col(std::max(k - 1, Eigen::Index{0}))).stableNormalized();
  return normals;
}

/// How much a section goes by the line: 0 at the ends, 1 away from them.
Real own_will(Index section, Index count) {
  const Real from_end = static_cast<Real>(std::min(section, count - 1 - section)) / static_cast<Real>(count - 1);
  const Real t = std::min(from_end / end_share, Real{1});
  return t * t * (3 - 2 * t);
}

/// What a section does to what lies in it: x' = center + axes (x - rest center).
struct SectionMotion {
  Eigen::Matrix3d axes;
  Vec3 center;
};

std::vector<SectionMotion> section_motions(const SurfaceSections& sections, const Pose& pose) {
  const std::vector<RigidTransform> carried = carried_motions(sections.of_line, pose);
  const Points centers = moved_by(carried, sections.centers);
  const Eigen::Matrix3Xd normals = normals_of(centers);
  const Eigen::VectorXd spacing = spacing_of(centers);
  const auto count = static_cast<Index>(centers.cols());
  std::vector<SectionMotion> motions;
  for (Index k = 0; k < count; ++k) {
    const Real will = own_will(k, count);
    const Vec3 rest_normal = sections.normals.col(k), now = normals.col(k);
    Eigen::Matrix3d turn = carried[static_cast<std::size_t>(k)].linear();
    if (!rest_normal.isZero(0) && !now.isZero(0)) {
      const Eigen::Quaterniond to_line = turn_from_to(turn * rest_normal, now);
      turn = Eigen::Quaterniond::Identity().slerp(will, to_line).toRotationMatrix() * turn;
    }
    const Real wanted = spacing[k] > 0 ? std::sqrt(sections.spacing[k] / spacing[k]) : most_growth;
    const Real growth = 1 + will * (std::clamp(wanted, 1 / most_growth, most_growth) - 1);
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - rest_normal * rest_normal.transpose();
    motions.push_back({turn * (Eigen::Matrix3d::Identity() + (growth - 1) * across), centers.col(k)});
  }
  return motions;
}

}  // namespace

Eigen::VectorXd spacing_of(const Points& centers) {
  const Eigen::Index n = centers.cols();
  Eigen::VectorXd spacing = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 1; k < n; ++k) {
    const Real half = (centers.col(k) - centers.col(k - 1)).norm() / 2;
    spacing[k - 1] += half;
    spacing[k] += half;
  }
  return spacing;
}

SurfaceSections surface_sections(const Muscle& muscle) {
  SurfaceSections sections;
  sections.rest = muscle.surface.vertices;
  const MeshTopology topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  sections.carriers = body_carriers(muscle, topology, line_tendon_length);
  if (!has_both_ends(muscle)) return sections;
  const Index count = std::clamp(muscle.surface.vertex_count() / least_vertices_per_section, Index{3}, most_sections);
  sections.places = places_by_area(muscle, sections.carriers.fixed_body, static_cast<Real>(count - 1));
  place_centers(muscle.surface, count, sections);
  sections.normals = normals_of(sections.centers);
  sections.spacing = spacing_of(sections.centers);
  return sections;
}

Points surface_at(const SurfaceSections& sections, const Pose& pose) {
  if (sections.centers.cols() == 0) return moved_by(carried_motions(sections.carriers, pose), sections.rest);
  const std::vector<SectionMotion> motions = section_motions(sections, pose);
  Points points(3, sections.rest.cols());
  parallel_for(static_cast<Index>(points.cols()), 512, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v) {
      const Vec3 rest = sections.rest.col(v);
      if (const Index body = sections.carriers.fixed_body[static_cast<std::size_t>(v)]; body >= 0) {
        points.col(v) = pose.bodies[static_cast<std::size_t>(body)] * rest;
        continue;
      }
      const auto first = std::min(static_cast<Index>(sections.places[v]), static_cast<Index>(motions.size()) - 2);
      const Real share = sections.places[v] - first;
      Vec3 place = Vec3::Zero();
      for (Index k = first; k <= first + 1; ++k) {
        const auto& [axes, center] = motions[static_cast<std::size_t>(k)];
        place += (k == first ? 1 - share : share) * (center + axes * (rest - sections.centers.col(k)));
      }
      points.col(v) = place;
    }
  });
  return points;
}

}  // namespace gracilis
