#pragma once

#include <gracilis/dynamics/contact/surface/surface_crowd.hpp>

#include <vector>

namespace gracilis {

/// Makes the normals that are asked for, each once. Others stay those of some earlier time.
class NormalMaker {
 public:
  NormalMaker(const SurfaceCrowd& crowd, const std::vector<const Particles*>& particles, CrowdState& state);

  void ask(std::size_t surface, Index particle);
  void ask_corners(std::size_t surface, const PointTouch& touch);
  void ask_ends(std::size_t surface, Index edge);

  /// Makes those asked for since the last time.
  void make();

 private:
  const SurfaceCrowd& crowd_;
  const std::vector<const Particles*>& particles_;
  CrowdState& state_;
  std::vector<std::vector<char>> asked_;
  std::vector<std::vector<Index>> listed_;
};

/// Asks for the normals that tell on which side of a surface those near it are; over the inside of a face it tells
/// alone.
void ask_to_tell_sides(const SurfaceCrowd& crowd, const CrowdState& state, NormalMaker& normals);

/// Asks for the normals that projecting what is listed may need.
void ask_to_project(const SurfaceCrowd& crowd, const CrowdState& state, NormalMaker& normals);

}  // namespace gracilis
