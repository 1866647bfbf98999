#include <gracilis/methods/tissue/tissue_method.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/methods/tissue/carry.hpp>
#include <gracilis/methods/tissue/ends_on_muscles.hpp>
#include <gracilis/methods/tissue/forces.hpp>
#include <gracilis/methods/tissue/seen_apart.hpp>
#include <gracilis/methods/tissue/seen_surface.hpp>
#include <gracilis/methods/tissue/settle_muscles.hpp>
#include <gracilis/scene/setting_values.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace gracilis {

namespace {

using namespace tissue;

/// Metrics are made for activations in steps of this.
constexpr int activation_steps = 4;
class TissueMethod final : public DeformationMethod {
 public:
  TissueMethod(const Scene& scene, std::vector<DistanceField> fields)
      : fields_(std::move(fields)), body_count_(scene.bodies.size()), groups_(hosts_first(scene)) {
    for (const Bone& bone : scene.bones) distances_.emplace_back(bone.surface);
    tissues_ = prepare_tissues(scene, fields_, distances_);
    metrics_.resize(tissues_.muscles.size());
    reset();
  }

  void reset() override {
    nodes_.clear();
    for (const PreparedTissue& muscle : tissues_.muscles) nodes_.push_back(muscle.lattice.nodes);
    bodies_.assign(body_count_, RigidTransform::Identity());
    expected_move_ = neighbor_reach;
    equilibria_.clear();
    seen_.clear();
    for (std::size_t m = 0; m < tissues_.muscles.size(); ++m) {
      equilibria_.push_back(at_rest(m));
      seen_.push_back(surface_at(tissues_.muscles[m], nodes_[m]));
    }
    frame_ = 0;
  }

  StepReport advance(const Pose& asked, Real) override {
    Pose pose = asked;
    std::vector<MovingMuscle> moving(tissues_.muscles.size());
    for_each_timed(moving, [&](std::size_t m) { moving[m] = begun(m, pose); });
    int count = 1;
    for (const PreparedTissue& muscle : tissues_.muscles)
      count = std::max(count, steps_needed(muscle, bodies_, pose.bodies));
    for (int step = 1; step <= count; ++step) {
      for (const std::vector<std::size_t>& group : groups_) {
        parallel_for_each(group.size(), [&](std::size_t i) {
          timed(moving[group[i]], [&] { carry_on(group[i], pose, step, count, moving[group[i]]); });
        });
        carry_ends(group, moving, pose);
      }
      expected_move_ = settle_muscles(tissues_, expected_move_, moving);
    }
    for_each_timed(moving, [&](std::size_t m) {
      moving[m].seen = seen_surface(tissues_.muscles[m], moving[m].equilibrium.around, distances_, moving[m].nodes);
    });
    keep_seen_apart(tissues_, distances_, expected_move_, moving);
    for (std::size_t m = 0; m < tissues_.muscles.size(); ++m)
      require_finite(tissues_.muscles[m], moving[m].seen.allFinite());
    StepReport report;
    for (std::size_t m = 0; m < tissues_.muscles.size(); ++m) report.muscles.push_back(reported(m, moving[m]));
    for (std::size_t m = 0; m < tissues_.muscles.size(); ++m) {
      nodes_[m] = std::move(moving[m].nodes);
      seen_[m] = std::move(moving[m].seen);
      equilibria_[m] = std::move(moving[m].equilibrium);
    }
    bodies_ = pose.bodies;
    ++frame_;
    return report;
  }

  void write(Frame& frame) const override {
    frame.muscles.clear();
    for (std::size_t m = 0; m < tissues_.muscles.size(); ++m)
      frame.muscles.push_back(
          {.points = seen_[m],
           .fiber_stresses = vertex_fiber_stresses(tissues_.muscles[m], equilibria_[m].laws, nodes_[m])});
  }

  std::vector<MuscleForces> muscle_forces(const std::vector<std::vector<Twist>>& coordinates) const override {
    std::vector<MuscleForces> forces(tissues_.muscles.size());
    parallel_for_each(tissues_.muscles.size(), [&](std::size_t m) {
      const Equilibrium& found = equilibria_[m];
      forces[m] = tissue::muscle_forces(tissues_.muscles[m], found.around, found.laws, nodes_[m], coordinates);
    });
    return forces;
  }

  /// Surfaces do not tell where the nodes inside are, so all frames are gone through again.
  void restore(const std::vector<Pose>& poses, const Frame&, const Frame&) override {
    reset();
    for (std::size_t i = 1; i < poses.size(); ++i) advance(poses[i], usual_time_step);
  }

 private:
  const FactoredMatrix& metric(std::size_t m, Real activation) {
    const auto level = static_cast<int>(std::lround(activation * activation_steps));
    FactoredMatrix& found = metrics_[m][level];
    if (found.empty())
      found = FactoredMatrix(
          scalar_stiffness(tissues_.muscles[m], cell_laws(tissues_.muscles[m], Real(level) / activation_steps, 1)));
    return found;
  }

  /// At the capture pose nothing pulls.
  Equilibrium at_rest(std::size_t m) const {
    Equilibrium found{cell_laws(tissues_.muscles[m], 0, 0), {}};
    found.around = surroundings(tissues_.muscles[m], bodies_, found.laws);
    found.around.others = others_of(m);
    return found;
  }

  /// Puts what these muscles carry where they are now.
  void carry_ends(const std::vector<std::size_t>& muscles, const std::vector<MovingMuscle>& moving, Pose& pose) const {
    for (const EndOnMuscle& end : tissues_.ends) {
      if (std::find(muscles.begin(), muscles.end(), end.host) == muscles.end()) continue;
      pose.bodies[static_cast<std::size_t>(end.body.body)] =
          motion_of(end.body, surface_at(tissues_.muscles[end.host], moving[end.host].nodes));
    }
  }

  MovingMuscle begun(std::size_t m, const Pose& pose) {
    for (const RigidTransform& body : pose.bodies) require_finite(tissues_.muscles[m], body.matrix().allFinite());
    const Real activation = m < pose.activations.size() ? pose.activations[m] : 0;
    const Real tension = std::min(1.0, Real(frame_ + 1) / tissues_.muscles[m].settings.tension_frames);
    MovingMuscle moving;
    moving.nodes = nodes_[m];
    moving.active_tension = tension * activation * tissues_.muscles[m].settings.largest_active_stress;
    moving.bodies = bodies_;
    moving.metric = &metric(m, activation);
    moving.equilibrium.laws = cell_laws(tissues_.muscles[m], activation, tension);
    // They hold at any instant, so nothing is lost where this pose fails.
    moving.equilibrium.around.queries = std::move(equilibria_[m].around.queries);
    moving.equilibrium.next_pressure = equilibria_[m].next_pressure;
    return moving;
  }

  void carry_on(std::size_t m, const Pose& pose, int step, int count, MovingMuscle& moving) const {
    std::vector<RigidTransform> now = bodies_after(step, count, tissues_.muscles[m], bodies_, pose.bodies);
    for (const EndOnMuscle& end : tissues_.ends)
      if (end.guest == m) {
        const auto body = static_cast<std::size_t>(end.body.body);
        now[body] = pose.bodies[body];  // where the muscle below has come by this step
      }
    carry(tissues_.muscles[m], moving.bodies, now, moving.nodes);
    std::vector<CachedBoneQuery> queries = std::move(moving.equilibrium.around.queries);
    moving.equilibrium.around = surroundings(tissues_.muscles[m], now, moving.equilibrium.laws);
    moving.equilibrium.around.queries = std::move(queries);
    moving.equilibrium.around.others = others_of(m);
    moving.equilibrium.around.laws.least_volume_ratio =
        std::min(least_settled_ratio, least_volume_ratio(tissues_.muscles[m].lattice, moving.nodes) / 2);
    moving.bodies = now;
  }

  MuscleReport reported(std::size_t m, const MovingMuscle& moving) const {
    const Wrench pull =
        attachment_wrench(tissues_.muscles[m], moving.equilibrium.around, moving.nodes, AttachmentEnd::insertion);
    return {moving.milliseconds,
            {{"cells", static_cast<Real>(tissues_.muscles[m].lattice.cell_count())},
             {"minimizer_iterations", static_cast<Real>(moving.iterations)},
             {"residual_n", moving.done.residual},
             {"pull_n", pull.force.norm()},
             {"least_volume_ratio", least_volume_ratio(tissues_.muscles[m].lattice, moving.nodes)}}};
  }

  /// The muscles that one may touch, or that may lie on it.
  std::vector<Index> others_of(std::size_t m) const {
    std::vector<Index> others;
    for (std::size_t other = 0; other < tissues_.muscles.size(); ++other) {
      const bool pulls = std::any_of(tissues_.ends.begin(), tissues_.ends.end(),
                                     [&](const EndOnMuscle& end) { return end.host == m && end.guest == other; });
      if (other != m && (pulls || !tissues_.neighbors.pairs.empty())) others.push_back(static_cast<Index>(other));
    }
    return others;
  }

  std::vector<DistanceField> fields_;      ///< of all bones, which the muscles look at
  std::vector<SignedDistance> distances_;  ///< to the bones
  std::size_t body_count_;
  std::vector<std::vector<std::size_t>> groups_;  ///< of muscles, hosts first
  TissueMuscles tissues_;
  std::vector<std::map<int, FactoredMatrix>> metrics_;  ///< by muscle and activation, made when first asked for
  std::vector<Points> nodes_;
  std::vector<Points> seen_;  ///< surfaces, 3 × vertices
  std::vector<Equilibrium> equilibria_;
  std::vector<RigidTransform> bodies_;
  Real expected_move_ = neighbor_reach;  ///< m, of a node, until muscles look at each other again
  int frame_ = 0;
};

}  // namespace

std::unique_ptr<DeformationMethod> make_tissue_method(const Scene& scene, std::vector<DistanceField> fields) {
  return std::make_unique<TissueMethod>(scene, std::move(fields));
}

/// Muscles look at each other as often as that of them which asks for it most often.
static bool muscles_meet(const Scene& scene) {
  return scene.muscles.size() > 1 && std::any_of(scene.muscles.begin(), scene.muscles.end(), [&](const Muscle& muscle) {
           return tissue_settings(scene, muscle).contact_rounds > 0;
         });
}

MethodEntry tissue_entry() {
  return {
      .name = "tissue",
      .meaning = "their inside as tissue under tension, at rest in every frame",
      .settings = describe_settings<TissueSettings>(),
      .metrics = {{"cells"}, {"minimizer_iterations"}, {"residual_n", 6}, {"pull_n", 3}, {"least_volume_ratio", 3}},
      .make = [](const Scene& scene,
                 const BoneFieldSource& fields) { return make_tissue_method(scene, fields(scene.distance_fields)); },
      .has_surface_contact = muscles_meet};
}

}  // namespace gracilis
