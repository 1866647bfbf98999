#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gracilis {

/// A solid as equal boxes, each full or empty: the bounding box of its surface cut into as many along every axis
/// (Cervenka and Kohout 2020, section 4.3). Full are the boxes that the surface touches and those that it encloses, so
/// the solid comes out too large, by a box's diagonal at most.
class VoxelSolid {
 public:
  /// Boxes along each axis; 1000 are 125 MB.
  static constexpr int most_boxes = 1000;

  /// Enclosed is what cannot be reached from outside over the sides of boxes that the surface does not touch; through a
  /// hole larger than a box everything can. Preconditions: at least one face, finite coordinates, `boxes` from 1 to
  /// most_boxes.
  VoxelSolid(const TriangleMesh& surface, int boxes);

  /// Whether a point is in a full box; never outside of the bounding box.
  bool contains(const Vec3& p) const;

  /// The place nearest to p that is in no full box: p itself, or a hair within the side of an empty box.
  Vec3 nearest_empty(const Vec3& p) const;

  /// The first place that is in no full box on the way from `from` to `to`, in steps of a box at most; `to` where there
  /// is none.
  Vec3 first_empty(const Vec3& from, const Vec3& to) const;

  const Vec3& box_size() const { return size_; }                         ///< m
  std::size_t bytes() const { return full_.size() * sizeof(full_[0]); }  ///< of the boxes

 private:
  using Box = std::array<int, 3>;
  Box box_of(const Vec3& p) const;
  bool is_inside_grid(const Box& box) const;
  bool is_full(const Box& box) const;
  void set_full(const Box& box);
  void fill_touched(const TriangleMesh& surface);
  void fill_enclosed();

  int count_ = 0;
  Vec3 low_ = Vec3::Zero(), size_ = Vec3::Ones();
  std::vector<std::uint64_t> full_;  ///< a bit per box, x fastest
};

}  // namespace gracilis
