#include <gracilis/methods/mass_spring/mass_spring_method.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/methods/mass_spring/muscle_model.hpp>
#include <gracilis/methods/placed_method.hpp>

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

namespace gracilis {

namespace {

using mass_spring::MuscleModel;
using mass_spring::RelaxedMuscle;

/// What is known of a muscle after a frame, beside its shape.
struct MuscleState {
  Points particles;                     ///< world, m
  std::vector<RigidTransform> motions;  ///< that carried them there from the capture pose
};

class MassSpringMethod final : public DeformationMethod {
 public:
  MassSpringMethod(const Scene& scene, std::vector<DistanceField> fields)
      : fields_(std::move(fields)),
        body_count_(scene.bodies.size()),
        shared_(with_values(MassSpringSettings{}, scene.method.settings)),
        models_(scene.muscles.size()) {
    parallel_for_each(models_.size(),
                      [&](std::size_t m) { models_[m] = mass_spring::muscle_model(scene, scene.muscles[m], fields_); });
    for (const Muscle& muscle : scene.muscles) {
      names_.push_back(muscle.name);
      wants_fibers_.push_back(muscle.fibers.count > 0);
    }
    for (const MuscleModel& model : models_) spheres_.push_back(muscle_spheres(model));
    if (std::any_of(spheres_.begin(), spheres_.end(), [](const auto& each) { return each.meets_bones; }))
      for (const Bone& bone : scene.bones) {
        bones_.push_back({mass_spring::bone_spheres(bone.surface, shared_.bone_sphere_rings)});
        bone_bodies_.push_back(bone.body);
      }
    reset();
  }

  void reset() override {
    const Pose pose = capture_pose(body_count_);
    shapes_.clear();
    states_.clear();
    for (const MuscleModel& model : models_) {
      shapes_.push_back(model.rest);
      states_.push_back({model.particles.points, mass_spring::particle_motions(model, pose)});
    }
  }

  StepReport advance(const Pose& pose, Real) override {
    const auto started = std::chrono::steady_clock::now();
    std::vector<RelaxedMuscle> muscles(models_.size());
    std::vector<MuscleState> next(models_.size());
    parallel_for_each(models_.size(), [&](std::size_t m) { begin_frame(m, pose, next[m], muscles[m]); });
    for (std::size_t m = 0; m < muscles.size(); ++m) require_finite(muscles[m].motion.now, m);
    std::vector<Index> collisions(models_.size(), 0);
    const mass_spring::Relaxation done = relax_all(pose, muscles, collisions);
    std::vector<Points> shapes(models_.size());
    parallel_for_each(models_.size(), [&](std::size_t m) {
      next[m].particles = std::move(muscles[m].motion.now);
      shapes[m] = mass_spring::surface_of(models_[m], pose, next[m].motions, next[m].particles);
      collisions[m] += models_[m].vertex_bones.push_out(pose, shapes[m]);
    });
    for (std::size_t m = 0; m < shapes.size(); ++m) {
      require_finite(next[m].particles, m);
      require_finite(shapes[m], m);
    }
    shapes_ = std::move(shapes);
    states_ = std::move(next);
    const std::chrono::duration<Real, std::milli> taken = std::chrono::steady_clock::now() - started;
    return report_of(taken.count(), done, muscles, collisions);
  }

  void write(Frame& frame) const override {
    frame.muscles.clear();
    for (std::size_t m = 0; m < shapes_.size(); ++m) {
      MuscleShape& shape = frame.muscles.emplace_back();
      shape.points = shapes_[m];
      // As published fibers run from particle to particle.
      if (wants_fibers_[m] && models_[m].particles.count() > 0)
        shape.fibers = {states_[m].particles, models_[m].particles.offsets};
    }
  }

  void restore(const std::vector<Pose>& poses, const Frame&, const Frame& last) override {
    reset();
    // Surfaces do not tell where particles are: the last frame is made again or, where frames go on from each other,
    // all.
    const std::size_t from = shared_.start_from == MassSpringStart::last ? 1 : poses.size() - 1;
    for (std::size_t i = std::max(from, std::size_t{1}); i < poses.size(); ++i) advance(poses[i], usual_time_step);
    for (std::size_t m = 0; m < shapes_.size(); ++m) shapes_[m] = last.muscles[m].points;
  }

  bool depends_on_clock() const override { return shared_.stop_milliseconds > 0; }

 private:
  void require_finite(const Points& points, std::size_t m) const {
    if (!points.allFinite())
      throw QualityError("muscle " + names_[m] +
                         ": a particle or vertex position is not finite; check the pose, or give " +
                         "'verlet_step' a smaller value");
  }

  /// Where the particles are before springs move them.
  void begin_frame(std::size_t m, const Pose& pose, MuscleState& next, RelaxedMuscle& muscle) const {
    const MuscleModel& model = models_[m];
    next.motions = mass_spring::particle_motions(model, pose);
    Points points = mass_spring::carried_particles(model, next.motions);
    if (shared_.start_from == MassSpringStart::last)
      for (std::size_t p = 0; p < next.motions.size(); ++p)
        if (!model.fixed[p]) {
          const auto at = static_cast<Index>(p);
          points.col(at) = next.motions[p] * (states_[m].motions[p].inverse() * Vec3(states_[m].particles.col(at)));
        }
    muscle.net = &model.net;
    muscle.fixed = &model.fixed;
    muscle.radii = &model.radii;
    muscle.mass = model.settings.particle_mass;
    muscle.damping = model.damping;
    muscle.motion = {points, points};
  }

  mass_spring::Relaxation relax_all(const Pose& pose, std::vector<RelaxedMuscle>& muscles,
                                    std::vector<Index>& collisions) const {
    mass_spring::RelaxationRule rule = mass_spring::relaxation_rule(shared_);
    if (shared_.limit_step)
      for (const MuscleModel& model : models_)
        rule.step = std::min(rule.step, mass_spring::stable_step(model.net, model.settings.particle_mass));
    std::vector<mass_spring::PlacedSpheres> bones = bones_;
    for (std::size_t b = 0; b < bones.size(); ++b)
      bones[b].motion = pose.bodies[static_cast<std::size_t>(bone_bodies_[b])];
    using mass_spring::TreeUpdate;
    mass_spring::SphereCollisions spheres(spheres_, bones, shared_.muscle_collision && models_.size() > 1,
                                          shared_.refit_only ? TreeUpdate::refit_only : TreeUpdate::rebuild);
    return mass_spring::relax(muscles, rule, [&] {
      collisions = spheres.resolve(muscles);
      parallel_for_each(muscles.size(),
                        [&](std::size_t m) { collisions[m] += push_out(models_[m], pose, muscles[m].motion); });
    });
  }

  /// Out of the bones' fields; what was pushed stops. Returns how many pushes that took.
  static Index push_out(const MuscleModel& model, const Pose& pose, mass_spring::Motion& motion) {
    if (model.settings.bone_collision != MassSpringBones::fields) return 0;
    const Points before = motion.now;
    const Index pushed = model.particle_bones.push_out(pose, motion.now);
    for (Index p = 0; pushed > 0 && p < static_cast<Index>(before.cols()); ++p)
      if (motion.now.col(p) != before.col(p)) motion.before.col(p) = motion.now.col(p);
    return pushed;
  }

  StepReport report_of(Real milliseconds, const mass_spring::Relaxation& done,
                       const std::vector<RelaxedMuscle>& muscles, const std::vector<Index>& collisions) const {
    StepReport report;
    // Muscles are moved together, so the time of each is its share of the vertices and particles.
    Real all = 0;
    const auto size = [&](std::size_t m) { return static_cast<Real>(shapes_[m].cols() + states_[m].particles.cols()); };
    for (std::size_t m = 0; m < shapes_.size(); ++m) all += size(m);
    for (std::size_t m = 0; m < shapes_.size(); ++m)
      report.muscles.push_back(
          {milliseconds * size(m) / all,
           {{"iterations", static_cast<Real>(done.iterations)},
            {"verlet_step_s", done.mean_step},
            {"contacts", static_cast<Real>(collisions[m])},
            {"displacement_mm", 1000 * muscles[m].displacement},
            {"length_changes_mm", 1000 * mass_spring::length_changes(models_[m].net, states_[m].particles)},
            {"particles", static_cast<Real>(models_[m].radii.size())},
            {"boundary_particles", static_cast<Real>(mass_spring::boundary_particles(models_[m]))}}});
    return report;
  }

  std::vector<DistanceField> fields_;
  std::size_t body_count_;
  MassSpringSettings shared_;
  std::vector<std::string> names_;
  std::vector<char> wants_fibers_;  ///< per muscle
  std::vector<MuscleModel> models_;
  std::vector<mass_spring::MuscleSpheres> spheres_;
  std::vector<mass_spring::PlacedSpheres> bones_;
  std::vector<Index> bone_bodies_;
  std::vector<Points> shapes_;
  std::vector<MuscleState> states_;
};

std::vector<Problem> problems_of(const Scene& scene) {
  const MassSpringSettings settings = with_values(MassSpringSettings{}, scene.method.settings);
  if (settings.smallest_step <= settings.verlet_step) return {};
  return {{"", "settings", "'smallest_step' is above 'verlet_step'", "steps are between the two"}};
}

bool asks_fields(const Scene& scene) {
  return std::any_of(scene.muscles.begin(), scene.muscles.end(), [&](const Muscle& muscle) {
    return muscle_settings<MassSpringSettings>(scene, muscle).bone_collision == MassSpringBones::fields;
  });
}

Preset janak_2012() {
  Preset preset;
  preset.name = "janak-2012";
  preset.meaning = "mass-spring systems as published, with what this project added switched off, but for bounds";
  preset.method.name = "mass-spring";
  // Without 'shortest_spring' and 'limit_step' particles that nearly coincide burst.
  MassSpringSettings published;
  published.particles_per_fiber = 40;
  published.damping_rule = DampingRule::fitted;
  published.fixed_near = FixedNear::bones;
  published.carry_particles = MassSpringCarry::nearest_bone;
  published.smallest_step = 0.04;
  published.bone_collision = MassSpringBones::spheres;
  published.surface_smoothing = 0;
  published.hold_attachments = false;
  published.bone_rest_gap = false;
  preset.method.settings = changed_values(published);
  return preset;
}

}  // namespace

std::unique_ptr<DeformationMethod> make_mass_spring_method(const Scene& scene, std::vector<DistanceField> fields) {
  return made_near_origin(scene, std::move(fields), [](const Scene& near, std::vector<DistanceField> near_fields) {
    return std::make_unique<MassSpringMethod>(near, std::move(near_fields));
  });
}

MethodEntry mass_spring_entry() {
  return {.name = "mass-spring",
          .meaning = "particles along their fibers, joined by springs (2012)",
          .settings = describe_settings<MassSpringSettings>(),
          .presets = {janak_2012()},
          .metrics = {{"iterations", 0},
                      {"verlet_step_s", 4},
                      {"contacts", 0},
                      {"displacement_mm", 6},
                      {"length_changes_mm", 3},
                      {"particles", 0},
                      {"boundary_particles", 0}},
          .validate = problems_of,
          .make =
              [](const Scene& scene, const BoneFieldSource& fields) {
                return make_mass_spring_method(
                    scene, asks_fields(scene) ? fields(scene.distance_fields) : std::vector<DistanceField>{});
              },
          .own_fibers = [](const Scene& scene, const Muscle& muscle) -> OwnFibers {
            const auto settings = muscle_settings<MassSpringSettings>(scene, muscle);
            return {settings.fiber_count, settings.particles_per_fiber};
          }};
}

}  // namespace gracilis
