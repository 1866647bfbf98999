#include <gracilis/methods/tissue/tissue_method.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/methods/tissue/carry.hpp>
#include <gracilis/methods/tissue/factored_matrix.hpp>
#include <gracilis/methods/tissue/forces.hpp>
#include <gracilis/methods/tissue/minimize.hpp>
#include <gracilis/methods/tissue/total_energy.hpp>
#include <gracilis/scene/setting_values.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

namespace gracilis {

namespace {

using namespace tissue;

/// Metrics are made for activations in steps of this.
constexpr int activation_steps = 4;
/// How often in a step it is looked anew what bones are near.
constexpr int most_rounds = 4;

/// To the least energy near the nodes.
Minimized settle(const PreparedTissue& muscle, Surroundings& around, const FactoredMatrix& metric, Points& nodes) {
  MinimizeSettings settings = {muscle.settings.minimizer_iterations, muscle.settings.minimizer_residual,
                               muscle.lattice.cell_size};
  EnergyWorkspace workspace;
  const auto energy = [&](const Points& at, Points& gradient) {
    return total_energy(muscle, around, at, workspace, gradient);
  };
  const auto by_metric = [&](std::span<Points> gradients) { metric.solve(gradients); };
  Minimized sum;
  for (int round = 0; round < most_rounds; ++round) {
    find_near_bones(muscle, nodes, around);
    const Points from = nodes;
    const Minimized done = minimize(energy, by_metric, settings, nodes);
    sum = {sum.iterations + done.iterations, done.energy, done.residual};
    settings.iterations -= done.iterations;
    if (settings.iterations <= 0 || (nodes - from).colwise().norm().maxCoeff() < near_bones) break;
  }
  return sum;
}

class TissueMethod final : public DeformationMethod {
 public:
  TissueMethod(const Scene& scene, std::vector<DistanceField> fields)
      : fields_(std::move(fields)), body_count_(scene.bodies.size()), muscles_(scene.muscles.size()) {
    std::vector<SignedDistance> distances;
    for (const Bone& bone : scene.bones) distances.emplace_back(bone.surface);
    parallel_for_each(muscles_.size(), [&](std::size_t m) {
      muscles_[m] = prepare_tissue(scene, scene.muscles[m], fields_, distances);
    });
    metrics_.resize(muscles_.size());
    reset();
  }

  void reset() override {
    nodes_.clear();
    for (const PreparedTissue& muscle : muscles_) nodes_.push_back(muscle.lattice.nodes);
    bodies_.assign(body_count_, RigidTransform::Identity());
    equilibria_.clear();
    for (const PreparedTissue& muscle : muscles_) equilibria_.push_back(at_rest(muscle));
    frame_ = 0;
  }

  StepReport advance(const Pose& pose, Real) override {
    StepReport report;
    report.muscles.resize(muscles_.size());
    std::vector<Points> next = nodes_;
    std::vector<Equilibrium> found(muscles_.size());
    parallel_for_each(muscles_.size(), [&](std::size_t m) {
      const auto started = std::chrono::steady_clock::now();
      report.muscles[m] = step(m, pose, next[m], found[m]);
      const std::chrono::duration<Real, std::milli> taken = std::chrono::steady_clock::now() - started;
      report.muscles[m].milliseconds = taken.count();
    });
    nodes_ = std::move(next);
    equilibria_ = std::move(found);
    bodies_ = pose.bodies;
    ++frame_;
    return report;
  }

  void write(Frame& frame) const override {
    frame.muscles.clear();
    for (std::size_t m = 0; m < muscles_.size(); ++m) frame.muscles.push_back({surface_at(muscles_[m], nodes_[m])});
  }

  std::vector<MuscleForces> muscle_forces(const std::vector<std::vector<Twist>>& coordinates) const override {
    std::vector<MuscleForces> forces(muscles_.size());
    parallel_for_each(muscles_.size(), [&](std::size_t m) {
      const Equilibrium& found = equilibria_[m];
      forces[m] = tissue::muscle_forces(muscles_[m], found.around, found.laws, nodes_[m], coordinates);
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
      found = FactoredMatrix(scalar_stiffness(muscles_[m], cell_laws(muscles_[m], Real(level) / activation_steps, 1)));
    return found;
  }

  /// What the nodes of a muscle are in equilibrium with.
  struct Equilibrium {
    std::vector<CellLaw> laws;
    Surroundings around;
  };

  /// At the capture pose nothing pulls.
  Equilibrium at_rest(const PreparedTissue& muscle) const {
    Equilibrium found{cell_laws(muscle, 0, 0), {}};
    found.around = surroundings(muscle, bodies_, found.laws);
    return found;
  }

  MuscleReport step(std::size_t m, const Pose& pose, Points& nodes, Equilibrium& found) {
    const PreparedTissue& muscle = muscles_[m];
    const auto check = [&](bool is_finite) {
      if (!is_finite) throw QualityError("muscle " + muscle.name + ": a vertex position is not finite; check the pose");
    };
    for (const RigidTransform& body : pose.bodies) check(body.matrix().allFinite());
    const Real activation = m < pose.activations.size() ? pose.activations[m] : 0;
    const Real tension = std::min(1.0, Real(frame_ + 1) / muscle.settings.tension_frames);
    const FactoredMatrix& by_metric = metric(m, activation);
    found.laws = cell_laws(muscle, activation, tension);
    int iterations = 0;
    Minimized done;
    Real pull = 0;
    std::vector<RigidTransform> before = bodies_;
    for (const std::vector<RigidTransform>& now : steps_between(muscle, bodies_, pose.bodies)) {
      carry(muscle, before, now, nodes);
      found.around = surroundings(muscle, now, found.laws);
      done = settle(muscle, found.around, by_metric, nodes);
      iterations += done.iterations;
      pull = attachment_wrench(muscle, found.around, nodes, AttachmentEnd::insertion).force.norm();
      before = now;
    }
    check(nodes.allFinite());
    return {0,
            {{"minimizer_iterations", static_cast<Real>(iterations)},
             {"residual_n", done.residual},
             {"pull_n", pull},
             {"least_volume_ratio", least_volume_ratio(muscle.lattice, nodes)}}};
  }

  std::vector<DistanceField> fields_;  ///< of all bones, which the muscles look at
  std::size_t body_count_;
  std::vector<PreparedTissue> muscles_;
  std::vector<std::map<int, FactoredMatrix>> metrics_;  ///< by muscle and activation, made when first asked for
  std::vector<Points> nodes_;
  std::vector<Equilibrium> equilibria_;
  std::vector<RigidTransform> bodies_;
  int frame_ = 0;
};

}  // namespace

std::unique_ptr<DeformationMethod> make_tissue_method(const Scene& scene, std::vector<DistanceField> fields) {
  return std::make_unique<TissueMethod>(scene, std::move(fields));
}

MethodEntry tissue_entry() {
  return {.name = "tissue",
          .meaning = "their inside as tissue under tension, at rest in every frame",
          .settings = describe_settings<TissueSettings>(),
          .metrics = {{"minimizer_iterations"}, {"residual_n", 6}, {"pull_n", 3}, {"least_volume_ratio", 3}},
          .make = [](const Scene& scene, const BoneFieldSource& fields) {
            return make_tissue_method(scene, fields(scene.distance_fields));
          }};
}

}  // namespace gracilis
