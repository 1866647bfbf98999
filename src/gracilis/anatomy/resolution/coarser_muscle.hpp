#pragma once

#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// A muscle with fewer triangles, whose vertices are some of the whole one's.
struct CoarserMuscle {
  Muscle muscle;
  std::vector<Index> vertices;  ///< of the whole muscle, in the coarser one's order
  std::vector<Index> went_to;   ///< per vertex of the whole muscle: the coarser one's that it is or was drawn onto
};

/// The muscle with triangles of about `edge_length` (m), by `decimate`. What is attached to different bodies, or to
/// none, stays apart, so attachments keep their outlines. A muscle with longer edges comes back as it is, and so does
/// any where the length is 0. Its settings, fibers and given lines stay the same.
CoarserMuscle coarser_muscle(const Muscle& muscle, Real edge_length);

}  // namespace gracilis
