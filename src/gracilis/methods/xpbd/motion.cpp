#include <gracilis/methods/xpbd/motion.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/rigid_blend.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace gracilis::xpbd {

/// No edge aims at less than this share of its length at rest: no fiber shortens further (Gordon, Huxley, Julian 1966
/// put the end of active shortening near half of the optimal length).
static constexpr Real shortest_share = 0.4;

Real turn_between(const PreparedMuscle& muscle, const Pose& before, const Pose& now) {
  const auto against_first = [&](const Pose& pose, Index body) -> Eigen::Matrix3d {
    return pose.bodies[static_cast<std::size_t>(muscle.carriers.front())].linear().transpose() *
           pose.bodies[static_cast<std::size_t>(body)].linear();
  };
  Real turn = 0;
  for (const Index body : muscle.carriers)
    turn =
        std::max(turn, Eigen::AngleAxisd(against_first(before, body).transpose() * against_first(now, body)).angle());
  return turn;
}

/// The same, from the capture pose.
static Real turn_from_capture(const PreparedMuscle& muscle, const Pose& pose) {
  Pose capture;
  capture.bodies.assign(pose.bodies.size(), RigidTransform::Identity());
  return turn_between(muscle, capture, pose);
}

/// The carriers' transforms from the capture pose, about the particles' origin.
static RigidBlend carrier_transforms(const PreparedMuscle& muscle, const Pose& pose) {
  const Eigen::Translation3d to_world(muscle.origin);
  std::vector<RigidTransform> transforms;
  for (Index body : muscle.carriers)
    transforms.push_back(to_world.inverse() * pose.bodies[static_cast<std::size_t>(body)] * to_world);
  return prepare_blend(transforms);
}

/// One particle's shares of the carriers' motion into `shares`, brought to the sum 1. False where nothing carries it.
static bool shares_of(const PreparedMuscle& muscle, Index particle, std::vector<Real>& shares) {
  Real sum = 0;
  for (std::size_t i = 0; i < shares.size(); ++i)
    sum += shares[i] = static_cast<Real>(muscle.skinning_weights(static_cast<Index>(i), particle));
  if (!(sum > 0)) return false;
  for (Real& share : shares) share /= sum;
  return true;
}

MuscleState make_muscle_state(const PreparedMuscle& muscle, std::size_t bodies) {
  MuscleState state{make_state(muscle.system), {}, {}, {}};
  if (!muscle.carrying.strings) return state;
  state.strings = strings::capture_state(*muscle.carrying.strings, bodies);
  skin_by_strings(muscle, state);
  return state;
}

void skin_by_strings(const PreparedMuscle& muscle, MuscleState& state) {
  if (!muscle.carrying.strings) return;
  const StringSkinnedSurface& carried = *muscle.carried;
  state.skinned = state.whole_skinned = std::make_shared<const strings::SkinnedSurface>(
      skinned_by_strings(*muscle.carrying.strings, carried.skin, carried.rest, carried.faces, state.strings));
  if (muscle.skinned_vertex.empty()) return;
  const strings::SkinnedSurface& whole = *state.whole_skinned;
  state.skinned = std::make_shared<const strings::SkinnedSurface>(strings::SkinnedSurface{
      whole.vertices(Eigen::all, muscle.skinned_vertex), whole.turns(Eigen::all, muscle.skinned_vertex)});
}

void follow_strings(const PreparedMuscle& muscle, const Pose& pose, MuscleState& state) {
  if (!muscle.carrying.strings) return;
  strings::follow(*muscle.carrying.strings, *muscle.carrying.bones, pose, state.strings);
  skin_by_strings(muscle, state);
}

namespace {

/// The frames that carry particles from the capture pose to a pose, about the particles' origin: those of the strings
/// that carry the muscle; its sections' where it is made of sections across a line; else blends of the bodies' motions.
/// What is attached moves with its body, but a tendon about a line follows that to its end.
class CarryingFrames {
 public:
  CarryingFrames(const PreparedMuscle& muscle, const Pose& pose, std::shared_ptr<const strings::SkinnedSurface> skinned)
      : muscle_(muscle), pose_(pose), skinned_(std::move(skinned)) {
    if (skinned_) return;
    if (muscle.lines.empty()) {
      blend_ = carrier_transforms(muscle, pose);
      return;
    }
    const Eigen::Translation3d to_world(muscle.origin);
    for (std::size_t line = 0; line < muscle.lines.size(); ++line) {
      const PlacedSections now = sections_at(muscle.lines[line], pose);
      std::vector<RigidTransform>& sections = sections_.emplace_back();
      for (Eigen::Index k = 0; k < now.centers.cols(); ++k)
        sections.push_back(to_world.inverse() * now.frame(k) * muscle.to_sections[line][static_cast<std::size_t>(k)] *
                           to_world);
    }
  }

  /// Of one particle into `frame`; false where nothing carries it. `shares` is room to work in.
  bool of(Index particle, std::vector<Real>& shares, RigidTransform& frame) const {
    if (skinned_) {
      frame.linear() = Eigen::Quaterniond(Eigen::Vector4d(skinned_->turns.col(particle))).toRotationMatrix();
      frame.translation() = skinned_->vertices.col(particle) - muscle_.origin -
                            frame.linear() * (muscle_.rest.col(particle) - muscle_.origin);
      return true;
    }
    if (!muscle_.lines.empty()) {
      const Index body = muscle_.fixed_body[static_cast<std::size_t>(particle)];
      const Eigen::Translation3d to_world(muscle_.origin);
      const bool in_tendon = !(muscle_.belly[static_cast<std::size_t>(particle)] > 0);
      frame = body < 0 || in_tendon ? along_lines(particle)
                                    : to_world.inverse() * pose_.bodies[static_cast<std::size_t>(body)] * to_world;
      return true;
    }
    if (!shares_of(muscle_, particle, shares)) return false;
    frame = blend(blend_, shares);
    return true;
  }

 private:
  /// Between two heads a particle's place at rest goes straight from where one takes it to where the other does.
  RigidTransform along_lines(Index particle) const {
    const LineShare& share = muscle_.shares[static_cast<std::size_t>(particle)];
    const auto section = static_cast<std::size_t>(share.section);
    const RigidTransform& own = sections_[share.line][section];
    if (!(share.next > 0)) return own;
    const RigidTransform& next = sections_[share.line + 1][section];
    const Vec3 rest = muscle_.rest.col(particle) - muscle_.origin;
    RigidTransform mixed = own;
    mixed.linear() = Eigen::Quaterniond(own.linear()).slerp(share.next, Eigen::Quaterniond(next.linear())).matrix();
    mixed.translation() = (1 - share.next) * (own * rest) + share.next * (next * rest) - mixed.linear() * rest;
    return mixed;
  }

  const PreparedMuscle& muscle_;
  const Pose& pose_;
  std::shared_ptr<const strings::SkinnedSurface> skinned_;
  RigidBlend blend_;
  std::vector<std::vector<RigidTransform>> sections_;  ///< of each line
};

}  // namespace

void move_attached(const PreparedMuscle& muscle, const Pose& pose, Particles& particles) {
  const std::optional<CarryingFrames> frames =
      !muscle.lines.empty() ? std::make_optional<CarryingFrames>(muscle, pose, nullptr) : std::nullopt;
  std::vector<Real> shares;
  RigidTransform frame;
  for (Index p = 0; p < particles.count(); ++p) {
    const Index body = muscle.fixed_body[static_cast<std::size_t>(p)];
    if (body < 0) continue;
    if (frames && frames->of(p, shares, frame))
      particles.position(p) = (frame * Vec3(muscle.rest.col(p) - muscle.origin)).cast<float>();
    else
      particles.position(p) =
          (pose.bodies[static_cast<std::size_t>(body)] * muscle.rest.col(p) - muscle.origin).cast<float>();
  }
}

/// Nearer to the capture pose than this a muscle comes back by no more than the recovery: the way through that pose is
/// as smooth as any.
static constexpr Real near_capture = radians(15);

/// The share of their displacements that free particles keep from one pose to the next.
static Real kept_share(const PreparedMuscle& muscle, const Pose& before, const Pose& now, bool active) {
  const Real recovery = muscle.settings.shape_recovery;
  if (active || !(recovery > 0)) return 1 - recovery;
  const auto far = [&](const Pose& pose) { return std::max(turn_from_capture(muscle, pose), near_capture); };
  const Real nearer = far(now) / far(before);
  return (1 - recovery) * std::min(nearer * nearer, Real{1});
}

void skin_free(const PreparedMuscle& muscle, const Pose& before, const Pose& now, bool active, MuscleState& state) {
  if (muscle.carriers.empty()) return;
  const CarryingFrames from(muscle, before, state.skinned);
  follow_strings(muscle, now, state);
  const CarryingFrames to(muscle, now, state.skinned);
  Particles& particles = state.particles;
  const Real kept = kept_share(muscle, before, now, active);
  parallel_for(particles.count(), 512, [&](Index begin, Index end) {
    std::vector<Real> shares(muscle.carriers.size());
    RigidTransform was, is;
    for (Index p = begin; p < end; ++p) {
      if (muscle.fixed_body[static_cast<std::size_t>(p)] >= 0 || !from.of(p, shares, was) || !to.of(p, shares, is))
        continue;
      const Vec3 rest = muscle.rest.col(p) - muscle.origin;
      const Vec3 displaced = was.inverse() * particles.position(p).cast<Real>();
      const Real belly = !muscle.lines.empty() ? muscle.belly[static_cast<std::size_t>(p)] : 1;
      particles.position(p) = (is * Vec3(rest + belly * kept * (displaced - rest))).cast<float>();
    }
  });
}

Points skinned_rest(const PreparedMuscle& muscle, const Pose& pose, const MuscleState& state) {
  if (state.skinned) return state.skinned->vertices.colwise() - muscle.origin;
  Points carried = muscle.rest.colwise() - muscle.origin;
  if (muscle.carriers.empty()) return carried;
  const CarryingFrames frames(muscle, pose, nullptr);
  parallel_for(static_cast<Index>(carried.cols()), 512, [&](Index begin, Index end) {
    std::vector<Real> shares(muscle.carriers.size());
    RigidTransform frame;
    for (Index p = begin; p < end; ++p)
      if (frames.of(p, shares, frame)) carried.col(p) = frame * Vec3(carried.col(p));
  });
  return carried;
}

Points displacements(const PreparedMuscle& muscle, const Pose& pose, const MuscleState& state) {
  Points displaced(3, state.particles.count());
  const CarryingFrames frames(muscle, pose, state.skinned);
  parallel_for(state.particles.count(), 512, [&](Index begin, Index end) {
    std::vector<Real> shares(muscle.carriers.size());
    RigidTransform frame = RigidTransform::Identity();
    for (Index p = begin; p < end; ++p) {
      displaced.col(p) = state.particles.position(p).cast<Real>();
      if (frames.of(p, shares, frame)) displaced.col(p) = frame.inverse() * Vec3(displaced.col(p));
      displaced.col(p) -= muscle.rest.col(p) - muscle.origin;
    }
  });
  return displaced;
}

void displace_skinned(const PreparedMuscle& muscle, const Pose& pose, const MuscleState& state,
                      const Points& displacements, Particles& particles) {
  const CarryingFrames frames(muscle, pose, state.skinned);
  parallel_for(particles.count(), 512, [&](Index begin, Index end) {
    std::vector<Real> shares(muscle.carriers.size());
    RigidTransform frame = RigidTransform::Identity();
    for (Index p = begin; p < end; ++p) {
      if (muscle.fixed_body[static_cast<std::size_t>(p)] >= 0) continue;
      const Vec3 displaced = muscle.rest.col(p) - muscle.origin + displacements.col(p);
      particles.position(p) = (frames.of(p, shares, frame) ? Vec3(frame * displaced) : displaced).cast<float>();
    }
  });
  move_attached(muscle, pose, particles);
}

/// A bone that turned by this against the muscle's other bones, or moved the muscle's middle by this, has moved.
static constexpr Real moved_angle = radians(0.5), moved_distance = 0.0005;

/// How far a bone has left its place against a muscle: 0 where it was in the capture pose, 1 from a small motion on.
static Real release_of(const PreparedMuscle& muscle, const Pose& pose, Index body) {
  const auto from_capture = [&](Index b) { return pose.bodies[static_cast<std::size_t>(b)]; };
  Real release = 0;
  const auto see = [&](const RigidTransform& motion) {
    release = std::max({release, Eigen::AngleAxisd(motion.linear()).angle() / moved_angle,
                        (motion * muscle.origin - muscle.origin).norm() / moved_distance});
  };
  for (Index carrier : muscle.carriers) see(from_capture(body).inverse() * from_capture(carrier));
  if (muscle.carriers.empty()) see(from_capture(body));
  return std::min(release, Real{1});
}

std::vector<FieldPlacement> place_fields(const PreparedMuscle& muscle, const Pose& pose) {
  std::vector<FieldPlacement> placements;
  for (Index body : muscle.contact_bodies) {
    const RigidTransform to_capture =
        pose.bodies[static_cast<std::size_t>(body)].inverse() * Eigen::Translation3d(muscle.origin);
    placements.push_back({to_capture.linear().cast<float>(), to_capture.translation().cast<float>(),
                          static_cast<float>(release_of(muscle, pose, body))});
  }
  return placements;
}

void set_target_lengths(const PreparedMuscle& muscle, const Pose& pose, MuscleState& state) {
  AlignedVector<float>& target_length = state.target_length;
  const DistanceSet& edges = muscle.system.distances;
  if (!muscle.settings.slack_uptake || muscle.carriers.size() < 2) {
    std::copy(edges.rest_length.begin(), edges.rest_length.end(), target_length.begin());
    return;
  }
  Points carried = skinned_rest(muscle, pose, state);
  const Real swollen = enclosed_volume(carried, muscle.faces) / muscle.system.volume.target;
  if (swollen > 1) carried /= std::cbrt(swollen);
  const Real longest =
      muscle.settings.stretch_limit > 0 ? muscle.settings.stretch_limit : std::numeric_limits<Real>::infinity();
  parallel_for(static_cast<Index>(edges.a.size()), 4096, [&](Index begin, Index end) {
    for (auto slot = static_cast<std::size_t>(begin); slot < static_cast<std::size_t>(end); ++slot) {
      const Index a = edges.a[slot], b = edges.b[slot];
      target_length[slot] = edges.rest_length[slot];
      if (a >= carried.cols() || b >= carried.cols()) continue;  // padding
      const Real rest = (muscle.rest.col(b) - muscle.rest.col(a)).norm();
      if (!(rest > 0)) continue;
      const Real ratio = (carried.col(b) - carried.col(a)).norm() / rest;
      target_length[slot] *= static_cast<float>(std::clamp(ratio, shortest_share, longest));
    }
  });
}

}  // namespace gracilis::xpbd
