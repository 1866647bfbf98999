#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <memory>
#include <optional>

namespace gracilis {

/// Finds the triangles of a surface by their place, in single precision about the middle of their box, so that nothing
/// is lost where a surface lies far from its frame's origin. By Embree; where that does not exist (WebAssembly),
/// triangle_tree_boxes.cpp stands in. Queries may run at the same time. Precondition: at least one face, all
/// coordinates finite.
class TriangleTree {
 public:
  explicit TriangleTree(const TriangleMesh& mesh);  ///< copies what it needs
  ~TriangleTree();
  /// One that is moved from may only be assigned to or destroyed.
  TriangleTree(TriangleTree&&) noexcept;
  TriangleTree& operator=(TriangleTree&&) noexcept;  ///< as the constructor

  /// Told of a triangle that may be near, answers how near others still have to be (m); infinity: as before.
  using Near = float (*)(Index face, void* query);
  /// Asks `near` about the triangles that may come within `radius` of p, each once, in any order.
  void near(const Vec3& p, float radius, Near near, void* query) const;

  /// Whether the segment from a to b meets a triangle.
  bool cut(const Vec3& a, const Vec3& b) const;

  struct Hit {
    Index face = -1;
    Vec3 place;
  };
  /// Where the segment from a to b first meets a triangle; empty where it meets none.
  std::optional<Hit> first(const Vec3& a, const Vec3& b) const;

  using Met = void (*)(Index face, void* query);
  /// Tells `met` of every triangle that the segment from a to b meets, in any order.
  void all(const Vec3& a, const Vec3& b, Met met, void* query) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace gracilis
