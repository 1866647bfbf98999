#include <gracilis/methods/xpbd/prolongation.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/methods/xpbd/motion.hpp>

#include <limits>

namespace gracilis::xpbd {

static constexpr Real anywhere = std::numeric_limits<Real>::infinity();

/// Sum of the area vectors of the faces around each particle.
static Points particle_directions(const PreparedMuscle& muscle) {
  Points directions = Points::Zero(3, muscle.rest.cols());
  for (Index f = 0; f < muscle.faces.cols(); ++f) {
    const Vec3 area = area_vector(muscle.rest, muscle.faces.col(f));
    for (int k = 0; k < 3; ++k) directions.col(muscle.faces(k, f)) += area;
  }
  return directions;
}

/// The nearest place on the copy; through a thin sheet that would be its other side.
static NearestPoint place_on(const NearestTriangle& nearest, const PreparedMuscle& coarse, const Vec3& p,
                             const Vec3& direction) {
  const NearestPoint same_side = nearest.query(
      p, anywhere, [&](Index face) { return area_vector(coarse.rest, coarse.faces.col(face)).dot(direction) > 0; });
  return same_side.face >= 0 ? same_side : nearest.query(p);
}

Prolongation prepare_prolongation(const std::vector<Index>& vertices, const PreparedMuscle& full,
                                  PreparedMuscle& coarse) {
  Prolongation result;
  std::vector<Index> particle_of(full.order.size());
  for (std::size_t p = 0; p < full.order.size(); ++p)
    particle_of[static_cast<std::size_t>(full.order[p])] = static_cast<Index>(p);
  for (const Index vertex : coarse.order)
    result.picked.push_back(particle_of[static_cast<std::size_t>(vertices[static_cast<std::size_t>(vertex)])]);
  coarse.carrier_shares = full.carrier_shares(Eigen::all, result.picked).eval();

  const NearestTriangle nearest({coarse.rest, coarse.faces});
  const Points directions = particle_directions(full);
  result.corners.resize(full.order.size());
  result.weights.resize(full.order.size());
  parallel_for(static_cast<Index>(full.order.size()), 256, [&](Index begin, Index end) {
    for (Index p = begin; p < end; ++p) {
      const NearestPoint place = place_on(nearest, coarse, full.rest.col(p), directions.col(p));
      for (int k = 0; k < 3; ++k)
        result.corners[static_cast<std::size_t>(p)][static_cast<std::size_t>(k)] = coarse.faces(k, place.face);
      result.weights[static_cast<std::size_t>(p)] = place.barycentric.cast<float>();
    }
  });
  for (std::size_t i = 0; i < result.picked.size(); ++i) {
    const auto p = static_cast<std::size_t>(result.picked[i]);
    result.corners[p].fill(static_cast<Index>(i));
    result.weights[p] = Eigen::Vector3f::UnitX();
  }
  return result;
}

void prolong(const Prolongation& prolongation, const PreparedMuscle& coarse, const Particles& coarse_particles,
             const PreparedMuscle& full, const Pose& pose, Particles& particles) {
  const Points known = displacements(coarse, pose, coarse_particles);
  Points displaced(3, full.rest.cols());
  for (Index p = 0; p < displaced.cols(); ++p) {
    const auto& corners = prolongation.corners[static_cast<std::size_t>(p)];
    const Vec3 weights = prolongation.weights[static_cast<std::size_t>(p)].cast<Real>();
    displaced.col(p) =
        weights[0] * known.col(corners[0]) + weights[1] * known.col(corners[1]) + weights[2] * known.col(corners[2]);
  }
  displace_carried(full, pose, displaced, particles);
}

void restrict_to_copy(const Prolongation& prolongation, const PreparedMuscle& full, const Particles& particles,
                      const PreparedMuscle& coarse, Particles& coarse_particles) {
  for (std::size_t p = 0; p < prolongation.picked.size(); ++p)
    coarse_particles.position(static_cast<Index>(p)) =
        (particles.position(prolongation.picked[p]).cast<Real>() + full.origin - coarse.origin).cast<float>();
}

}  // namespace gracilis::xpbd
