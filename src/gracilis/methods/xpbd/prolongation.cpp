#include <gracilis/methods/xpbd/prolongation.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/core/sort_unique.hpp>
#include <gracilis/geometry/point_triangle.hpp>

#include <limits>

namespace gracilis::xpbd {

namespace {

std::vector<Index> inverse_of(const std::vector<Index>& order) {
  std::vector<Index> inverse(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) inverse[static_cast<std::size_t>(order[i])] = static_cast<Index>(i);
  return inverse;
}

/// Per particle: the faces around it and around its neighbors, each once.
std::vector<std::vector<Index>> faces_near(const PreparedMuscle& muscle) {
  const auto count = static_cast<std::size_t>(muscle.rest.cols());
  std::vector<std::vector<Index>> around(count), near(count);
  for (Index f = 0; f < muscle.faces.cols(); ++f)
    for (int k = 0; k < 3; ++k) around[static_cast<std::size_t>(muscle.faces(k, f))].push_back(f);
  for (std::size_t p = 0; p < count; ++p) {
    for (const Index face : around[p])
      for (int k = 0; k < 3; ++k) {
        const auto& theirs = around[static_cast<std::size_t>(muscle.faces(k, face))];
        near[p].insert(near[p].end(), theirs.begin(), theirs.end());
      }
    sort_unique(near[p]);
  }
  return near;
}

/// The nearest place on these faces: corners and weights.
void bind_to_nearest(const Vec3& point, const std::vector<Index>& faces, const PreparedMuscle& coarse,
                     std::array<Index, 3>& corners, Eigen::Vector3f& weights) {
  Real nearest = std::numeric_limits<Real>::infinity();
  for (const Index face : faces) {
    const Eigen::Vector3i at = coarse.faces.col(face);
    const Eigen::Matrix3d x = coarse.rest(Eigen::all, at);
    const Vec3 barycentric = nearest_barycentric(point, x.col(0), x.col(1), x.col(2));
    const Real distance = (x * barycentric - point).squaredNorm();
    if (!(distance < nearest)) continue;
    nearest = distance;
    corners = {at[0], at[1], at[2]};
    weights = barycentric.cast<float>();
  }
}

}  // namespace

Prolongation prepare_prolongation(const CoarserMuscle& copy, const PreparedMuscle& full, PreparedMuscle& coarse) {
  Prolongation result;
  const std::vector<Index> full_particle = inverse_of(full.order), coarse_particle = inverse_of(coarse.order);
  for (const Index vertex : coarse.order)
    result.picked.push_back(full_particle[static_cast<std::size_t>(copy.vertices[static_cast<std::size_t>(vertex)])]);
  coarse.carried = full.carried, coarse.skinned_vertex = result.picked;
  coarse.skinning_weights = full.skinning_weights(Eigen::all, result.picked).eval();

  const std::vector<std::vector<Index>> near = faces_near(coarse);
  result.corners.assign(full.order.size(), {0, 0, 0});
  result.weights.assign(full.order.size(), Eigen::Vector3f::Zero());
  parallel_for(static_cast<Index>(full.order.size()), 256, [&](Index begin, Index end) {
    for (auto p = static_cast<std::size_t>(begin); p < static_cast<std::size_t>(end); ++p) {
      const Index drawn_onto = copy.went_to[static_cast<std::size_t>(full.order[p])];
      if (drawn_onto < 0) continue;  // belongs to no face
      const auto center = static_cast<std::size_t>(coarse_particle[static_cast<std::size_t>(drawn_onto)]);
      bind_to_nearest(full.rest.col(static_cast<Index>(p)), near[center], coarse, result.corners[p], result.weights[p]);
    }
  });
  for (std::size_t i = 0; i < result.picked.size(); ++i) {
    const auto p = static_cast<std::size_t>(result.picked[i]);
    result.corners[p].fill(static_cast<Index>(i));
    result.weights[p] = Eigen::Vector3f::UnitX();
  }
  return result;
}

void prolong(const Prolongation& prolongation, const PreparedMuscle& coarse, const MuscleState& coarse_state,
             const PreparedMuscle& full, const MuscleState& full_state, const Pose& pose, Particles& particles) {
  const Points known = displacements(coarse, pose, coarse_state);
  Points displaced(3, full.rest.cols());
  for (Index p = 0; p < displaced.cols(); ++p) {
    const auto& corners = prolongation.corners[static_cast<std::size_t>(p)];
    const Vec3 weights = prolongation.weights[static_cast<std::size_t>(p)].cast<Real>();
    displaced.col(p) =
        weights[0] * known.col(corners[0]) + weights[1] * known.col(corners[1]) + weights[2] * known.col(corners[2]);
  }
  displace_skinned(full, pose, full_state, displaced, particles);
}

void restrict_to_copy(const Prolongation& prolongation, const PreparedMuscle& full, const Particles& particles,
                      const PreparedMuscle& coarse, Particles& coarse_particles) {
  for (std::size_t p = 0; p < prolongation.picked.size(); ++p)
    coarse_particles.position(static_cast<Index>(p)) =
        (particles.position(prolongation.picked[p]).cast<Real>() + full.origin - coarse.origin).cast<float>();
}

}  // namespace gracilis::xpbd
