#pragma once

#include <gracilis/dynamics/contact_surface.hpp>

#include <vector>

namespace gracilis {

/// A surface in patches of a few faces, and a tree over them that knows where they are and which way they face. It
/// tells which parts of a surface may meet each other: those that are near and do not all face the same way (after
/// Volino and Magnenat-Thalmann 1994, with boxes of normals instead of cones).
struct PatchTree {
  struct Node {
    Index begin = 0, end = 0;  ///< in `faces`
    Index skip = 0;            ///< the first node that is not below this one; nodes stand in depth-first order
    bool is_patch = false;     ///< nothing is below it
  };
  /// Boxes around places (m) and unit normals.
  struct Bounds {
    Eigen::AlignedBox3f places, normals;
  };

  std::vector<Index> faces;
  std::vector<Node> nodes;
  std::vector<Index> patches;                      ///< the nodes that are patches
  std::vector<Index> particle_offsets, particles;  ///< of each patch; every particle with a face is in one
  std::vector<Bounds> bounds;                      ///< per node, of its faces; changes with the surface
};

/// The tree of a surface whose particles are at the columns of `rest`, by halving along the longest axis. Bounds are
/// not set yet.
PatchTree build_patch_tree(const ContactSurface& surface, const Eigen::Matrix3Xf& rest);

/// Bounds of all nodes for where the particles are now; `areas` are the faces' area vectors.
void refit(const ContactSurface& surface, const Particles& particles, const Eigen::Matrix3Xf& areas, PatchTree& tree);

/// Bounds of the particles of patch number `patch`; each faces along its column of `outward`, of any length.
PatchTree::Bounds bounds_of_particles(const PatchTree& tree, Index patch, const Particles& particles,
                                      const Eigen::Matrix3Xf& outward);

/// Whether something in one may be within `reach` (m) of something in the other and face against it.
bool may_meet(const PatchTree::Bounds& one, const PatchTree::Bounds& other, float reach);

/// Appends the faces of all patches that may meet what is within `bounds`.
void gather_faces(const PatchTree& tree, const PatchTree::Bounds& bounds, float reach, std::vector<Index>& faces);

}  // namespace gracilis
