#include <gracilis/methods/xpbd/motion.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/rigid_blend.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::xpbd {

/// A span shorter than this share of its rest is taken for this share: no fiber shortens further (Gordon, Huxley,
/// Julian 1966 put the end of active shortening near half of the optimal length).
static constexpr Real shortest_span = 0.4;

void move_attached(const PreparedMuscle& muscle, const Pose& pose, Particles& particles) {
  for (Index p = 0; p < particles.count(); ++p) {
    const Index body = muscle.fixed_body[static_cast<std::size_t>(p)];
    if (body < 0) continue;
    particles.position(p) =
        (pose.bodies[static_cast<std::size_t>(body)] * muscle.rest.col(p) - muscle.origin).cast<float>();
  }
}

/// The carriers' transforms from the capture pose, about the particles' origin.
static std::vector<RigidTransform> carrier_transforms(const PreparedMuscle& muscle, const Pose& pose) {
  const Eigen::Translation3d to_world(muscle.origin);
  std::vector<RigidTransform> transforms;
  for (Index body : muscle.carriers)
    transforms.push_back(to_world.inverse() * pose.bodies[static_cast<std::size_t>(body)] * to_world);
  return transforms;
}

void carry_free(const PreparedMuscle& muscle, const Pose& before, const Pose& now, Particles& particles) {
  const std::vector<RigidTransform> from = carrier_transforms(muscle, before), to = carrier_transforms(muscle, now);
  const Real kept = 1 - muscle.settings.shape_recovery;
  if (from.empty()) return;
  parallel_for(particles.count(), 512, [&](Index begin, Index end) {
    std::vector<Real> weights(from.size());
    for (Index p = begin; p < end; ++p) {
      if (muscle.fixed_body[static_cast<std::size_t>(p)] >= 0) continue;
      Real sum = 0;
      for (std::size_t i = 0; i < weights.size(); ++i)
        sum += weights[i] = static_cast<Real>(muscle.carrier_shares(static_cast<Index>(i), p));
      if (!(sum > 0)) continue;
      for (Real& weight : weights) weight /= sum;
      const Vec3 rest = muscle.rest.col(p) - muscle.origin;
      const Vec3 displaced = blend(from, weights).inverse() * particles.position(p).cast<Real>();
      particles.position(p) = (blend(to, weights) * Vec3(rest + kept * (displaced - rest))).cast<float>();
    }
  });
}

std::vector<FieldPlacement> place_fields(const PreparedMuscle& muscle, const Pose& pose) {
  std::vector<FieldPlacement> placements;
  for (Index body : muscle.contact_bodies) {
    const RigidTransform to_capture =
        pose.bodies[static_cast<std::size_t>(body)].inverse() * Eigen::Translation3d(muscle.origin);
    placements.push_back({to_capture.linear().cast<float>(), to_capture.translation().cast<float>()});
  }
  return placements;
}

static Vec3 center_of(const AttachedEnd& end, const PreparedMuscle& muscle, const Pose& pose) {
  Vec3 sum = Vec3::Zero();
  for (const auto& [particle, body] : end.vertices)
    sum += pose.bodies[static_cast<std::size_t>(body)] * muscle.rest.col(particle);
  return sum / static_cast<Real>(end.vertices.size());
}

void set_target_lengths(const PreparedMuscle& muscle, const Pose& pose, AlignedVector<float>& target_length) {
  const AlignedVector<float>& rest = muscle.system.distances.rest_length;
  const bool has_two_ends = muscle.rest_span > 0;
  const Real span =
      has_two_ends ? (center_of(muscle.insertion_end, muscle, pose) - center_of(muscle.origin_end, muscle, pose)).norm()
                   : 0;
  const Real ratio = has_two_ends ? std::clamp(span / muscle.rest_span, shortest_span, Real{1}) : 1;
  if (!muscle.settings.slack_uptake || ratio == 1) {
    std::copy(rest.begin(), rest.end(), target_length.begin());
    return;
  }
  const auto along = static_cast<float>(ratio * ratio), across = static_cast<float>(1 / ratio);
  for (std::size_t slot = 0; slot < rest.size(); ++slot) {
    const float cosine2 = muscle.fiber_cosine2[slot];
    target_length[slot] = rest[slot] * std::sqrt(cosine2 * along + (1 - cosine2) * across);
  }
}

}  // namespace gracilis::xpbd
