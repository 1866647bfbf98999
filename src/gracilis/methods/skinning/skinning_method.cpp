#include <gracilis/methods/skinning/skinning_method.hpp>

#include <gracilis/anatomy/body_carriers.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/scene/setting_values.hpp>

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
  Points rest;  ///< world, in the capture pose, m
  BodyCarriers carriers;
};

SkinnedMuscle prepare(const Scene& scene, const Muscle& muscle) {
  const SkinningSettings settings =
      with_values(with_values(SkinningSettings{}, scene.method.settings), muscle.settings);
  const MeshTopology topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  return {muscle.name, muscle.surface.vertices, body_carriers(muscle, topology, settings.tendon_length)};
}

Points shape_at(const SkinnedMuscle& muscle, const Pose& pose) {
  const std::vector<RigidTransform> motions = carried_motions(muscle.carriers, pose);
  Points shape = muscle.rest;
  for (Index v = 0; v < static_cast<Index>(shape.cols()); ++v)
    shape.col(v) = motions[static_cast<std::size_t>(v)] * Vec3(muscle.rest.col(v));
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
