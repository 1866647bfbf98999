#include <gracilis/methods/skinning/skinning_method.hpp>

#include <gracilis/anatomy/skinning_weights.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/rigid_blend.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/scene/setting_values.hpp>

#include <algorithm>
#include <chrono>

namespace gracilis {

struct SkinningSettings {
  Real tendon_length = 0.03;  ///< m from attachments, graded from tendon to belly; 0: no tendons
};

template <>
std::span<const Setting<SkinningSettings>> setting_table() {
  using S = SkinningSettings;
  static const Setting<S> table[] = {
      {"tendon_length", &S::tendon_length, "m", 0, 1,
       "Distance from the attachments over which the surface is graded from tendon to belly, so that the bones' motion "
       "stretches the belly and not the triangles beside an attachment; 0 grades nothing."},
  };
  return table;
}

namespace {

/// What stays the same of one muscle.
struct SkinnedMuscle {
  std::string name;
  Points rest;                    ///< world, in the capture pose, m
  Vec3 center = Vec3::Zero();     ///< of the rest, about which motions are blended
  std::vector<Index> fixed_body;  ///< per vertex: the body it is attached to, or -1
  std::vector<Index> bodies;      ///< that it is attached to
  Eigen::MatrixXf weights;        ///< bodies × vertices
};

SkinnedMuscle prepare(const Scene& scene, const Muscle& muscle) {
  const SkinningSettings settings =
      with_values(with_values(SkinningSettings{}, scene.method.settings), muscle.settings);
  SkinnedMuscle result;
  result.name = muscle.name;
  result.rest = muscle.surface.vertices;
  result.center = result.rest.rowwise().mean();
  result.fixed_body.assign(static_cast<std::size_t>(result.rest.cols()), -1);
  for (const Attachment& attachment : muscle.attachments) {
    for (const Index v : attachment.vertices) result.fixed_body[static_cast<std::size_t>(v)] = attachment.body;
    result.bodies.push_back(attachment.body);
  }
  std::sort(result.bodies.begin(), result.bodies.end());
  result.bodies.erase(std::unique(result.bodies.begin(), result.bodies.end()), result.bodies.end());
  const MeshTopology topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  if (!result.bodies.empty())
    result.weights =
        skinning_weights(muscle.surface, topology, result.fixed_body, result.bodies, settings.tendon_length);
  return result;
}

Points shape_at(const SkinnedMuscle& muscle, const Pose& pose) {
  Points shape = muscle.rest;
  if (muscle.bodies.empty()) return shape;
  const Eigen::Translation3d from_center(muscle.center);
  std::vector<RigidTransform> motions;
  for (const Index body : muscle.bodies)
    motions.push_back(from_center.inverse() * pose.bodies[static_cast<std::size_t>(body)] * from_center);
  const RigidBlend blended = prepare_blend(motions);
  parallel_for(static_cast<Index>(shape.cols()), 512, [&](Index begin, Index end) {
    std::vector<Real> weights(muscle.bodies.size());
    for (Index v = begin; v < end; ++v) {
      if (const Index body = muscle.fixed_body[static_cast<std::size_t>(v)]; body >= 0) {
        shape.col(v) = pose.bodies[static_cast<std::size_t>(body)] * Vec3(shape.col(v));
        continue;
      }
      Real sum = 0;
      for (std::size_t b = 0; b < weights.size(); ++b)
        sum += weights[b] = static_cast<Real>(muscle.weights(static_cast<Index>(b), v));
      if (!(sum > 0)) continue;  // no attachment reaches it
      for (Real& weight : weights) weight /= sum;
      shape.col(v) = from_center * (blend(blended, weights) * Vec3(shape.col(v) - muscle.center));
    }
  });
  return shape;
}

class SkinningMethod final : public DeformationMethod {
 public:
  explicit SkinningMethod(const Scene& scene) : muscles_(scene.muscles.size()) {
    parallel_for_each(muscles_.size(), [&](std::size_t m) { muscles_[m] = prepare(scene, scene.muscles[m]); });
    reset();
  }

  void reset() override {
    shapes_.clear();
    for (const SkinnedMuscle& muscle : muscles_) shapes_.push_back(muscle.rest);
  }

  StepReport advance(const Pose& pose, Real) override {
    StepReport report;
    std::vector<Points> next;
    for (const SkinnedMuscle& muscle : muscles_) {
      const auto started = std::chrono::steady_clock::now();
      next.push_back(shape_at(muscle, pose));
      const std::chrono::duration<Real, std::milli> taken = std::chrono::steady_clock::now() - started;
      report.muscles.push_back({taken.count()});
      if (!next.back().allFinite())
        throw QualityError("muscle " + muscle.name + ": a vertex position is not finite; check the pose");
    }
    shapes_ = std::move(next);
    return report;
  }

  void write(Frame& frame) const override {
    frame.muscles.clear();
    for (const Points& shape : shapes_) frame.muscles.push_back({shape});
  }

  void restore(const std::vector<Pose>&, const Frame&, const Frame& last) override {
    for (std::size_t m = 0; m < shapes_.size(); ++m) shapes_[m] = last.muscles[m].points;
  }

 private:
  std::vector<SkinnedMuscle> muscles_;
  std::vector<Points> shapes_;
};

}  // namespace

std::unique_ptr<DeformationMethod> make_skinning_method(const Scene& scene) {
  return std::make_unique<SkinningMethod>(scene);
}

MethodEntry skinning_entry() {
  return {.name = "skinning",
          .meaning = "a blend of the motions of the bodies that they are attached to, to compare with",
          .settings = describe_settings<SkinningSettings>(),
          .make = [](const Scene& scene, const BoneFieldSource&) { return make_skinning_method(scene); }};
}

}  // namespace gracilis
