#pragma once

#include <gracilis/dynamics/contact/mesh/contact_surface.hpp>
#include <gracilis/dynamics/contact/mesh/triangle_pack.hpp>

#include <limits>
#include <span>
#include <vector>

namespace gracilis {

/// A surface in patches of a few faces, and a tree over them that knows where they are and which way they face. It
/// tells which parts of a surface may meet each other: those that are near and do not all face the same way (after
/// Volino and Magnenat-Thalmann 1994, with boxes of normals instead of cones).
struct PatchTree {
  static constexpr float infinity = std::numeric_limits<float>::infinity();

  struct Node {
    Index begin = 0, end = 0;  ///< in `faces`
    Index skip = 0;            ///< the first node that is not below this one; nodes stand in depth-first order
    Index patch = -1;          ///< its number where it is a patch, with nothing below it
  };
  /// A box with a fourth coordinate, always 0, that lets one instruction compare a corner.
  struct Box {
    Eigen::Array4f low = Eigen::Array4f(infinity, infinity, infinity, 0);
    Eigen::Array4f high = Eigen::Array4f(-infinity, -infinity, -infinity, 0);

    /// So that it holds the point.
    void extend(const Eigen::Array4f& point) { low = low.min(point), high = high.max(point); }
    /// Likewise.
    void extend(const Eigen::Vector3f& point) { extend(Eigen::Array4f(point.x(), point.y(), point.z(), 0)); }
    Box merged(const Box& other) const { return {low.min(other.low), high.max(other.high)}; }  ///< holds both
    /// Moves both corners, m.
    void move(const Eigen::Vector3f& by) {
      const Eigen::Array4f along(by.x(), by.y(), by.z(), 0);
      low += along, high += along;
    }
  };
  /// Boxes around places (m) and unit normals.
  struct Bounds {
    Box places, normals;

    /// Holds both.
    Bounds merged(const Bounds& other) const { return {places.merged(other.places), normals.merged(other.normals)}; }
  };

  std::vector<Index> faces;
  std::vector<Node> nodes;
  std::vector<Index> patches;                      ///< the nodes that are patches
  std::vector<Index> particle_offsets, particles;  ///< of each bundle of patches; every particle with a face is in one

  // What changes with the surface.
  std::vector<Bounds> bounds;           ///< per node, of its faces
  std::vector<Bounds> particle_bounds;  ///< per bundle, of its particles
  std::vector<TrianglePack> triangles;  ///< per patch, its faces in their order
  Eigen::Matrix3Xf areas;               ///< area vectors of the faces
  Eigen::Matrix3Xf outward;             ///< at each particle the sum of those around it

  /// The particles of a bundle.
  std::span<const Index> particles_of(std::size_t bundle) const {
    return {particles.begin() + particle_offsets[bundle], particles.begin() + particle_offsets[bundle + 1]};
  }
};

/// The tree of a surface whose particles are at the columns of `rest`, by halving along the longest axis; not fitted
/// yet.
PatchTree build_patch_tree(const ContactSurface& surface, const Eigen::Matrix3Xf& rest);

/// Fits the tree to where the particles are now.
void refit(const ContactSurface& surface, const Particles& particles, PatchTree& tree);

/// The cosine between two normals below which they may face against each other; what is this near to 0 may be rounding.
inline constexpr float facing_cosine = 1e-5f;

/// Whether something in one may be within `reach` (m) of something in the other and face against it.
inline bool may_meet(const PatchTree::Bounds& one, const PatchTree::Bounds& other, float reach) {
  // By the largest gap along an axis; asking any() of a comparison would look at one coordinate after the other.
  if ((one.places.low - other.places.high).max(other.places.low - one.places.high).maxCoeff() > reach) return false;
  // The least cosine between two vectors of the boxes, axis by axis.
  const Eigen::Array4f &a = one.normals.low, &b = one.normals.high, &c = other.normals.low, &d = other.normals.high;
  return (a * c).min(a * d).min((b * c).min(b * d)).sum() < facing_cosine;
}

/// Appends all nodes that are patches and may meet what is within `bounds`.
void gather_patches(const PatchTree& tree, const PatchTree::Bounds& bounds, float reach, std::vector<Index>& patches);

}  // namespace gracilis
