#include <gracilis/simulate/taut_string.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace {

constexpr Real safe_move = 0.002;       ///< m; a point that enters a bone by no more leaves it where it entered
constexpr Real settled = 5e-5;          ///< m; a sweep that moves no point further is the last
constexpr Real nearness_floor = 0.002;  ///< m; bones nearer than that weigh no more
constexpr float least_slope = 0.01f;    ///< squared; less where a field's ridge is, which says nothing about sides

/// Per bone and point: at least this far from it, m. Asking a field again is left until it may matter.
using Clearances = Eigen::MatrixXd;

void see_again(const PlacedBones& bones, const Vec3& p, Eigen::Ref<Eigen::VectorXd> clearances) {
  for (std::size_t b = 0; b < bones.to_local.size(); ++b)
    clearances[static_cast<Index>(b)] = bones.sample(b, p).distance;
}

/// How far a point may move at once.
Real free_move(const Eigen::Ref<const Eigen::VectorXd>& clearances) {
  return std::max(clearances.size() > 0 ? clearances.minCoeff() : std::numeric_limits<Real>::infinity(), safe_move);
}

/// Where p goes when it is pushed out of the bones that it may have come into.
Vec3 pushed_out(const PlacedBones& bones, Vec3 p, Eigen::Ref<Eigen::VectorXd> clearances) {
  for (std::size_t b = 0; b < bones.to_local.size(); ++b) {
    Real& clearance = clearances[static_cast<Index>(b)];
    if (clearance > 0) continue;
    const FieldSample at = bones.sample(b, p);
    clearance = at.distance;
    const float slope2 = at.gradient.squaredNorm();
    if (at.distance >= 0 || slope2 < least_slope) continue;
    const float slope = std::sqrt(slope2);
    const Real length = std::min(-at.distance / slope, -2 * at.distance);
    p += length * bones.in_world(b, at.gradient / slope);
    clearances.array() -= length;
    clearance = 0;
  }
  return p;
}

}  // namespace

PlacedBones::PlacedBones(const BoneSpace& bones, const std::vector<RigidTransform>& bodies) : space(bones) {
  for (std::size_t b = 0; b < bones.count(); ++b) to_local.push_back(bodies[bones.body(b)].inverse());
}

void pull_tight(const PlacedBones& bones, Points& string, int sweeps) {
  const auto parts = static_cast<Index>(string.cols() - 1);
  const Real factor = 2 / (1 + std::sin(pi / static_cast<Real>(parts)));
  Clearances clearances = Clearances::Zero(static_cast<Index>(bones.to_local.size()), string.cols());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    Real farthest = 0;
    for (Index i = 1; i < parts; ++i) {
      const Vec3 before = string.col(i);
      Vec3 move = factor * ((string.col(i - 1) + string.col(i + 1)) / 2 - before);
      if (move.norm() > free_move(clearances.col(i))) {
        see_again(bones, before, clearances.col(i));
        move *= std::min(Real{1}, free_move(clearances.col(i)) / move.norm());
      }
      clearances.col(i).array() -= move.norm();
      string.col(i) = pushed_out(bones, before + move, clearances.col(i));
      farthest = std::max(farthest, (string.col(i) - before).norm());
    }
    if (farthest < settled) return;
  }
}

void carry_string(const PlacedBones& bones, const std::vector<RigidTransform>& motions, Points& string) {
  if (motions.empty()) return;
  for (Index i = 1; i + 1 < string.cols(); ++i) {
    const Vec3 p = string.col(i);
    Vec3 moved = Vec3::Zero();
    Real sum = 0;
    for (std::size_t b = 0; b < motions.size(); ++b) {
      const Real away = std::max<Real>(bones.sample(b, p).distance, nearness_floor), weight = 1 / (away * away);
      moved += weight * (motions[b] * p);
      sum += weight;
    }
    string.col(i) = moved / sum;
  }
}

}  // namespace gracilis
