#include <gracilis/methods/xpbd/xpbd_method.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/methods/xpbd/motion.hpp>
#include <gracilis/methods/xpbd/preparation.hpp>

#include <chrono>
#include <exception>

namespace gracilis {

namespace xpbd {

static Pose capture_pose(std::size_t body_count) {
  Pose pose;
  pose.bodies.assign(body_count, RigidTransform::Identity());
  return pose;
}

static SolveSettings solve_settings(const XpbdSettings& settings) {
  SolveSettings solve;
  solve.iterations = settings.iterations;
  solve.time_step = settings.time_step / settings.substeps;
  solve.projection.time_step =
      static_cast<float>(settings.constraint_time_step > 0 ? settings.constraint_time_step : solve.time_step);
  solve.projection.rayleigh_beta = static_cast<float>(settings.rayleigh_beta);
  solve.projection.hinge_limit = static_cast<float>(settings.hinge_limit);
  solve.projection.arccos_hinges = settings.dihedral_formula == DihedralFormula::arccos;
  solve.pressure = settings.pressure;
  solve.stretch_limit = static_cast<float>(settings.stretch_limit);
  solve.stop_displacement = static_cast<float>(settings.stop_displacement);
  solve.stop_milliseconds = settings.stop_milliseconds / settings.substeps;
  return solve;
}

static Eigen::Map<Eigen::Vector3f> velocity_of(SurfaceState& state, Index p) {
  return Eigen::Map<Eigen::Vector3f>(state.velocities.data() + 3 * static_cast<std::size_t>(p));
}

/// x += dt v + dt² g, v the damped velocity (dynamic mode).
static void coast(const XpbdSettings& settings, float time_step, SurfaceState& state) {
  for (Index p = 0; p < state.particles.count(); ++p) {
    if (!(state.particles.inverse_mass(p) > 0)) continue;
    Eigen::Map<Eigen::Vector3f> velocity = velocity_of(state, p);
    velocity = static_cast<float>(settings.damping) * velocity + time_step * settings.gravity.cast<float>();
    state.particles.position(p) += time_step * velocity;
  }
}

static void take_velocities(float time_step, SurfaceState& state) {
  for (Index p = 0; p < state.particles.count(); ++p)
    velocity_of(state, p) = (state.particles.position(p) - state.start.position(p)) / time_step;
}

/// Into the scene's order; nothing in quasi-static mode, which carries no velocity.
static void write_velocities(const PreparedMuscle& muscle, const SurfaceState& state, Points& velocities) {
  const bool carried = muscle.settings.time_mode == TimeMode::dynamic;
  velocities.resize(3, carried ? muscle.rest.cols() : 0);
  for (Index p = 0; p < velocities.cols(); ++p)
    velocities.col(muscle.order[static_cast<std::size_t>(p)]) =
        Eigen::Map<const Eigen::Vector3f>(state.velocities.data() + 3 * static_cast<std::size_t>(p)).cast<Real>();
}

static Real farthest(const Particles& from, const Particles& to) {
  float largest2 = 0;
  for (Index p = 0; p < to.count(); ++p)
    largest2 = std::max(largest2, (to.position(p) - from.position(p)).squaredNorm());
  return static_cast<Real>(std::sqrt(largest2));
}

/// Where the bodies are `share` of the way from one pose to the next, for substeps.
static Pose pose_between(const Pose& before, const Pose& now, Real share) {
  if (share >= 1) return now;
  Pose pose = now;
  for (std::size_t b = 0; b < pose.bodies.size(); ++b) {
    const Eigen::Quaterniond from(before.bodies[b].linear()), to(now.bodies[b].linear());
    pose.bodies[b].linear() = from.slerp(share, to).toRotationMatrix();
    pose.bodies[b].translation() = (1 - share) * before.bodies[b].translation() + share * now.bodies[b].translation();
  }
  return pose;
}

/// Moves the state to `pose` as far as bones and inertia alone tell.
static void predict(const PreparedMuscle& muscle, const Pose& before, const Pose& pose, float time_step,
                    SurfaceState& state) {
  const XpbdSettings& settings = muscle.settings;
  state.start = state.particles;
  if (settings.predictor) carry_free(muscle, before, pose, state.particles);
  // Velocities are relative to the carried motion, so the predictor adds no momentum of its own.
  if (settings.predictor) state.start = state.particles;
  if (settings.time_mode == TimeMode::dynamic) coast(settings, time_step, state);
  move_attached(muscle, pose, state.particles);
  move_attached(muscle, pose, state.start);
  set_target_lengths(muscle, pose, state.target_length);
}

/// Repeats the step from `state` and names the first kind of constraint after which a coordinate is not finite.
static ConstraintKind first_non_finite(const PreparedMuscle& muscle, const std::vector<FieldPlacement>& placements,
                                       const SolveSettings& settings, SurfaceState state) {
  SolveReport ignored;
  if (!is_finite(state.particles)) return ConstraintKind::none;
  refresh_contacts(muscle.system, placements, state);
  for (int i = 0; i < settings.iterations; ++i)
    for (ConstraintKind kind :
         {ConstraintKind::distance, ConstraintKind::dihedral, ConstraintKind::volume, ConstraintKind::bone_contact}) {
      project_kind(kind, muscle.system, placements, settings, state, ignored);
      if (!is_finite(state.particles)) return kind;
    }
  return ConstraintKind::none;
}

static MuscleReport advance_muscle(const PreparedMuscle& muscle, const Pose& before, const Pose& now,
                                   SurfaceState& state) {
  const auto begin = std::chrono::steady_clock::now();
  const SolveSettings settings = solve_settings(muscle.settings);
  const auto time_step = static_cast<float>(settings.time_step);
  MuscleReport report;
  Pose reached = before;
  for (int substep = 1; substep <= muscle.settings.substeps; ++substep) {
    const Pose pose = pose_between(before, now, static_cast<Real>(substep) / muscle.settings.substeps);
    predict(muscle, reached, pose, time_step, state);
    const std::vector<FieldPlacement> placements = place_fields(muscle, pose);
    SurfaceState predicted = state;
    const SolveReport solved = solve_substep(muscle.system, placements, settings, state);
    if (!is_finite(state.particles)) {
      const ConstraintKind kind = first_non_finite(muscle, placements, settings, std::move(predicted));
      throw QualityError("muscle " + muscle.name + ": a vertex position is not finite after the " + name_of(kind) +
                         " constraint; soften the material or raise `iterations`");
    }
    if (muscle.settings.time_mode == TimeMode::dynamic) take_velocities(time_step, state);
    report.iterations += solved.iterations;
    report.contacts = solved.contacts;
    report.limited_hinges += solved.limited_hinges;
    report.limited_edges += solved.limited_edges;
    report.skipped_constraints += solved.skipped_constraints;
    report.largest_correction = std::max(report.largest_correction, farthest(predicted.particles, state.particles));
    reached = pose;
  }
  report.milliseconds = std::chrono::duration<Real, std::milli>(std::chrono::steady_clock::now() - begin).count();
  return report;
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
  }

  void reset() override {
    for (std::size_t m = 0; m < muscles_.size(); ++m) states_[m] = make_state(muscles_[m].system);
    pose_ = capture_pose(pose_.bodies.size());
  }

  StepReport advance(const Pose& pose) override {
    StepReport report;
    report.muscles.resize(muscles_.size());
    std::vector<SurfaceState> next = states_;
    std::vector<std::exception_ptr> failures(muscles_.size());
    parallel_for(static_cast<Index>(muscles_.size()), 1, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        const auto m = static_cast<std::size_t>(i);
        try {
          report.muscles[m] = advance_muscle(muscles_[m], pose_, pose, next[m]);
        } catch (const QualityError&) {
          failures[m] = std::current_exception();
        }
      }
    });
    // The first in the scene's order, whichever thread was faster.
    for (const std::exception_ptr& failure : failures)
      if (failure) std::rethrow_exception(failure);
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
        if (muscle.settings.predictor) carry_free(muscle, before.pose, last.pose, state.start);
        take_velocities(static_cast<float>(muscle.settings.time_step), state);
      }
      states_[m] = std::move(state);
    }
    pose_ = last.pose;
  }

 private:
  std::vector<DistanceField> fields_;
  std::vector<PreparedMuscle> muscles_;
  std::vector<SurfaceState> states_;
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
