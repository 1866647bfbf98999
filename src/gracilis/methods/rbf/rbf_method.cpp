#include <gracilis/methods/rbf/rbf_method.hpp>

#include <gracilis/anatomy/attachments/body_carriers.hpp>
#include <gracilis/anatomy/overlap/bone_projection.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/screw.hpp>
#include <gracilis/methods/placed_method.hpp>
#include <gracilis/methods/rbf/muscle_model.hpp>
#include <gracilis/methods/rbf/surface_follow.hpp>
#include <gracilis/methods/shape_method.hpp>
#include <gracilis/methods/shared_rows.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

template <>
std::span<const Setting<RbfSettings>> setting_table() {
  using S = RbfSettings;
  static const Setting<S> table[] = {
      {"centers", &S::centers, "", 8, 5000,
       "How many radial basis functions describe a muscle; at most a tenth of its vertices are taken."},
      {"reach", &S::reach, "", 0.5, 4, "How far the Gaussians reach, in mean distances of centers."},
      {"weights", &S::weights, "", 0, 0,
       "Weights of the functions in other poses: 'refitted', so that points that moved along keep their distance to "
       "the surface, or 'kept' as in the capture pose, as published."},
      {"descent_steps", &S::descent_steps, "", 0, 1000,
       "Steps down the gradient of the curvature's cost per frame, at most; 0 leaves centers where they are carried."},
      {"reference", &S::reference, "", 0, 0,
       "Which curvature is kept: 'carried' along with the bodies from the capture pose, or that which the capture pose "
       "has in the same place of 'space', as published."},
      {"volume", &S::volume, "", 0, 0,
       "How the volume is kept: 'offset' moves the level of the field that is the surface, or 'none'."},
      {"bones", &S::bones, "", 0, 0, "Whether centers and vertices are kept out of bones."},
      tendon_length_row<S>(),
      bone_margin_row<S>(),
      bone_rest_gap_row<S>(),
  };
  return table;
}

namespace {

/// What stays the same of one muscle.
struct RbfMuscle {
  RbfSettings settings;
  BodyCarriers carriers;
  rbf::MuscleModel model;
  rbf::FollowedSurface surface;
  BoneProjection center_bones, bones;
};

/// The centers as if they were vertices of a muscle, for the distances that they keep from bones.
Muscle muscle_of(const Points& centers) {
  Muscle muscle;
  muscle.surface.vertices = centers;
  return muscle;
}

/// The muscle's model; where its functions cannot be told apart, an error that names the muscle and the setting.
rbf::MuscleModel model_of(const Muscle& muscle, const MeshTopology& topology, const BodyCarriers& carriers,
                          const RbfSettings& settings) {
  const Index centers = std::max(8, std::min(settings.centers, muscle.surface.vertex_count() / 10));
  try {
    return rbf::muscle_model(muscle, topology, carriers, centers, settings.reach);
  } catch (const InputError& error) {
    Problem problem = error.problems().front();
    problem.where = "muscle '" + muscle.name + "'";
    problem.remedy = "give 'reach' a smaller value";
    throw InputError(problem);
  }
}

RbfMuscle prepare_rbf(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields) {
  const RbfSettings settings = muscle_settings<RbfSettings>(scene, muscle);
  const MeshTopology topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  BodyCarriers carriers = body_carriers(muscle, topology, settings.tendon_length);
  rbf::MuscleModel model = model_of(muscle, topology, carriers, settings);
  std::vector<Index> center_bodies;
  for (const Index v : model.center_vertex) center_bodies.push_back(carriers.fixed_body[static_cast<std::size_t>(v)]);
  BoneProjection center_bones(scene, muscle_of(model.rest.centers), center_bodies, fields,
                              settings.bone_margin + model.depth, true);
  BoneProjection bones(scene, muscle, carriers.fixed_body, fields, settings.bone_margin, settings.bone_rest_gap);
  rbf::FollowedSurface surface = rbf::followed_surface(muscle.surface, topology, carriers);
  return {settings,           std::move(carriers),     std::move(model),
          std::move(surface), std::move(center_bones), std::move(bones)};
}

Points moved(const std::vector<RigidTransform>& motions, const std::vector<Index>& by, const Points& points) {
  Points result(3, points.cols());
  for (Index i = 0; i < static_cast<Index>(points.cols()); ++i)
    result.col(i) = motions[static_cast<std::size_t>(by[static_cast<std::size_t>(i)])] * Vec3(points.col(i));
  return result;
}

/// The poses on the way from the capture pose, as the muscle's first body sees them, to this one: each turns no body by
/// more than 10 degrees, so that nothing passes through a bone unseen. The last is `now`.
std::vector<Pose> way_to(const Pose& now, Index first_body) {
  constexpr Real most_turn = radians(10);
  constexpr int most_steps = 18;
  const RigidTransform& first = now.bodies[static_cast<std::size_t>(first_body)];
  Real turn = 0;
  for (const RigidTransform& body : now.bodies)
    turn = std::max(turn, std::abs(Eigen::AngleAxisd((first.inverse() * body).linear()).angle()));
  const int steps = std::isfinite(turn) ? std::clamp(static_cast<int>(std::ceil(turn / most_turn)), 1, most_steps) : 1;
  std::vector<Pose> way;
  for (int i = 1; i < steps; ++i) {
    way.push_back(now);
    for (RigidTransform& body : way.back().bodies)
      body = first * share_of_screw(first.inverse() * body, static_cast<Real>(i) / steps);
  }
  way.push_back(now);
  return way;
}

/// Where the centers are carried to and kept out of bones on the way. Precondition: the muscle has a body.
Points centers_around_bones(const RbfMuscle& muscle, const Pose& now) {
  const rbf::MuscleModel& model = muscle.model;
  Points corrections = Points::Zero(3, model.rest.count()), centers;
  std::vector<RigidTransform> before;
  for (const Pose& pose : way_to(now, muscle.carriers.bodies.front())) {
    std::vector<RigidTransform> motions = carried_motions(muscle.carriers, pose, model.center_vertex);
    Points carried(3, model.rest.count());
    for (Index k = 0; k < model.rest.count(); ++k) {
      const auto at = static_cast<std::size_t>(k);
      carried.col(k) = motions[at] * Vec3(model.rest.centers.col(k));
      if (!before.empty())
        corrections.col(k) = motions[at].linear() * before[at].linear().transpose() * Vec3(corrections.col(k));
    }
    centers = carried + corrections;
    muscle.center_bones.push_out(pose, centers);
    corrections = centers - carried;
    before = std::move(motions);
  }
  return centers;
}

ShapeStep step(const RbfMuscle& muscle, const Pose& now) {
  const rbf::MuscleModel& model = muscle.model;
  const std::vector<RigidTransform> motions = carried_motions(muscle.carriers, now);
  RadialBasis basis = model.rest;
  basis.centers = moved(motions, model.center_vertex, model.rest.centers);
  const Points carried = basis.centers;
  if (muscle.settings.bones && !muscle.carriers.bodies.empty()) basis.centers = centers_around_bones(muscle, now);
  rbf::CurvaturePoints wanted = model.curvature;
  if (muscle.settings.reference == RbfReference::carried)
    wanted.points = moved(motions, model.point_vertex, model.curvature.points);
  const rbf::Descent done =
      rbf::descend(basis, wanted, model.is_free, muscle.settings.descent_steps, model.spacing / 10);
  Index contacts = 0;
  if (muscle.settings.bones) contacts += muscle.center_bones.push_out(now, basis.centers);
  const Points corrections = basis.centers - carried;
  if (muscle.settings.weights == RbfWeights::refitted) {
    Points along = moved(motions, model.fit_vertex, model.fit_points);
    for (Index i = 0; i < static_cast<Index>(along.cols()); ++i)
      along.col(i) += rbf::correction_at(model, model.fit_vertex[static_cast<std::size_t>(i)], corrections);
    basis.weights = rbf::refitted_weights(model, basis, along);
  }
  rbf::FollowRequests requests;
  requests.keeps_volume = muscle.settings.volume == RbfVolume::offset;
  if (muscle.settings.bones) requests.push_out = [&](Points& points) { return muscle.bones.push_out(now, points); };
  rbf::Followed followed = rbf::follow(muscle.surface, model, motions, corrections, basis, requests);
  return {std::move(followed.points),
          {{"contacts", static_cast<Real>(contacts + followed.contacts)},
           {"descent_steps", static_cast<Real>(done.steps)},
           {"cost", done.after},
           {"offset_mm", 1000 * followed.offset}}};
}

ShapedMuscle shaped_by_rbf(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields) {
  const auto prepared = std::make_shared<const RbfMuscle>(prepare_rbf(scene, muscle, fields));
  return {muscle.name, muscle.surface.vertices,
          [prepared](const Pose&, const Pose& now, const Points&) { return step(*prepared, now); }};
}

Preset rbf_2024() {
  Preset preset;
  preset.name = "rbf-2024";
  preset.meaning = "radial basis functions as published, with what this project added switched off";
  preset.method.name = "rbf";
  RbfSettings published;
  published.reference = RbfReference::space;
  published.weights = RbfWeights::kept;
  published.volume = RbfVolume::none;
  published.bones = false;
  preset.method.settings = changed_values(published);
  return preset;
}

}  // namespace

std::unique_ptr<DeformationMethod> make_rbf_method(const Scene& scene, std::vector<DistanceField> fields) {
  return made_near_origin(scene, std::move(fields), [](const Scene& near, std::vector<DistanceField> near_fields) {
    return shape_method(near, std::move(near_fields), shaped_by_rbf);
  });
}

MethodEntry rbf_entry() {
  return {.name = "rbf",
          .meaning = "implicit surfaces of radial basis functions that keep their curvature",
          .settings = describe_settings<RbfSettings>(),
          .presets = {rbf_2024()},
          .metrics = {{"contacts", 0}, {"descent_steps", 0}, {"cost", 9}, {"offset_mm", 3}},
          .make = [](const Scene& scene, const BoneFieldSource& fields) {
            return make_rbf_method(scene, fields(scene.distance_fields));
          }};
}

}  // namespace gracilis
