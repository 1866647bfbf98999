#pragma once

#include <gracilis/geometry/section_frames.hpp>

namespace gracilis {

/// The line from a muscle's origin over its via points to its insertion (Laclé 2014, chapter 3), 3 × n, m.

/// The point that lies `distance` (m) before the line's end, walked along it; its first point where it is shorter.
/// `after` becomes the index of the point that follows it.
Vec3 point_before_end(const Points& line, Real distance, Index& after);

/// A muscle's and its tendon's rest length in a model, and in a skeleton of another size (Laclé 2014, eqs. 3.7
/// to 3.10).
struct TendonLengths {
  Real rest = 0;           ///< m, l_ts + l_opt cos α
  Real scaled_rest = 0;    ///< m, scaled with the action line
  Real scaled_tendon = 0;  ///< m, the whole slack length, scaled alike
};

/// From optimal fiber length (m), pennation angle (rad), tendon slack length (m), and the lengths (m) of the action
/// line in the model and in the other skeleton.
TendonLengths tendon_lengths(Real optimal_fiber, Real pennation, Real slack, Real line, Real scaled_line);

}  // namespace gracilis
