#pragma once

#include <gracilis/geometry/gradient_fit.hpp>
#include <gracilis/strings/string_frames.hpp>

#include <memory>
#include <vector>

namespace gracilis::strings {

/// A surface bound to strings, constant during a run.
struct StringSkin {
  std::vector<Index> begin;    ///< per vertex: its first entry in the lists below; one more than there are vertices
  std::vector<Index> nodes;    ///< that a vertex follows ...
  std::vector<float> weights;  ///< ... and how much, sum 1 per vertex
  Points offsets;              ///< from the weighted mean of its nodes' fibers to the vertex, at rest, m
  Points directions;           ///< of the fibers about each vertex at rest, unit
  Eigen::VectorXd widening;    ///< of each vertex per unit of widening: 1 half-way along the fibers, 0 at both ends
  std::vector<Index> attached_body;        ///< per vertex, or -1
  std::shared_ptr<const GradientFit> fit;  ///< smooths what the fibers say
  Real volume = 0;                         ///< m³, enclosed at rest
};

/// Binds each vertex to its 16 nearest fibers, at its place along them. `attached_body`: per vertex the body that it is
/// attached to, or -1.
StringSkin bind_skin(const MuscleStrings& muscle, const TriangleMesh& surface, const std::vector<Index>& attached_body);

/// Where strings put the vertices of a surface, and how they turn them.
struct SkinnedSurface {
  Points vertices;         ///< world, m
  Eigen::Matrix4Xd turns;  ///< unit quaternions (x, y, z, w), from the capture pose
};

/// The surface in the strings' state: attached vertices move with their bodies, all others with their fibers as
/// smoothly as these allow, and the muscle is widened or narrowed half-way between its ends until it has its volume at
/// rest. `faces` of the surface.
SkinnedSurface skinned_by_strings(const MuscleStrings& muscle, const StringSkin& skin, const Points& rest,
                                  const Eigen::Matrix3Xi& faces, const StringState& state);

}  // namespace gracilis::strings
