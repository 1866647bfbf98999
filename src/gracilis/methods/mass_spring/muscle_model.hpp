#pragma once

#include <gracilis/anatomy/attachments/body_carriers.hpp>
#include <gracilis/anatomy/overlap/bone_projection.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/methods/mass_spring/settings.hpp>
#include <gracilis/methods/mass_spring/sphere_collisions.hpp>
#include <gracilis/methods/mass_spring/spring_net.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis::mass_spring {

/// What stays the same of one muscle.
struct MuscleModel {
  MassSpringSettings settings;
  Points rest;  ///< of the surface, world, in the capture pose, m
  MeshTopology topology;
  BodyCarriers carriers;
  Polylines particles;              ///< in the capture pose; a line per fiber
  std::vector<Index> carrier_body;  ///< per particle: the body whose motion it takes on; -1: that of `carrier_vertex`
  std::vector<Index> carrier_vertex;
  std::vector<char> fixed;  ///< per particle
  SpringNet net;
  Real damping = 0;         ///< kg/s
  std::vector<Real> radii;  ///< m, per particle; 0: no sphere
  Eigen::MatrixXi bound;    ///< per vertex: the particles that it follows; none where there are none
  BoneProjection particle_bones, vertex_bones;
};

/// Throws InputError, naming the muscle, where its particles have no tetrahedra and these are asked for. A muscle
/// without origin and insertion has no fibers, and so no particles. `fields` (of all bones) must outlive the model.
MuscleModel muscle_model(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields);

/// The spheres of the particles that have a radius.
MuscleSpheres muscle_spheres(const MuscleModel& model);

/// How many particles have a sphere: those that take part in collisions.
Index boundary_particles(const MuscleModel& model);

/// How every particle is carried from the capture pose to this one, before springs move it.
std::vector<RigidTransform> particle_motions(const MuscleModel& model, const Pose& pose);

/// Where they are then, 3 × particles, m.
Points carried_particles(const MuscleModel& model, const std::vector<RigidTransform>& motions);

/// The surface that follows the particles (Janák 2012, section 4.4.4), 3 × vertices, m: each vertex goes to the mean of
/// where the motions of its nearest particles carry it, moved by the mean of what else moved these. Not published:
/// attached vertices go exactly with their bodies (`hold_attachments`), and what is added to the blend of the bodies'
/// motions is smoothed over the surface (`surface_smoothing`), so that nothing tears where other particles count.
Points surface_of(const MuscleModel& model, const Pose& pose, const std::vector<RigidTransform>& motions,
                  const Points& particles);

}  // namespace gracilis::mass_spring
