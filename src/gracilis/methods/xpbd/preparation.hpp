#pragma once

#include <gracilis/anatomy/overlap/bone_projection.hpp>
#include <gracilis/anatomy/sections/sheet.hpp>
#include <gracilis/dynamics/solver/surface_system.hpp>
#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/methods/arap_predictor.hpp>
#include <gracilis/methods/xpbd/settings.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/strings/string_skin.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace gracilis::xpbd {

/// Slivers and needles scale a stiffness by no more than this.
inline constexpr Real largest_shape = 1e3;
/// Share of its depth at rest in a bone or another muscle that a point gives back.
inline constexpr Real overlap_given_back = 0.05;

/// The strings that carry a muscle; none: the bodies that it is attached to do, by harmonic shares.
struct CarryingStrings {
  const strings::BoneDistances* bones = nullptr;  ///< must outlive the muscle
  std::shared_ptr<const strings::MuscleStrings> strings;
};

/// The surface that strings carry, and how it is bound to them.
struct StringSkinnedSurface {
  Points rest;
  Eigen::Matrix3Xi faces;
  strings::StringSkin skin;
};

/// A muscle prepared for the solver; constant during a run. Particles are renumbered breadth-first, so that neighbors
/// on the surface are neighbors in memory: `order[particle]` is the scene's vertex.
struct PreparedMuscle {
  std::string name;
  XpbdSettings settings;
  SurfaceSystem system;
  Vec3 origin = Vec3::Zero();  ///< world position of the particles' coordinate origin, m
  std::vector<Index> order;
  Points rest;                       ///< world, in particle order, m
  Eigen::Matrix3Xi faces;            ///< of particles
  std::vector<Index> fixed_body;     ///< per particle: the body it is attached to, or -1
  std::vector<Index> carriers;       ///< bodies with attachments on this muscle
  Eigen::MatrixXf skinning_weights;  ///< carriers × particles: harmonic shares of their motion, columns sum to 1
  CarryingStrings carrying;          ///< coarser copies share theirs with the whole surface
  std::shared_ptr<const StringSkinnedSurface>
      carried;                                     ///< where there are strings: its own, or that of which it is a copy
  std::vector<Index> skinned_vertex;               ///< per particle, on that surface; empty: each its own
  std::shared_ptr<const ArapPredictor> predicted;  ///< where the predictor asks for it
  BoneProjection predicted_bones;                  ///< that it keeps out of
  std::vector<LineSections> lines;  ///< where its surface is made of sections, whose frames carry it then
  std::vector<LineShare> shares;    ///< per particle, where there are lines
  std::vector<std::vector<RigidTransform>> to_sections;  ///< of each line: from world to its sections' frames, at rest
  std::vector<Real> belly;           ///< per particle, where there are lines: 0 in a tendon, 1 away from it
  bool keeps_out_of_itself = false;  ///< not where there is a line: its sections run through each other
  ContractionSettings contraction;
  bool is_driven = false;             ///< the scene says how active it is
  AlignedVector<float> along_fibers;  ///< per tension slot: squared cosine between it and the fibers
  std::vector<Index> contact_bodies;  ///< per contact set: the body of its bone

  Index particle_count() const { return static_cast<Index>(rest.cols()); }  ///< as many as the surface has vertices
};

/// Builds tables, masses, predictor shares and contact gaps of a muscle, and contractions where the scene's activation
/// plan drives it. `fields` has one distance field per bone of
/// the scene and must outlive the result. Precondition: the scene is valid.
PreparedMuscle prepare_muscle(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields,
                              const CarryingStrings& carrying = {});

/// Whether a muscle's settings ask for strings; not where it runs along a line or is attached to one body alone.
bool asks_for_strings(const Scene& scene, const Muscle& muscle);

/// How far a muscle's shape may depart from that at rest.
ShapeLimits shape_limits_of(const XpbdSettings& settings);

/// The strings that a muscle asks for; none where it has no fibers from an origin to an insertion. `bones` must outlive
/// the result.
CarryingStrings carrying_strings(const Scene& scene, const Muscle& muscle, const strings::BoneDistances& bones);

}  // namespace gracilis::xpbd
