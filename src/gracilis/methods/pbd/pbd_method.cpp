#include <gracilis/methods/pbd/pbd_method.hpp>

#include <gracilis/anatomy/body_carriers.hpp>
#include <gracilis/anatomy/bone_projection.hpp>
#include <gracilis/anatomy/muscle_fibers.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/core/stop.hpp>
#include <gracilis/methods/pbd/settings.hpp>
#include <gracilis/methods/pbd/surface.hpp>
#include <gracilis/methods/placed_method.hpp>

#include <chrono>
#include <cmath>
#include <optional>

namespace gracilis {

namespace {

/// What stays the same of one muscle.
struct PbdMuscle {
  std::string name;
  PbdSettings settings;
  Points rest;  ///< world, in the capture pose, m
  BodyCarriers carriers;
  pbd::Surface surface;
  BoneProjection bones;
};

PbdMuscle prepare(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields) {
  const PbdSettings settings = with_values(with_values(PbdSettings{}, scene.method.settings), muscle.settings);
  const MeshTopology topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  BodyCarriers carriers = body_carriers(muscle, topology, settings.tendon_length);
  const Polylines fibers = settings.fiber_anisotropy ? fibers_of(muscle) : Polylines{};
  pbd::Surface surface = pbd::build_surface(muscle.surface, topology, carriers.fixed_body, fibers);
  BoneProjection bones(scene, muscle, carriers.fixed_body, fields, settings.bone_margin, settings.bone_rest_gap);
  return {muscle.name, settings, muscle.surface.vertices, std::move(carriers), std::move(surface), std::move(bones)};
}

/// The stiffness of one iteration of several, so that together they leave 1 - k of an error (Müller et al. 2007).
Real per_iteration(Real stiffness, int iterations) { return 1 - std::pow(1 - stiffness, 1.0 / iterations); }

/// Where vertices begin the frame.
Points begin_frame(const PbdMuscle& muscle, const Pose& last, const Pose& now, const Points& before) {
  if (muscle.settings.carry == PbdCarry::bodies) return carried_on(muscle.carriers, muscle.rest, last, now, before);
  Points points = before;
  for (Index v = 0; v < static_cast<Index>(points.cols()); ++v)
    if (const Index body = muscle.carriers.fixed_body[static_cast<std::size_t>(v)]; body >= 0)
      points.col(v) = now.bodies[static_cast<std::size_t>(body)] * Vec3(muscle.rest.col(v));
  return points;
}

struct PbdStep {
  Points points;
  Index contacts = 0, taken_along = 0, skipped_angles = 0;
};

PbdStep step(const PbdMuscle& muscle, const Pose& last, const Pose& now, const Points& before) {
  PbdStep result{begin_frame(muscle, last, now, before)};
  result.taken_along = muscle.bones.take_along(last, now, before, result.points);
  const int iterations = muscle.settings.iterations;
  const pbd::Stiffness stiffness = {per_iteration(muscle.settings.edge_stiffness, iterations),
                                    per_iteration(muscle.settings.angle_stiffness, iterations),
                                    per_iteration(muscle.settings.volume_stiffness, iterations),
                                    muscle.settings.hinge_limit};
  for (int i = 0; i < iterations; ++i) {
    throw_if_stopped();
    result.skipped_angles += pbd::project_edges_and_angles(muscle.surface, stiffness, result.points);
    pbd::project_volume(muscle.surface, stiffness.volume, result.points);
    result.contacts = muscle.bones.push_out(now, result.points);
  }
  return result;
}

class PbdMethod final : public DeformationMethod {
 public:
  PbdMethod(const Scene& scene, std::vector<DistanceField> fields)
      : fields_(std::move(fields)), body_count_(scene.bodies.size()) {
    std::vector<std::optional<PbdMuscle>> prepared(scene.muscles.size());
    parallel_for_each(prepared.size(), [&](std::size_t m) { prepared[m] = prepare(scene, scene.muscles[m], fields_); });
    for (std::optional<PbdMuscle>& muscle : prepared) muscles_.push_back(std::move(*muscle));
    reset();
  }

  void reset() override {
    shapes_.clear();
    for (const PbdMuscle& muscle : muscles_) shapes_.push_back(muscle.rest);
    pose_ = capture_pose(body_count_);
  }

  StepReport advance(const Pose& pose, Real) override {
    StepReport report;
    std::vector<Points> next;
    for (std::size_t m = 0; m < muscles_.size(); ++m) {
      const auto started = std::chrono::steady_clock::now();
      PbdStep done = step(muscles_[m], pose_, pose, shapes_[m]);
      const std::chrono::duration<Real, std::milli> taken = std::chrono::steady_clock::now() - started;
      report.muscles.push_back({taken.count(),
                                {{"contacts", static_cast<Real>(done.contacts)},
                                 {"taken_along", static_cast<Real>(done.taken_along)},
                                 {"skipped_angles", static_cast<Real>(done.skipped_angles)}}});
      if (!done.points.allFinite())
        throw QualityError("muscle " + muscles_[m].name +
                           ": a vertex position is not finite; check the pose, or give 'edge_stiffness' and "
                           "'angle_stiffness' smaller values");
      next.push_back(std::move(done.points));
    }
    shapes_ = std::move(next);
    pose_ = pose;
    return report;
  }

  void write(Frame& frame) const override {
    frame.muscles.clear();
    for (const Points& shape : shapes_) frame.muscles.push_back({shape});
  }

  void restore(const std::vector<Pose>& poses, const Frame&, const Frame& last) override {
    for (std::size_t m = 0; m < shapes_.size(); ++m) shapes_[m] = last.muscles[m].points;
    pose_ = poses.back();
  }

 private:
  std::vector<DistanceField> fields_;
  std::size_t body_count_;
  std::vector<PbdMuscle> muscles_;
  std::vector<Points> shapes_;
  Pose pose_;  ///< of the shapes
};

Preset pbd_2020() {
  Preset preset;
  preset.name = "pbd-2020";
  preset.meaning = "position based dynamics as published, with what this project added switched off";
  preset.method.name = "pbd";
  PbdSettings published;
  published.carry = PbdCarry::none;
  published.bone_margin = 0;
  published.bone_rest_gap = false;
  preset.method.settings = changed_values(published);
  return preset;
}

}  // namespace

std::unique_ptr<DeformationMethod> make_pbd_method(const Scene& scene, std::vector<DistanceField> fields) {
  return made_near_origin(scene, std::move(fields), [](const Scene& near, std::vector<DistanceField> near_fields) {
    return std::make_unique<PbdMethod>(near, std::move(near_fields));
  });
}

MethodEntry pbd_entry() {
  return {.name = "pbd",
          .meaning = "their surfaces, by position based dynamics (2020)",
          .settings = describe_settings<PbdSettings>(),
          .presets = {pbd_2020()},
          .metrics = {{"contacts", 0}, {"taken_along", 0}, {"skipped_angles", 0}},
          .make = [](const Scene& scene, const BoneFieldSource& fields) {
            return make_pbd_method(scene, fields(scene.distance_fields));
          }};
}

}  // namespace gracilis
