#pragma once

#include <gracilis/methods/mass_spring/spheres.hpp>

#include <array>
#include <vector>

namespace gracilis::mass_spring {

/// How a tree follows its spheres.
enum class TreeUpdate {
  rebuild,    ///< boxes are refitted; children that fill their parent badly, or that nobody asked for, are dropped
  refit_only  ///< boxes are refitted
};

/// A hierarchy of boxes along the axes around moving spheres (Larsson and Akenine-Möller 2006, as Janák 2012, sections
/// 3.1 and 4.3 has it). A box is divided into octants about its middle once a query comes to it, by the spheres'
/// centers.
class SphereTree {
 public:
  /// `spheres` must outlive this and keep their number. Boxes hold `leaf_size` spheres at least before they are
  /// divided, and are divided `most_depth` times at most.
  explicit SphereTree(const Spheres& spheres, TreeUpdate update, std::size_t leaf_size = 8, int most_depth = 10);

  /// Makes the boxes fit the spheres where they are now. With `rebuild`, children go whose boxes' volumes sum to more
  /// than 1/0.9 of their parent's (eq. 3.1), or whose parent no query has come to since the last update.
  void update();

  /// Pairs (sphere of `one`, sphere of `other`) that intersect, ascending: those that brute force finds. Two that touch
  /// do not intersect. Divides boxes of both where needed.
  static std::vector<std::array<Index, 2>> intersecting(SphereTree& one, SphereTree& other);

  std::size_t box_count() const { return boxes_.size(); }  ///< so far; queries divide boxes

 private:
  struct Box {
    Eigen::AlignedBox3d bounds;
    std::vector<Index> spheres;
    std::vector<Index> children;  ///< boxes; none: not divided
    int depth = 0;
    bool is_asked = false;
  };

  Eigen::AlignedBox3d bounds_of(const std::vector<Index>& spheres) const;
  void divide(Index box);
  void drop_descendants(Index box);
  void refit(Index box);
  Index new_box(Box box);
  static void collect(SphereTree& one, Index a, SphereTree& other, Index b, std::vector<std::array<Index, 2>>& pairs);

  Box& at(Index box) { return boxes_[static_cast<std::size_t>(box)]; }

  const Spheres& spheres_;
  TreeUpdate update_;
  std::size_t leaf_size_;
  int most_depth_;
  std::vector<Box> boxes_;   ///< the first holds all
  std::vector<Index> free_;  ///< boxes that were dropped
};

}  // namespace gracilis::mass_spring
