#include <gracilis/methods/tissue/tissue_method.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/methods/tissue/carry.hpp>
#include <gracilis/methods/tissue/ends_on_muscles.hpp>
#include <gracilis/methods/tissue/factored_matrix.hpp>
#include <gracilis/methods/tissue/forces.hpp>
#include <gracilis/methods/tissue/neighbors.hpp>
#include <gracilis/methods/tissue/seen_surface.hpp>
#include <gracilis/methods/tissue/settle.hpp>
#include <gracilis/methods/tissue/settle_joined.hpp>
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
/// How far muscles are thought to move before they look at each other again, over how far they did in the last step.
constexpr Real moves_expected = 2;

class TissueMethod final : public DeformationMethod {
 public:
  TissueMethod(const Scene& scene, std::vector<DistanceField> fields)
      : fields_(std::move(fields)),
        body_count_(scene.bodies.size()),
        groups_(hosts_first(scene)),
        muscles_(scene.muscles.size()) {
    for (const Bone& bone : scene.bones) distances_.emplace_back(bone.surface);
    parallel_for_each(muscles_.size(), [&](std::size_t m) {
      muscles_[m] = prepare_tissue(scene, scene.muscles[m], fields_, distances_);
    });
    ends_ = ends_on_muscles(scene, muscles_);
    prepare_joints(ends_, muscles_);
    groups_joined_ = joined_groups(ends_, muscles_.size());
    is_joined_.assign(muscles_.size(), 0);
    for (const std::vector<std::size_t>& group : groups_joined_)
      for (const std::size_t m : group) is_joined_[m] = 1;
    metrics_.resize(muscles_.size());
    std::vector<MeetingSettings> meetings;
    bool any_self = false;
    for (const PreparedTissue& muscle : muscles_) {
      rounds_ = std::max(rounds_, muscle.settings.contact_rounds);
      meetings.push_back({muscle.settings.neighbor_gap, muscle.settings.self_contact});
      any_self = any_self || muscle.settings.self_contact;
    }
    if (rounds_ > 0 && (muscles_.size() > 1 || any_self)) neighbors_ = prepare_neighbors(scene, meetings);
    if (neighbors_.none()) rounds_ = 1;
    reset();
  }

  void reset() override {
    nodes_.clear();
    for (const PreparedTissue& muscle : muscles_) nodes_.push_back(muscle.lattice.nodes);
    bodies_.assign(body_count_, RigidTransform::Identity());
    expected_move_ = neighbor_reach;
    equilibria_.clear();
    seen_.clear();
    for (std::size_t m = 0; m < muscles_.size(); ++m) {
      equilibria_.push_back(at_rest(m));
      seen_.push_back(surface_at(muscles_[m], nodes_[m]));
    }
    frame_ = 0;
  }

  StepReport advance(const Pose& asked, Real) override {
    Pose pose = asked;
    std::vector<MovingMuscle> moving(muscles_.size());
    for_each_timed(moving, [&](std::size_t m) { moving[m] = begun(m, pose); });
    int count = 1;
    for (const PreparedTissue& muscle : muscles_) count = std::max(count, steps_needed(muscle, bodies_, pose.bodies));
    for (int step = 1; step <= count; ++step) {
      for (const std::vector<std::size_t>& group : groups_) {
        parallel_for_each(group.size(), [&](std::size_t i) {
          timed(moving[group[i]], [&] { carry_on(group[i], pose, step, count, moving[group[i]]); });
        });
        carry_ends(group, moving, pose);
      }
      settle_in_rounds(moving);
    }
    for_each_timed(moving, [&](std::size_t m) {
      moving[m].seen = seen_surface(muscles_[m], moving[m].equilibrium.around, distances_, moving[m].nodes);
      check(m, moving[m].seen.allFinite());
    });
    StepReport report;
    for (std::size_t m = 0; m < muscles_.size(); ++m) report.muscles.push_back(reported(m, moving[m]));
    for (std::size_t m = 0; m < muscles_.size(); ++m) {
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
    for (std::size_t m = 0; m < muscles_.size(); ++m)
      frame.muscles.push_back(
          {.points = seen_[m], .fiber_stresses = vertex_fiber_stresses(muscles_[m], equilibria_[m].laws, nodes_[m])});
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
  Equilibrium at_rest(std::size_t m) const {
    Equilibrium found{cell_laws(muscles_[m], 0, 0), {}};
    found.around = surroundings(muscles_[m], bodies_, found.laws);
    found.around.others = others_of(m);
    return found;
  }

  /// A muscle on its way to a pose.
  struct MovingMuscle {
    Points nodes;
    Points seen;  ///< its surface in the end
    Equilibrium equilibrium;
    std::vector<RigidTransform> bodies;  ///< where they were in the last step
    const FactoredMatrix* metric = nullptr;
    Minimized done;
    int iterations = 0;
    Real milliseconds = 0;
  };

  template <class Act>
  static void timed(MovingMuscle& moving, const Act& act) {
    const Real before = moving.milliseconds;
    const auto started = std::chrono::steady_clock::now();
    act();
    const std::chrono::duration<Real, std::milli> taken = std::chrono::steady_clock::now() - started;
    moving.milliseconds = before + taken.count();
  }

  template <class Act>
  static void for_each_timed(std::vector<MovingMuscle>& moving, const Act& act) {
    parallel_for_each(moving.size(), [&](std::size_t m) { timed(moving[m], [&] { act(m); }); });
  }

  /// Puts what these muscles carry where they are now.
  void carry_ends(const std::vector<std::size_t>& muscles, const std::vector<MovingMuscle>& moving, Pose& pose) const {
    for (const EndOnMuscle& end : ends_) {
      if (std::find(muscles.begin(), muscles.end(), end.host) == muscles.end()) continue;
      pose.bodies[static_cast<std::size_t>(end.body.body)] =
          motion_of(end.body, surface_at(muscles_[end.host], moving[end.host].nodes));
    }
  }

  void check(std::size_t m, bool is_finite) const {
    if (!is_finite)
      throw QualityError("muscle " + muscles_[m].name + ": a vertex position is not finite; check the pose");
  }

  MovingMuscle begun(std::size_t m, const Pose& pose) {
    for (const RigidTransform& body : pose.bodies) check(m, body.matrix().allFinite());
    const Real activation = m < pose.activations.size() ? pose.activations[m] : 0;
    const Real tension = std::min(1.0, Real(frame_ + 1) / muscles_[m].settings.tension_frames);
    MovingMuscle moving;
    moving.nodes = nodes_[m];
    moving.bodies = bodies_;
    moving.metric = &metric(m, activation);
    moving.equilibrium.laws = cell_laws(muscles_[m], activation, tension);
    // They hold at any instant, so nothing is lost where this pose fails.
    moving.equilibrium.around.queries = std::move(equilibria_[m].around.queries);
    return moving;
  }

  void carry_on(std::size_t m, const Pose& pose, int step, int count, MovingMuscle& moving) const {
    std::vector<RigidTransform> now = bodies_after(step, count, muscles_[m], bodies_, pose.bodies);
    for (const EndOnMuscle& end : ends_)
      if (end.guest == m) {
        const auto body = static_cast<std::size_t>(end.body.body);
        now[body] = pose.bodies[body];  // where the muscle below has come by this step
      }
    carry(muscles_[m], moving.bodies, now, moving.nodes);
    std::vector<CachedBoneQuery> queries = std::move(moving.equilibrium.around.queries);
    moving.equilibrium.around = surroundings(muscles_[m], now, moving.equilibrium.laws);
    moving.equilibrium.around.queries = std::move(queries);
    moving.equilibrium.around.others = others_of(m);
    moving.equilibrium.around.laws.least_volume_ratio =
        std::min(least_settled_ratio, least_volume_ratio(muscles_[m].lattice, moving.nodes) / 2);
    moving.bodies = now;
  }

  void look_at_neighbors(std::vector<MovingMuscle>& moving, const Look& look) {
    if (neighbors_.none()) return;
    // What is seen of them meets, and the tissue gives way by as much.
    std::vector<Points> seen(moving.size()), tissue(moving.size());
    parallel_for_each(moving.size(), [&](std::size_t m) {
      tissue[m] = surface_at(muscles_[m], moving[m].nodes);
      seen[m] = enclosing_surface(muscles_[m], moving[m].nodes, tissue[m]);
    });
    std::vector<std::vector<ContactPlane>> planes = contact_planes(neighbors_, seen, look);
    for (std::size_t m = 0; m < moving.size(); ++m) {
      for (ContactPlane& plane : planes[m])
        plane.least += plane.normal.dot(tissue[m].col(plane.point) - seen[m].col(plane.point));
      set_planes(muscles_[m], std::move(planes[m]), moving[m].equilibrium.around);
    }
  }

  int iterations_of(std::size_t m) const { return (muscles_[m].settings.minimizer_iterations + rounds_ - 1) / rounds_; }

  void settle_once(std::size_t m, MovingMuscle& moving) const {
    moving.done = settle(muscles_[m], moving.equilibrium.around, *moving.metric, iterations_of(m), moving.nodes);
    moving.iterations += moving.done.iterations;
    check(m, moving.nodes.allFinite());
  }

  /// The muscles of a group, whose time counts for the first of them.
  void settle_group(const std::vector<std::size_t>& group, std::vector<MovingMuscle>& moving) const {
    std::vector<JoinedTissue> joined;
    int iterations = 0;
    for (const std::size_t m : group) {
      joined.push_back({m, &muscles_[m], &moving[m].equilibrium.around, moving[m].metric, &moving[m].nodes});
      iterations = std::max(iterations, iterations_of(m));
    }
    Minimized done;
    timed(moving[group.front()], [&] { done = settle_joined(ends_, joined, iterations); });
    for (const std::size_t m : group) {
      moving[m].done = done;
      moving[m].iterations += done.iterations;
      check(m, moving[m].nodes.allFinite());
    }
  }

  void settle_all(std::vector<MovingMuscle>& moving) const {
    parallel_for_each(moving.size() + groups_joined_.size(), [&](std::size_t i) {
      if (i >= moving.size())
        settle_group(groups_joined_[i - moving.size()], moving);
      else if (!is_joined_[i])
        timed(moving[i], [&] { settle_once(i, moving[i]); });
    });
  }

  /// Folds move little between rounds, so muscles look at themselves once a step.
  void settle_in_rounds(std::vector<MovingMuscle>& moving) {
    Real furthest = 0;
    for (int round = 0; round < rounds_; ++round) {
      const SelfLook self = round == 0 ? SelfLook::anew : SelfLook::kept;
      furthest = std::max(furthest, settle_round(moving, {self, expected_move_}));
    }
    expected_move_ = std::min(neighbor_reach, moves_expected * furthest);
  }

  /// Again, and looking as far as ever, where a muscle moves further than was looked. Returns how far nodes moved, m.
  Real settle_round(std::vector<MovingMuscle>& moving, const Look& look) {
    std::vector<Points> before;
    for (const MovingMuscle& each : moving) before.push_back(each.nodes);
    const auto settled = [&](const Look& as) {
      look_at_neighbors(moving, as);
      settle_all(moving);
      Real squared = 0;
      for (std::size_t m = 0; m < moving.size(); ++m)
        squared = std::max(squared, (moving[m].nodes - before[m]).colwise().squaredNorm().maxCoeff());
      return std::sqrt(squared);
    };
    const Real moved = settled(look);
    if (neighbors_.none() || moved <= look.largest_move || look.largest_move == neighbor_reach) return moved;
    for (std::size_t m = 0; m < moving.size(); ++m) moving[m].nodes = before[m];
    return settled({look.self});
  }

  MuscleReport reported(std::size_t m, const MovingMuscle& moving) const {
    const Wrench pull =
        attachment_wrench(muscles_[m], moving.equilibrium.around, moving.nodes, AttachmentEnd::insertion);
    return {moving.milliseconds,
            {{"cells", static_cast<Real>(muscles_[m].lattice.cell_count())},
             {"minimizer_iterations", static_cast<Real>(moving.iterations)},
             {"residual_n", moving.done.residual},
             {"pull_n", pull.force.norm()},
             {"least_volume_ratio", least_volume_ratio(muscles_[m].lattice, moving.nodes)}}};
  }

  /// The muscles that one may touch, or that may lie on it.
  std::vector<Index> others_of(std::size_t m) const {
    std::vector<Index> others;
    for (std::size_t other = 0; other < muscles_.size(); ++other) {
      const bool pulls = std::any_of(ends_.begin(), ends_.end(),
                                     [&](const EndOnMuscle& end) { return end.host == m && end.guest == other; });
      if (other != m && (pulls || !neighbors_.pairs.empty())) others.push_back(static_cast<Index>(other));
    }
    return others;
  }

  std::vector<DistanceField> fields_;      ///< of all bones, which the muscles look at
  std::vector<SignedDistance> distances_;  ///< to the bones
  std::size_t body_count_;
  std::vector<std::vector<std::size_t>> groups_;  ///< of muscles, hosts first
  std::vector<EndOnMuscle> ends_;
  std::vector<std::vector<std::size_t>> groups_joined_;  ///< of muscles, by ends
  std::vector<char> is_joined_;                          ///< per muscle: whether it is in such a group
  std::vector<PreparedTissue> muscles_;
  Neighbors neighbors_;                                 ///< without pairs where muscles do not meet
  int rounds_ = 0;                                      ///< of looking at neighbors, in each step
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
