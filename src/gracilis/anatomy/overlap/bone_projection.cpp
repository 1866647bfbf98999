#include <gracilis/anatomy/overlap/bone_projection.hpp>

#include <gracilis/core/parallel.hpp>

#include <algorithm>
#include <limits>

namespace gracilis {

namespace {

/// Fields are in single precision: within this of its gap, m, a vertex counts as keeping it.
constexpr float tolerance = 1e-6f;
/// Gradients shorter than this, squared, tell no way out: on a field's ridges they fade.
constexpr float least_slope2 = 1e-2f;
/// Shortest step on a way back, m.
constexpr Real shortest_step = 1e-5;

FieldSample sample_at(const FieldGrid& field, const RigidTransform& to_bone, const Points& points, Index v) {
  return sample(field, Eigen::Vector3f((to_bone * Vec3(points.col(v))).cast<float>()));
}

}  // namespace

BoneProjection::BoneProjection(const Scene& scene, const Muscle& muscle, const std::vector<Index>& fixed_body,
                               const std::vector<DistanceField>& fields, Real margin, bool rest_gap)
    : BoneProjection(scene, muscle.surface.vertices, fixed_body, fields,
                     std::vector<Real>(static_cast<std::size_t>(muscle.surface.vertex_count()), margin), rest_gap) {}

BoneProjection::BoneProjection(const Scene& scene, const Points& rest, const std::vector<Index>& fixed_body,
                               const std::vector<DistanceField>& fields, const std::vector<Real>& margins,
                               bool rest_gap) {
  for (std::size_t b = 0; b < scene.bones.size(); ++b) {
    PerBone bone{scene.bones[b].body, grid_of(fields[b]), {}};
    for (Index v = 0; v < static_cast<Index>(rest.cols()); ++v) {
      const auto at = static_cast<std::size_t>(v);
      const auto margin = static_cast<float>(margins[at]);
      const float at_rest = sample_at(bone.field, RigidTransform::Identity(), rest, v).distance;
      bone.gap.push_back(fixed_body[at] >= 0 ? -std::numeric_limits<float>::infinity()
                         : rest_gap          ? std::min(at_rest, margin)
                                             : margin);
    }
    bones_.push_back(std::move(bone));
  }
}

Index BoneProjection::push_out(const Pose& pose, Points& points) const {
  Index pushed = 0;
  for (const PerBone& bone : bones_) {
    const RigidTransform to_world = pose.bodies[static_cast<std::size_t>(bone.body)], to_bone = to_world.inverse();
    std::vector<char> touched(bone.gap.size(), 0);
    parallel_for(static_cast<Index>(bone.gap.size()), 1024, [&](Index begin, Index end) {
      for (Index v = begin; v < end; ++v) {
        const FieldSample found = sample_at(bone.field, to_bone, points, v);
        const float missing = bone.gap[static_cast<std::size_t>(v)] - found.distance;
        const float slope2 = found.gradient.squaredNorm();
        if (!(missing > tolerance) || !(slope2 > least_slope2)) continue;
        points.col(v) += to_world.linear() * (missing / slope2 * found.gradient).cast<Real>();
        touched[static_cast<std::size_t>(v)] = 1;
      }
    });
    pushed += static_cast<Index>(std::count(touched.begin(), touched.end(), 1));
  }
  return pushed;
}

Index BoneProjection::take_back(const Pose& pose, const Points& began, Points& points) const {
  Index taken = 0;
  for (const PerBone& bone : bones_) {
    const RigidTransform to_bone = pose.bodies[static_cast<std::size_t>(bone.body)].inverse();
    std::vector<char> touched(bone.gap.size(), 0);
    parallel_for(static_cast<Index>(bone.gap.size()), 1024, [&](Index begin, Index end) {
      for (Index v = begin; v < end; ++v) {
        const Vec3 from = points.col(v), way = began.col(v) - from;
        const Real length = way.norm();
        Real gone = 0;
        while (gone <= length) {
          // What is missing is the least that it must go.
          const float missing =
              bone.gap[static_cast<std::size_t>(v)] - sample_at(bone.field, to_bone, points, v).distance;
          if (!(missing > tolerance)) break;
          touched[static_cast<std::size_t>(v)] = 1;
          gone += std::max(static_cast<Real>(missing), shortest_step);
          points.col(v) = gone < length ? Vec3(from + gone / length * way) : Vec3(began.col(v));
        }
      }
    });
    taken += static_cast<Index>(std::count(touched.begin(), touched.end(), 1));
  }
  return taken;
}

Index BoneProjection::take_along(const Pose& last, const Pose& now, const Points& before, Points& points) const {
  Index taken = 0;
  for (const PerBone& bone : bones_) {
    const RigidTransform& to_world = now.bodies[static_cast<std::size_t>(bone.body)];
    const RigidTransform to_bone = to_world.inverse();
    const RigidTransform motion = to_world * last.bodies[static_cast<std::size_t>(bone.body)].inverse();
    for (Index v = 0; v < static_cast<Index>(bone.gap.size()); ++v) {
      const float distance = sample_at(bone.field, to_bone, points, v).distance;
      if (!(bone.gap[static_cast<std::size_t>(v)] - distance > tolerance)) continue;
      points.col(v) = motion * Vec3(before.col(v));
      ++taken;
    }
  }
  return taken;
}

}  // namespace gracilis
