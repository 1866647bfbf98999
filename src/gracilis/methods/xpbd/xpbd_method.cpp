#include <gracilis/methods/xpbd/xpbd_method.hpp>

#include <gracilis/anatomy/overlap/bone_field.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/methods/pass_tracing.hpp>
#include <gracilis/methods/placed_method.hpp>
#include <gracilis/methods/xpbd/frame_budget.hpp>
#include <gracilis/methods/xpbd/level.hpp>
#include <gracilis/methods/xpbd/motion.hpp>
#include <gracilis/methods/xpbd/prediction.hpp>
#include <gracilis/methods/xpbd/settings.hpp>
#include <gracilis/methods/xpbd/step_counts.hpp>
#include <gracilis/scene/scene_place.hpp>

#include <algorithm>
#include <chrono>
#include <optional>

namespace gracilis {

namespace xpbd {

/// Into the scene's order; nothing in quasi-static mode, which carries no velocity.
static void write_velocities(const PreparedMuscle& muscle, const MuscleState& state, Points& velocities) {
  const bool carried = muscle.settings.time_mode == TimeMode::dynamic;
  velocities.resize(3, carried ? muscle.rest.cols() : 0);
  for (Index p = 0; p < velocities.cols(); ++p)
    velocities.col(muscle.order[static_cast<std::size_t>(p)]) =
        Eigen::Map<const Eigen::Vector3f>(state.velocities.data() + 3 * static_cast<std::size_t>(p)).cast<Real>();
}

/// Edge lengths of copies that a rate of frames is tried with, finest first, m.
constexpr Real tried_edges[] = {0.004, 0.005, 0.006, 0.008, 0.01};
/// A level of detail is fine enough to keep where it has time for this share of the iterations: more of them on a
/// coarser copy come nearer to the converged shape (docs/decisions).
constexpr Real wanted_share = 0.5;

class XpbdMethod final : public DeformationMethod, public PassTracing {
 public:
  XpbdMethod(const Scene& scene, std::vector<DistanceField> fields, std::vector<DistanceField> far_fields)
      : fields_(std::move(fields)),
        far_fields_(std::move(far_fields)),
        bones_(strings::bone_distances(scene, far_fields_)),
        pose_(capture_pose(scene.bodies.size())) {
    bool is_coarser = false;
    for (const Muscle& muscle : scene.muscles) {
      const XpbdSettings settings = xpbd_settings(scene, muscle);
      is_coarser |= settings.simulated_edge > 0;
      asked_.push_back(settings);
      if (settings.target_fps > 0) budget_.budget = 1000 / settings.target_fps;
    }
    // Copies meet in the surfaces' place, at a fraction of the time.
    full_ = make_level(scene, fields_, carrying_strings(scene, bones_), !is_coarser);
    if (is_coarser) coarser_ = make_coarser_level(scene, full_, fields_);
    asked_triangles_ = triangle_count(simulated());
    if (budget_.budget > 0) choose_level(scene);
  }

  void reset() override {
    xpbd::reset(full_);
    if (coarser_) xpbd::reset(coarser_->level);
    pose_ = capture_pose(pose_.bodies.size());
    budgets_.clear();
  }

  StepReport advance(const Pose& pose, Real time_step) override {
    const auto started = std::chrono::steady_clock::now();
    std::vector<StepCounts> counts(full_.muscles.size());
    std::vector<Real> activations;
    for (std::size_t m = 0; m < full_.muscles.size(); ++m) activations.push_back(activation_of(m, pose));
    for (std::size_t m = 0; m < full_.muscles.size(); ++m) {
      simulated().muscles[m].settings.iterations = budgeted_iterations(budget_, asked_[m].iterations);
      for (Level* level : {&full_, &simulated()}) level->muscles[m].settings.time_step = time_step_of(m, time_step);
    }
    std::vector<MuscleState> next = simulated().states;
    xpbd::advance(simulated(), pose_, pose, activations, next, counts);
    if (coarser_) {
      std::vector<MuscleState> next_full = full_.states;
      refine(*coarser_, full_, pose_, pose, activations, next, next_full, counts);
      full_.states = std::move(next_full);
    }
    simulated().states = std::move(next);
    pose_ = pose;
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - started;
    StepReport report;
    for (const StepCounts& each : counts) report.muscles.push_back(report_of(each));
    if (budget_.budget > 0) report.metrics = follow_budget(elapsed.count());
    return report;
  }

  void trace_passes(PassTrace trace) override { full_.trace = std::move(trace); }
  PassTracing* pass_tracing() override { return this; }
  bool depends_on_clock() const override {
    return budget_.budget > 0 || std::any_of(asked_.begin(), asked_.end(), [](const XpbdSettings& settings) {
             return settings.stop_milliseconds > 0;
           });
  }
  std::string remark() const override { return remark_on(budgets_); }

  void write(Frame& frame) const override {
    frame.muscles.resize(full_.muscles.size());
    for (std::size_t m = 0; m < full_.muscles.size(); ++m) {
      const PreparedMuscle& muscle = full_.muscles[m];
      Points& points = frame.muscles[m].points;
      points.resize(3, muscle.rest.cols());
      for (Index p = 0; p < muscle.rest.cols(); ++p)
        points.col(muscle.order[static_cast<std::size_t>(p)]) =
            full_.states[m].particles.position(p).cast<Real>() + muscle.origin;
      write_velocities(muscle, full_.states[m], frame.muscles[m].velocities);
    }
  }

  void restore(const std::vector<Pose>& poses, const Frame& before, const Frame& last) override {
    std::vector<MuscleState> states;
    for (const PreparedMuscle& muscle : full_.muscles) states.push_back(make_muscle_state(muscle, full_.bodies));
    replay_strings(coarser_ ? coarser_->level : full_, poses, states);
    for (std::size_t m = 0; m < full_.muscles.size(); ++m) {
      const PreparedMuscle& muscle = full_.muscles[m];
      MuscleState state = std::move(states[m]);
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
        if (muscle.settings.predictor != Predictor::none) carry_start(muscle, m, before.pose, last.pose, state);
        take_velocities(static_cast<float>(time_step_of(m, last.pose.time - before.pose.time)), state);
      }
      full_.states[m] = std::move(state);
    }
    forget_contact(full_.world, full_.contact_state);
    if (coarser_) follow_full(full_, *coarser_);
    pose_ = last.pose;
  }

 private:
  /// Takes `start` from one pose to the next with what carries the muscle.
  void carry_start(const PreparedMuscle& muscle, std::size_t m, const Pose& before, const Pose& last,
                   MuscleState& state) const {
    MuscleState carried = make_muscle_state(muscle, full_.bodies);
    carried.particles = state.start;
    follow_strings(muscle, before, carried);
    carry(muscle, activation_of(m, last) > muscle.contraction.threshold, before, last, carried);
    state.start = carried.particles;
  }

  Level& simulated() { return coarser_ ? coarser_->level : full_; }

  /// s, of a muscle in a frame that takes so long.
  Real time_step_of(std::size_t m, Real of_frame) const {
    return asked_[m].time_step > 0 ? asked_[m].time_step : of_frame;
  }

  Real activation_of(std::size_t m, const Pose& pose) const {
    const Real activation = m < pose.activations.size() ? pose.activations[m] : 0;
    const PreparedMuscle& muscle = full_.muscles[m];
    if (!muscle.is_driven && activation > muscle.contraction.threshold)
      throw ConfigurationError({"", "muscle " + muscle.name, "a pose activates it, but the scene's plan does not",
                                "add it to Scene::activation, so that it is prepared to contract"});
    return activation;
  }

  /// The finest level that has time for enough iterations, by trial at the capture pose.
  void choose_level(const Scene& scene) {
    const Pose rest = pose_;
    const auto is_in_time = [&] {
      Real milliseconds = 0;
      for (int trial = 0; trial < 3; ++trial) {
        budget_.share = wanted_share;
        milliseconds = metric(advance(rest, usual_time_step).metrics, "frame_milliseconds");
      }
      reset();
      budget_.share = wanted_share;
      return milliseconds < budget_.budget;
    };
    if (is_in_time()) return;
    // One iteration on the whole surface keeps its edges within the stretch limit.
    for (PreparedMuscle& muscle : full_.muscles)
      muscle.settings.full_iterations = std::max(muscle.settings.full_iterations, 1);
    for (const Real edge : tried_edges) {
      Scene tried = scene;
      for (Muscle& muscle : tried.muscles)
        muscle.settings["simulated_edge"] = std::max(xpbd_settings(scene, muscle).simulated_edge, edge);
      full_.world = {}, full_.contact_state = {};
      coarser_ = make_coarser_level(tried, full_, fields_);
      if (is_in_time()) return;
    }
  }

  Metrics follow_budget(Real milliseconds) {
    FrameBudgetReport frame{1000 / budget_.budget, milliseconds, 0, 0, triangle_count(simulated()), asked_triangles_};
    for (const SolverSettings& asked : asked_) {
      frame.asked_iterations = std::max(frame.asked_iterations, asked.iterations);
      frame.iterations = std::max(frame.iterations, budgeted_iterations(budget_, asked.iterations));
    }
    see_frame(budget_, milliseconds);
    budgets_.push_back(frame);
    return metrics_of(frame);
  }

  std::vector<DistanceField> fields_, far_fields_;
  strings::BoneDistances bones_;
  Level full_;
  std::optional<CoarserLevel> coarser_;
  Pose pose_;
  std::vector<XpbdSettings> asked_;  ///< per muscle, as the scene has them
  Index asked_triangles_ = 0;
  FrameBudget budget_;
  std::vector<FrameBudgetReport> budgets_;  ///< since the capture pose, where a rate is to be held
};

}  // namespace xpbd

std::unique_ptr<DeformationMethod> make_xpbd_method(const Scene& scene, std::vector<DistanceField> fields,
                                                    std::vector<DistanceField> far_fields) {
  if (far_fields.empty() && needs_far_fields(scene))
    for (const Bone& bone : scene.bones) far_fields.push_back(build_bone_field(bone, strings::far_field_settings()));
  const Vec3 place = place_of(scene);
  if (place.isZero()) return std::make_unique<xpbd::XpbdMethod>(scene, std::move(fields), std::move(far_fields));
  for (std::vector<DistanceField>* each : {&fields, &far_fields})
    for (DistanceField& field : *each) field.origin -= place;
  return placed_method(
      place, std::make_unique<xpbd::XpbdMethod>(shifted(scene, -place), std::move(fields), std::move(far_fields)));
}

bool needs_far_fields(const Scene& scene) {
  return std::any_of(scene.muscles.begin(), scene.muscles.end(),
                     [&](const Muscle& muscle) { return xpbd::asks_for_strings(scene, muscle); });
}

}  // namespace gracilis
