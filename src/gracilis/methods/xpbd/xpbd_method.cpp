#include <gracilis/methods/xpbd/xpbd_method.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/methods/xpbd/crowd.hpp>
#include <gracilis/methods/xpbd/motion.hpp>
#include <gracilis/methods/xpbd/preparation.hpp>
#include <gracilis/methods/xpbd/step.hpp>

#include <exception>

namespace gracilis {

namespace xpbd {

/// Into the scene's order; nothing in quasi-static mode, which carries no velocity.
static void write_velocities(const PreparedMuscle& muscle, const SurfaceState& state, Points& velocities) {
  const bool carried = muscle.settings.time_mode == TimeMode::dynamic;
  velocities.resize(3, carried ? muscle.rest.cols() : 0);
  for (Index p = 0; p < velocities.cols(); ++p)
    velocities.col(muscle.order[static_cast<std::size_t>(p)]) =
        Eigen::Map<const Eigen::Vector3f>(state.velocities.data() + 3 * static_cast<std::size_t>(p)).cast<Real>();
}

class XpbdMethod final : public DeformationMethod {
 public:
  XpbdMethod(const Scene& scene, std::vector<DistanceField> fields)
      : fields_(std::move(fields)),
        muscles_(scene.muscles.size()),
        states_(scene.muscles.size()),
        pose_(capture_pose(scene.bodies.size())) {
    parallel_for(static_cast<Index>(muscles_.size()), 1, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        const auto m = static_cast<std::size_t>(i);
        muscles_[m] = prepare_muscle(scene, scene.muscles[m], fields_);
        states_[m] = make_state(muscles_[m].system);
      }
    });
    crowd_ = prepare_crowd(scene.contact, muscles_);
    crowd_state_ = make_crowd_state(crowd_);
  }

  void reset() override {
    for (std::size_t m = 0; m < muscles_.size(); ++m) states_[m] = make_state(muscles_[m].system);
    crowd_state_.edges = make_virtual_edge_state(crowd_.edges);
    pose_ = capture_pose(pose_.bodies.size());
  }

  StepReport advance(const Pose& pose) override {
    StepReport report;
    report.muscles.resize(muscles_.size());
    std::vector<SurfaceState> next = states_;
    std::vector<MuscleStep> steps;
    for (std::size_t m = 0; m < muscles_.size(); ++m)
      steps.push_back({&muscles_[m], &next[m], &report.muscles[m], activation_of(m, pose)});
    if (crowd_.meets())
      advance_crowd(steps, pose);
    else
      advance_each(steps, pose);
    states_ = std::move(next);
    pose_ = pose;
    return report;
  }

  void write(Frame& frame) const override {
    frame.muscles.resize(muscles_.size());
    for (std::size_t m = 0; m < muscles_.size(); ++m) {
      const PreparedMuscle& muscle = muscles_[m];
      Points& points = frame.muscles[m].points;
      points.resize(3, muscle.rest.cols());
      for (Index p = 0; p < muscle.rest.cols(); ++p)
        points.col(muscle.order[static_cast<std::size_t>(p)]) =
            states_[m].particles.position(p).cast<Real>() + muscle.origin;
      write_velocities(muscle, states_[m], frame.muscles[m].velocities);
    }
  }

  void restore(const Frame& before, const Frame& last) override {
    for (std::size_t m = 0; m < muscles_.size(); ++m) {
      const PreparedMuscle& muscle = muscles_[m];
      SurfaceState state = make_state(muscle.system);
      const auto place = [&](const Frame& frame, Particles& particles) {
        for (Index p = 0; p < particles.count(); ++p)
          particles.position(p) =
              (frame.muscles[m].points.col(muscle.order[static_cast<std::size_t>(p)]) - muscle.origin).cast<float>();
      };
      place(before, state.start);
      place(last, state.particles);
      if (last.muscles[m].velocities.cols() == muscle.rest.cols()) {
        for (Index p = 0; p < muscle.rest.cols(); ++p)
          velocity_of(state, p) =
              last.muscles[m].velocities.col(muscle.order[static_cast<std::size_t>(p)]).cast<float>();
      } else {
        // The mean over the frame is all that two shapes can tell.
        if (muscle.settings.predictor)
          carry_free(muscle, before.pose, last.pose, activation_of(m, last.pose) > muscle.contraction.threshold,
                     state.start);
        take_velocities(static_cast<float>(muscle.settings.time_step), state);
      }
      states_[m] = std::move(state);
    }
    crowd_state_.edges = make_virtual_edge_state(crowd_.edges);
    pose_ = last.pose;
  }

 private:
  void advance_crowd(const std::vector<MuscleStep>& steps, const Pose& pose) {
    const VirtualEdgeState edges = crowd_state_.edges;
    try {
      advance_together(steps, crowd_, crowd_state_, pose_, pose);
    } catch (const QualityError&) {
      crowd_state_.edges = edges;
      throw;
    }
  }

  Real activation_of(std::size_t m, const Pose& pose) const {
    const Real activation = m < pose.activations.size() ? pose.activations[m] : 0;
    if (!muscles_[m].is_driven && activation > muscles_[m].contraction.threshold)
      throw ConfigurationError({"", "muscle " + muscles_[m].name, "a pose activates it, but the scene's plan does not",
                                "add it to Scene::activation, so that it is prepared to contract"});
    return activation;
  }

  /// Muscles that never meet need not wait for each other.
  void advance_each(const std::vector<MuscleStep>& steps, const Pose& pose) {
    std::vector<std::exception_ptr> failures(steps.size());
    parallel_for(static_cast<Index>(steps.size()), 1, [&](Index begin, Index end) {
      for (auto m = static_cast<std::size_t>(begin); m < static_cast<std::size_t>(end); ++m) {
        try {
          MuscleCrowdState nobody;
          advance_together({steps[m]}, crowd_, nobody, pose_, pose);
        } catch (const QualityError&) {
          failures[m] = std::current_exception();
        }
      }
    });
    // The first in the scene's order, whichever thread was faster.
    for (const std::exception_ptr& failure : failures)
      if (failure) std::rethrow_exception(failure);
  }

  std::vector<DistanceField> fields_;
  std::vector<PreparedMuscle> muscles_;
  std::vector<SurfaceState> states_;
  MuscleCrowd crowd_;
  MuscleCrowdState crowd_state_;
  Pose pose_;
};

}  // namespace xpbd

std::unique_ptr<DeformationMethod> make_xpbd_method(const Scene& scene, std::vector<DistanceField> fields) {
  return std::make_unique<xpbd::XpbdMethod>(scene, std::move(fields));
}

DistanceField build_bone_field(const Bone& bone, const DistanceFieldSettings& settings) {
  return build_distance_field(bone.surface,
                              settings.resolution > 0
                                  ? domain_by_resolution(bone.surface, settings.resolution, settings.domain_factor)
                                  : domain_by_cell_size(bone.surface, settings.cell_size, settings.domain_margin));
}

}  // namespace gracilis
