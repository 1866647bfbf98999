#include <gracilis/methods/mass_spring/muscle_model.hpp>

#include <gracilis/anatomy/fibers/muscle_fibers.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/nearest_points.hpp>
#include <gracilis/methods/mass_spring/particles.hpp>
#include <gracilis/methods/mass_spring/relaxation.hpp>
#include <gracilis/methods/method_entry.hpp>

#include <algorithm>

namespace gracilis::mass_spring {

namespace {

Polylines fibers_for_particles(Muscle muscle, int count) {
  muscle.fibers.count = count;
  return attached_fibers_of(muscle);
}

SpringPairs pairs_of(const Muscle& muscle, const Polylines& particles, const MassSpringSettings& settings) {
  try {
    return particles.count() > 0 ? spring_pairs(particles, settings.layout, settings.neighbors) : SpringPairs{};
  } catch (const InputError& error) {
    Problem problem = error.problems().front();
    problem.where = "muscle '" + muscle.name + "'";
    problem.remedy = "choose another 'layout'";
    throw InputError(problem);
  }
}

/// The particles nearest to each vertex, one column per vertex.
Eigen::MatrixXi nearest_particles(const Points& vertices, const Points& particles, Index count) {
  const auto rows = std::min(count, static_cast<Index>(particles.cols()));
  Eigen::MatrixXi bound(rows, vertices.cols());
  if (rows == 0) return bound;
  const NearestPoints nearest(particles);
  for (Index v = 0; v < static_cast<Index>(vertices.cols()); ++v) {
    const std::vector<Index> found = nearest.query(vertices.col(v), static_cast<std::size_t>(rows));
    for (Index i = 0; i < rows; ++i) bound(i, v) = found[static_cast<std::size_t>(i)];
  }
  return bound;
}

/// What moves every particle along: its body where it is fixed, else as the settings ask.
void choose_carriers(const Scene& scene, const Muscle& muscle, MuscleModel& model) {
  const Points& particles = model.particles.points;
  const MassSpringSettings& settings = model.settings;
  const bool asks_bones =
      settings.carry_particles == MassSpringCarry::nearest_bone || settings.fixed_near == FixedNear::bones;
  const std::vector<NearestBone> bones = asks_bones
                                             ? nearest_bones(scene, particles)
                                             : std::vector<NearestBone>(static_cast<std::size_t>(particles.cols()));
  model.carrier_body = fixed_bodies(muscle, particles, bones, settings.fixed_near, settings.fixed_distance);
  for (const Index body : model.carrier_body) model.fixed.push_back(body >= 0);
  const NearestPoints vertices(model.rest);
  for (Index p = 0; p < static_cast<Index>(particles.cols()); ++p) {
    const auto at = static_cast<std::size_t>(p);
    model.carrier_vertex.push_back(vertices.nearest(particles.col(p)));
    if (!model.fixed[at] && settings.carry_particles == MassSpringCarry::nearest_bone)
      model.carrier_body[at] = bones[at].body;
  }
}

}  // namespace

MuscleModel muscle_model(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields) {
  MuscleModel model;
  const MassSpringSettings& settings = model.settings = muscle_settings<MassSpringSettings>(scene, muscle);
  model.rest = muscle.surface.vertices;
  model.topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  model.carriers = body_carriers(muscle, model.topology, settings.tendon_length);
  model.particles =
      particles_along(fibers_for_particles(muscle, settings.fiber_count), settings.particles_per_fiber, settings.seed);
  model.radii = muscle_radii(model.particles.points, on_boundary_fibers(model.particles, model.rest), model.rest);
  choose_carriers(scene, muscle, model);
  model.net = build_spring_net(model.particles.points, pairs_of(muscle, model.particles, settings),
                               settings.spring_material, settings.shortest_spring);
  model.damping = damping_of(settings, model.net);
  model.bound = nearest_particles(model.rest, model.particles.points, settings.surface_particles);
  if (settings.bone_collision != MassSpringBones::fields) return model;
  std::vector<Index> fixed_body;
  for (std::size_t p = 0; p < model.fixed.size(); ++p)
    fixed_body.push_back(model.fixed[p] ? model.carrier_body[p] : -1);
  model.particle_bones =
      BoneProjection(scene, model.particles.points, fixed_body, fields, model.radii, settings.bone_rest_gap);
  model.vertex_bones =
      BoneProjection(scene, muscle, model.carriers.fixed_body, fields, settings.bone_margin, settings.bone_rest_gap);
  return model;
}

Index boundary_particles(const MuscleModel& model) {
  return static_cast<Index>(
      std::count_if(model.radii.begin(), model.radii.end(), [](Real radius) { return radius > 0; }));
}

MuscleSpheres muscle_spheres(const MuscleModel& model) {
  MuscleSpheres spheres;
  for (Index p = 0; p < static_cast<Index>(model.radii.size()); ++p) {
    const auto at = static_cast<std::size_t>(p);
    if (!(model.radii[at] > 0)) continue;
    spheres.particles.push_back(p);
    spheres.rest.radii.push_back(model.radii[at]);
    spheres.fixed.push_back(model.fixed[at]);
  }
  spheres.rest.centers.resize(3, spheres.rest.count());
  for (std::size_t s = 0; s < spheres.particles.size(); ++s)
    spheres.rest.centers.col(static_cast<Index>(s)) = model.particles.points.col(spheres.particles[s]);
  spheres.meets_bones = model.settings.bone_collision == MassSpringBones::spheres;
  spheres.keeps_rest_gap = model.settings.bone_rest_gap;
  return spheres;
}

std::vector<RigidTransform> particle_motions(const MuscleModel& model, const Pose& pose) {
  std::vector<RigidTransform> motions = carried_motions(model.carriers, pose, model.carrier_vertex);
  for (std::size_t p = 0; p < motions.size(); ++p)
    if (const Index body = model.carrier_body[p]; body >= 0) motions[p] = pose.bodies[static_cast<std::size_t>(body)];
  return motions;
}

Points carried_particles(const MuscleModel& model, const std::vector<RigidTransform>& motions) {
  return moved_by(motions, model.particles.points);
}

namespace {

/// Each vertex's value becomes half its own and half the mean of its neighbors', so many times; held ones stay.
void smooth(const VertexStars& stars, const std::vector<char>& held, int rounds, Points& values) {
  Points before;
  for (int r = 0; r < rounds; ++r) {
    before = values;
    parallel_for(static_cast<Index>(values.cols()), 1024, [&](Index begin, Index end) {
      for (Index v = begin; v < end; ++v) {
        const auto at = static_cast<std::size_t>(v);
        const Index count = stars.offsets[at + 1] - stars.offsets[at];
        if (held[at] || count == 0) continue;
        Vec3 sum = Vec3::Zero();
        for (Index i = stars.offsets[at]; i < stars.offsets[at + 1]; ++i)
          sum += before.col(stars.neighbors[static_cast<std::size_t>(i)]);
        values.col(v) = (before.col(v) + sum / count) / 2;
      }
    });
  }
}

}  // namespace

Points surface_of(const MuscleModel& model, const Pose& pose, const std::vector<RigidTransform>& motions,
                  const Points& particles) {
  const std::vector<RigidTransform> blended = carried_motions(model.carriers, pose);
  const std::vector<char> held = model.settings.hold_attachments
                                     ? held_vertices(model.carriers)
                                     : std::vector<char>(model.carriers.fixed_body.size(), 0);
  const auto followed = static_cast<Index>(model.bound.rows());
  const Points moved = particles - carried_particles(model, motions);
  Points carried(3, model.rest.cols()), added = Points::Zero(3, model.rest.cols());
  parallel_for(static_cast<Index>(model.rest.cols()), 512, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v) {
      const Vec3 rest = model.rest.col(v);
      carried.col(v) = blended[static_cast<std::size_t>(v)] * rest;
      if (followed == 0 || held[static_cast<std::size_t>(v)]) continue;
      Vec3 sum = Vec3::Zero();
      for (Index i = 0; i < followed; ++i) {
        const Index p = model.bound(i, v);
        sum += motions[static_cast<std::size_t>(p)] * rest + moved.col(p);
      }
      added.col(v) = sum / followed - carried.col(v);
    }
  });
  smooth(model.topology.stars, held, model.settings.surface_smoothing, added);
  return carried + added;
}

}  // namespace gracilis::mass_spring
