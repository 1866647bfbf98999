#include <gracilis/methods/xpbd/contraction.hpp>

#include <gracilis/anatomy/activation/tendon.hpp>
#include <gracilis/anatomy/fibers/muscle_fibers.hpp>
#include <gracilis/anatomy/fibers/surface_fibers.hpp>
#include <gracilis/dynamics/constraints/compliance.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_points.hpp>
#include <gracilis/geometry/shortest_paths.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::xpbd {

namespace {

/// An edge that may pull, in particle numbers.
struct Pull {
  Index a = 0, b = 0;
  Real length = 0;          ///< m, at rest
  Real area = 0;            ///< m², of the surface that it pulls for
  Real squared_cosine = 1;  ///< between it and the fibers
  Index fibers = 1;         ///< how often it pulls where its area does not count
};

/// The lines that say how the muscle contracts.
Polylines contracting_lines(const Muscle& muscle) {
  return muscle.given_surface_fibers.count() > 0 ? muscle.given_surface_fibers : fibers_of(muscle);
}

std::vector<Index> attached_particles(const PreparedMuscle& muscle) {
  std::vector<Index> attached;
  for (std::size_t p = 0; p < muscle.fixed_body.size(); ++p)
    if (muscle.fixed_body[p] >= 0) attached.push_back(static_cast<Index>(p));
  return attached;
}

/// All edges that run more along the fibers than across them. An edge pulls for its triangles by c², c the cosine to
/// the fibers: over all directions in a plane 3 c² c⁴ is 0.94 on average, so the tension is that of the strips within a
/// few percent.
std::vector<Pull> spread_pulls(const PreparedMuscle& muscle, const MeshTopology& topology, const Polylines& lines) {
  if (lines.count() == 0) return {};
  Points middles(3, static_cast<Index>(topology.edges.size()));
  for (std::size_t e = 0; e < topology.edges.size(); ++e)
    middles.col(static_cast<Index>(e)) =
        (muscle.rest.col(topology.edges[e].a) + muscle.rest.col(topology.edges[e].b)) / 2;
  const Points directions = directions_of_fibers(lines, middles);
  std::vector<Pull> pulls;
  for (std::size_t e = 0; e < topology.edges.size(); ++e) {
    const MeshEdge& edge = topology.edges[e];
    const Vec3 along = muscle.rest.col(edge.b) - muscle.rest.col(edge.a);
    const Real length2 = along.squaredNorm();
    if (!(length2 > 0)) continue;
    const Real c2 = std::pow(along.dot(directions.col(static_cast<Index>(e))), 2) / length2;
    if (c2 < 0.5) continue;
    pulls.push_back({edge.a, edge.b, std::sqrt(length2), c2 * area_at(edge, muscle.rest, muscle.faces), c2, 1});
  }
  return pulls;
}

/// Gives each segment the area of the surface that is nearer to its middle than to any other's.
void take_strips(const PreparedMuscle& muscle, std::vector<Pull>& pulls) {
  Points middles(3, static_cast<Index>(pulls.size()));
  for (std::size_t i = 0; i < pulls.size(); ++i)
    middles.col(static_cast<Index>(i)) = (muscle.rest.col(pulls[i].a) + muscle.rest.col(pulls[i].b)) / 2;
  const NearestPoints segments(middles);
  for (Index f = 0; f < muscle.faces.cols(); ++f) {
    const auto corners = muscle.faces.col(f);
    const Vec3 center = (muscle.rest.col(corners[0]) + muscle.rest.col(corners[1]) + muscle.rest.col(corners[2])) / 3;
    pulls[static_cast<std::size_t>(segments.nearest(center))].area += area_vector(muscle.rest, corners).norm() / 2;
  }
}

/// The segments of the surface fibers.
std::vector<Pull> segment_pulls(const Muscle& muscle, const PreparedMuscle& prepared) {
  const SurfaceFibers fibers = contracting_fibers(muscle);
  std::vector<Index> particle_of(prepared.order.size());
  for (std::size_t p = 0; p < prepared.order.size(); ++p)
    particle_of[static_cast<std::size_t>(prepared.order[p])] = static_cast<Index>(p);
  std::vector<Pull> pulls;
  for (const FiberSegment& segment : fibers.segments)
    pulls.push_back({particle_of[static_cast<std::size_t>(segment.a)], particle_of[static_cast<std::size_t>(segment.b)],
                     segment.rest_length, 0, 1, segment.fibers});
  if (!pulls.empty()) take_strips(prepared, pulls);
  return pulls;
}

}  // namespace

void build_contractions(const Muscle& muscle, const MeshTopology& topology, PreparedMuscle& prepared) {
  const bool by_area = muscle.contraction.spread || muscle.contraction.area_scaling;
  const std::vector<Pull> pulls = muscle.contraction.spread
                                      ? spread_pulls(prepared, topology, contracting_lines(muscle))
                                      : segment_pulls(muscle, prepared);
  if (pulls.empty()) return;
  std::vector<Real> belly =
      belly_shares(prepared.rest, topology, attached_particles(prepared), prepared.settings.tendon_length);
  for (std::size_t p = 0; p < prepared.belly.size(); ++p) belly[p] *= prepared.belly[p];
  std::vector<DistanceConstraint> constraints;
  std::vector<Real> squared_cosines;
  for (const Pull& pull : pulls) {
    // A sheet's tension per width times the strip's width, area over length, per length.
    const Real shape = by_area ? std::min(pull.area / (pull.length * pull.length), largest_shape) : 1;
    const Real share = (belly[static_cast<std::size_t>(pull.a)] + belly[static_cast<std::size_t>(pull.b)]) / 2;
    const Real stiffness = muscle.contraction.stiffness * share * shape;
    if (!(stiffness > 0)) continue;
    const auto times = static_cast<std::size_t>(by_area ? 1 : pull.fibers);
    constraints.insert(constraints.end(), times, {pull.a, pull.b, pull.length, compliance_of(stiffness)});
    squared_cosines.insert(squared_cosines.end(), times, pull.squared_cosine);
  }
  DistanceSet& set = prepared.system.tensions;
  set = build_distance_set(constraints, static_cast<Index>(prepared.rest.cols()));
  prepared.along_fibers.assign(set.a.size(), 1);
  for (std::size_t i = 0; i < squared_cosines.size(); ++i)
    prepared.along_fibers[static_cast<std::size_t>(set.slot[i])] = static_cast<float>(squared_cosines[i]);
}

Real contraction_strength(const ContractionSettings& settings, Real activation) {
  if (!settings.ramp) return activation > settings.threshold || settings.threshold == 0 ? 1 : 0;
  if (!(activation > settings.threshold) || settings.shortest >= 1) return 0;
  return (1 - contracted_share(settings, activation)) / (1 - settings.shortest);
}

void set_contraction_lengths(const PreparedMuscle& muscle, Real activation, const strings::SkinnedSurface* skinned,
                             AlignedVector<float>& tension_length) {
  const auto share = static_cast<float>(contracted_share(muscle.contraction, activation));
  const DistanceSet& set = muscle.system.tensions;
  for (std::size_t slot = 0; slot < set.a.size(); ++slot) {
    const float c2 = muscle.along_fibers[slot], rest = set.rest_length[slot];
    float across = 1;
    if (skinned && rest > 0 && set.a[slot] < muscle.particle_count() && set.b[slot] < muscle.particle_count()) {
      const Real length = (skinned->vertices.col(set.b[slot]) - skinned->vertices.col(set.a[slot])).norm();
      across = std::max(across, static_cast<float>(length) / rest);
    }
    tension_length[slot] = rest * std::sqrt(c2 * share * share + (1 - c2) * across * across);
  }
}

}  // namespace gracilis::xpbd
