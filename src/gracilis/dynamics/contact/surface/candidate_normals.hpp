#pragma once

#include <gracilis/dynamics/contact/surface/contact_world.hpp>

#include <vector>

namespace gracilis {

/// Makes the normals that are asked for, each once. Others stay those of some earlier time.
class NormalMaker {
 public:
  /// All must outlive it; normals go into the state.
  NormalMaker(const ContactWorld& world, const std::vector<const Particles*>& particles, ContactWorldState& state);

  void ask(std::size_t surface, Index particle);  ///< for a particle's normal
  /// For those at the corners of the candidate's face, which is the surface's.
  void ask_corners(std::size_t surface, const VertexFaceCandidate& candidate);
  void ask_ends(std::size_t surface, Index edge);  ///< for those at the ends of an edge

  /// Makes those asked for since the last time.
  void make();

 private:
  const ContactWorld& world_;
  const std::vector<const Particles*>& particles_;
  ContactWorldState& state_;
  std::vector<std::vector<char>> asked_;
  std::vector<std::vector<Index>> listed_;
};

/// Asks for the normals that tell on which side of a surface those near it are; over the inside of a face it tells
/// alone.
void ask_to_tell_sides(const ContactWorld& world, const ContactWorldState& state, NormalMaker& normals);

/// Asks for the normals that projecting what is listed may need.
void ask_to_project(const ContactWorld& world, const ContactWorldState& state, NormalMaker& normals);

}  // namespace gracilis
