#include <gracilis/methods/rbf/surface_follow.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/core/stop.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_points.hpp>
#include <gracilis/geometry/shortest_paths.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::rbf {

namespace {

/// Share of the volume at rest within which a volume is right, and how often the offset is improved.
constexpr Real accuracy = 1e-4;
constexpr int most_rounds = 12;
/// Where the field is flatter than this, its gradient tells no way; at rest it is 1 on the surface.
constexpr Real least_slope = 0.3;

/// The centers that a vertex feels on its way to its level.
using NearCenters = std::vector<std::vector<Index>>;

NearCenters near_centers(const RadialBasis& basis, const Points& points, Real longest) {
  constexpr Real reaches = 4;  // beyond them a Gaussian is below 1e-6
  const NearestPoints tree(basis.centers);
  const Real far = longest + reaches * basis.reaches.maxCoeff();
  NearCenters near(static_cast<std::size_t>(points.cols()));
  parallel_for(static_cast<Index>(points.cols()), 128, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v) near[static_cast<std::size_t>(v)] = tree.within(points.col(v), far);
  });
  return near;
}

/// f and its gradient of the centers near a point.
RadialSample slope_of(const RadialBasis& basis, const std::vector<Index>& near, const Vec3& point) {
  RadialSample result;
  result.value = basis.polynomial[0];
  for (const Index k : near) {
    const Vec3 from = point - basis.centers.col(k);
    const Real narrow = 1 / (basis.reaches[k] * basis.reaches[k]);
    const Real term = basis.weights[k] * std::exp(-narrow * from.squaredNorm());
    result.value += term;
    result.gradient -= 2 * narrow * term * from;
  }
  return result;
}

/// Moves vertices along the field's gradient until it has the wanted value there; at most `longest` (m).
void move_to_levels(const FollowedSurface& surface, const RadialBasis& basis, const NearCenters& near,
                    const Eigen::VectorXd& levels, Real longest, Points& points) {
  constexpr int newton_steps = 4;
  constexpr Real near_enough = 1e-8;  // m
  parallel_for(static_cast<Index>(points.cols()), 32, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v) {
      if (surface.held[static_cast<std::size_t>(v)]) continue;
      const Vec3 start = points.col(v);
      Vec3 point = start;
      for (int i = 0; i < newton_steps; ++i) {
        const RadialSample at = slope_of(basis, near[static_cast<std::size_t>(v)], point);
        if (std::abs(levels[v] - at.value) < near_enough) break;
        point += (levels[v] - at.value) / std::max(at.gradient.squaredNorm(), least_slope * least_slope) * at.gradient;
        if (const Real way = (point - start).norm(); way > longest) {
          point = start + longest / way * (point - start);
          break;
        }
      }
      points.col(v) += surface.freedom[v] * (point - start);
    }
  });
}

/// Pushes out of bones so that neighbors go along: what was pushed is spread over the surface, then pushed again.
Index push_out_smoothly(const FollowedSurface& surface, const FollowRequests& requests, Points& points) {
  if (!requests.push_out) return 0;
  constexpr int rounds = 6, spreads = 10;
  for (int round = 0; round < rounds; ++round) {
    Points pushed = points;
    if (requests.push_out(pushed) == 0) return 0;
    Points way = pushed - points;
    for (int spread = 0; spread < spreads; ++spread) {
      const Points before = way;
      parallel_for(static_cast<Index>(way.cols()), 256, [&](Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
          const auto at = static_cast<std::size_t>(v);
          const Index first = surface.stars.offsets[at], last = surface.stars.offsets[at + 1];
          if (surface.held[at] || first == last) continue;
          Vec3 mean = Vec3::Zero();
          for (Index k = first; k < last; ++k) mean += before.col(surface.stars.neighbors[static_cast<std::size_t>(k)]);
          way.col(v) = (before.col(v) + mean / (last - first)) / 2;
        }
      });
    }
    for (Index v = 0; v < static_cast<Index>(way.cols()); ++v)
      if (!surface.held[static_cast<std::size_t>(v)]) points.col(v) += way.col(v);
  }
  return requests.push_out(points);
}

}  // namespace

Vec3 correction_at(const MuscleModel& model, Index vertex, const Points& corrections) {
  Vec3 sum = Vec3::Zero();
  for (Index k = 0; k < static_cast<Index>(model.bound.rows()); ++k)
    sum += model.bound_shares(k, vertex) * corrections.col(model.bound(k, vertex));
  return sum;
}

FollowedSurface followed_surface(const TriangleMesh& mesh, const MeshTopology& topology, const BodyCarriers& carriers) {
  FollowedSurface surface;
  surface.rest = mesh;
  surface.stars = topology.stars;
  surface.volume = enclosed_volume(mesh.vertices, mesh.faces);
  surface.held = held_vertices(carriers);
  std::vector<Index> sources;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (surface.held[static_cast<std::size_t>(v)]) sources.push_back(v);
  constexpr Real graded = 0.01;  // m beside held vertices, so that no step remains there
  const Eigen::VectorXd away = edge_distances(length_graph(mesh.vertices, topology), sources);
  surface.freedom = (away / graded).cwiseMin(1);
  return surface;
}

Followed follow(const FollowedSurface& surface, const MuscleModel& model, const std::vector<RigidTransform>& motions,
                const Points& corrections, const RadialBasis& basis, const FollowRequests& requests) {
  Points start(3, surface.rest.vertex_count());
  for (Index v = 0; v < surface.rest.vertex_count(); ++v) {
    start.col(v) = motions[static_cast<std::size_t>(v)] * Vec3(surface.rest.vertices.col(v));
    if (surface.held[static_cast<std::size_t>(v)]) continue;
    start.col(v) += correction_at(model, v, corrections);
  }
  const NearCenters near = near_centers(basis, start, model.spacing);
  Followed result;
  Real last_offset = 0, last_off = 0;
  for (int round = 0; round < most_rounds; ++round) {
    throw_if_stopped();
    result.points = start;
    const Eigen::VectorXd levels = model.levels + result.offset * model.offset_shares;
    move_to_levels(surface, basis, near, levels, model.spacing, result.points);
    result.contacts = push_out_smoothly(surface, requests, result.points);
    const Real off = enclosed_volume(result.points, surface.rest.faces) - surface.volume;
    if (!requests.keeps_volume || std::abs(off) <= accuracy * surface.volume || !std::isfinite(off)) break;
    // The surface's area is the slope at first, then the secant.
    Real slope = surface_area(result.points, surface.rest.faces);
    if (round > 0 && result.offset != last_offset) {
      const Real secant = (off - last_off) / (result.offset - last_offset);
      if (secant > slope / 10) slope = secant;
    }
    last_offset = result.offset, last_off = off;
    result.offset -= off / slope;
  }
  return result;
}

}  // namespace gracilis::rbf
