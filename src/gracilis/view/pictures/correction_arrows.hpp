#pragma once

#include <gracilis/dynamics/solver/constraint_kind.hpp>
#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/view/pictures/picture.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// What constraints moved, as arrows, of runs with corrections.

/// After Okabe and Ito (2008): told apart by color-blind readers, too.
Color arrow_color(ConstraintKind kind);

/// How such arrows are drawn.
struct CorrectionArrowSize {
  Real times = 0;    ///< as long as what they stand for; 0: no arrows
  Real spacing = 0;  ///< m, that their roots keep from each other
  Real head = 0;     ///< m, of an arrow's head at most
};

/// 1, 2 or 5 times a power of ten, at which all but the longest twentieth of the arrows of these muscles in these
/// frames are shorter than a twelfth of what is seen. `extent`: m, what is seen. Errors as recorded_corrections.
CorrectionArrowSize correction_arrow_size(const RecordedRun& run, const std::vector<std::string>& muscles,
                                          const std::vector<int>& frames, Real extent);

/// An arrow per kind of constraint and root on a muscle's surface in this frame, those of a kind as one surface, whose
/// name tells the kind and the scale: it is the legend's. Short ones are left out. Errors as recorded_corrections.
std::vector<PaintedSurface> correction_arrows(const RecordedRun& run, const std::string& muscle, const Points& vertices,
                                              int frame, const CorrectionArrowSize& size);

}  // namespace gracilis
